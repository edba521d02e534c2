"""The focal length in a photo."""

from __future__ import annotations

import numpy as np
import pytest
from faces import landmarks_of

from graphface import GraphfaceWarning
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.morphable.focal import focal_length
from graphface.nodes.types import FileFormat
from graphface.nodes.types.image import image_from_array


class TestFocalLength:
    def test_is_read_from_exif(self):
        """A 50 mm equivalent is 50 / 43.27 diagonals."""
        from PIL.Image import Exif

        exif = Exif()
        exif.get_ifd(0x8769)[0xA405] = 50
        photo = image_from_array(np.zeros((300, 400, 3), np.uint8))
        photo = type(photo)(photo.pixels, file=FileFormat(exif=exif.tobytes()))
        assert focal_length(photo) == pytest.approx(500 * 50 / 43.267, rel=1e-3)
        mesh = morphable(landmarks_of(), photo, camera="exif")
        assert mesh.fit.distance == pytest.approx(focal_length(photo) / 150, rel=0.1)

    @pytest.mark.parametrize("exif", [None, b"", b"nonsense"])
    def test_without_it_a_distance_is_assumed(self, exif):
        """No or damaged EXIF is a warning, not a failure."""
        photo = image_from_array(np.zeros((300, 400, 3), np.uint8))
        photo = type(photo)(photo.pixels, file=FileFormat(exif=exif))
        assert focal_length(photo) is None
        with pytest.warns(GraphfaceWarning, match="no focal length"):
            assert morphable(landmarks_of(), photo, camera="exif").fit.distance == pytest.approx(10)
