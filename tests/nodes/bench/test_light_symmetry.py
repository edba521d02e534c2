"""How alike both sides of a photographed face are without the light that was found."""

from __future__ import annotations

import numpy as np
import pytest
from skimage.data import astronaut

from graphface.nodes.bench.known_lights import Variant
from graphface.nodes.bench.light_symmetry import light_symmetry
from graphface.nodes.io.image_write import write_picture


@pytest.fixture
def photos(networks, tmp_path):
    """A face as it was photographed, the same with its right half darkened, and a picture without a face."""
    pixels = astronaut().astype(np.float32) / 255
    shade = np.linspace(1.1, 0.5, 100, dtype=np.float32)
    darker = pixels.copy()
    darker[:, 170:270] *= shade[None, :, None]
    darker[:, 270:] *= shade[-1]
    for name, picture in {"a": pixels, "b": darker, "c": np.zeros((64, 64, 3), np.float32)}.items():
        write_picture((255 * np.clip(picture, 0, 1)).astype(np.uint8), tmp_path / f"{name}.png")
    return [tmp_path / f"{name}.png" for name in "abc"]


class TestLightSymmetry:
    def test_light_of_one_side_is_taken_out(self, photos):
        """Most of what a darkened side adds is gone after division; even light takes nothing out."""
        variants = [Variant("first"), Variant("even", set={"face/light.order": 0})]
        with pytest.warns(match=r"c\.png is left out"):
            found = {(f.variant, f.photo): f for f in light_symmetry(photos, variants)}
        assert set(found) == {(v, p) for v in ("first", "even") for p in ("a.png", "b.png")}
        even, first = found["even", "b.png"], found["first", "b.png"]
        assert even.side_after == pytest.approx(even.side_before, abs=0.02)
        assert first.side_before > found["first", "a.png"].side_before
        assert first.side_after < 0.6 * first.side_before
        assert first.points_after < first.points_before
