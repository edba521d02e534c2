"""Pictures in sRGB or in linear light."""

from __future__ import annotations

import numpy as np
from pictures import smooth

from graphface.nodes.image.encode import encode
from graphface.nodes.types import Image


class TestEncode:
    def test_same_encoding_is_the_same_object(self):
        """Nothing is computed where nothing changes."""
        image = Image(smooth())
        assert encode(image, encoding="srgb") is image

    def test_there_and_back(self):
        """Linear and back is the same picture."""
        image = encode(encode(Image(smooth()), encoding="linear"), encoding="srgb")
        np.testing.assert_allclose(image.pixels, smooth(), atol=2e-6)
