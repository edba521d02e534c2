"""A photograph that comes with scikit-image, and the weights, without which these tests cannot run."""

import numpy as np
import pytest

from graphface.assets.asset import AssetUnavailable
from graphface.nodes.landmarks.weights import ASSETS, weights_path
from graphface.nodes.types import Image
from graphface.nodes.types.image import image_from_array


@pytest.fixture(scope="session")
def weights() -> None:
    """Skips where the network weights are neither on this machine nor to be had."""
    try:
        for asset in ASSETS:
            weights_path(asset)
    except AssetUnavailable as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def astronaut() -> Image:
    """One frontal face, about 100 pixels wide, in 512 x 512; public domain (NASA)."""
    data = pytest.importorskip("skimage.data")
    return image_from_array(np.asarray(data.astronaut()))
