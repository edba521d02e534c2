"""Light of a panorama, from a file written here to the relit photo."""

from __future__ import annotations

import numpy as np
import pytest

import graphface
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.io.panorama import write_panorama
from graphface.nodes.types import Environment
from graphface.nodes.types.image import image_from_array

LEFT, RIGHT = np.s_[40:80, 42:60], np.s_[40:80, 68:86]
"""The halves of the face in `portrait`."""


def write_hdr(path, radiance):
    """Radiance RGBE without run-length coding (Ward 1991): a mantissa byte each for R, G, B, and a shared exponent."""
    height, width = radiance.shape[:2]
    mantissa, exponent = np.frexp(radiance.max(axis=2))
    scale = np.where(mantissa > 0, np.ldexp(256.0, -exponent), 0)
    texels = np.concatenate([radiance * scale[..., None], exponent[..., None] + 128], axis=2).astype(np.uint8)
    path.write_bytes(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + texels.tobytes())
    return path


def sky(color=(1.0, 1.0, 1.0), column=None):
    """A dim panorama, 16 x 32; with a window of that color, 8 columns wide, around `column`."""
    radiance = np.full((16, 32, 3), 0.1)
    if column is None:
        return radiance * color
    radiance[4:12, column - 4 : column + 4] = 8 * np.asarray(color)
    return radiance


@pytest.fixture(scope="module")
def portrait():
    import cv2

    photo = pytest.importorskip("skimage.data").astronaut()[:256, 96:352]
    return image_from_array(cv2.resize(photo, (128, 128), interpolation=cv2.INTER_AREA))


@pytest.fixture(scope="module")
def relit(portrait):
    """Relights the portrait by a panorama file; the photo's representation is made once."""
    graph, evaluator = graphface.load("relight"), graphface.Evaluator(memory=graphface.MemoryTier())

    def run(panorama, light=None, **scene):
        lights = [{"type": "environment", **(light or {})}]
        wanted = {"lights": lights, "background": 1, "hair": 0, **scene}
        more = {} if panorama is None else {"environment": panorama}
        try:
            return graph.run(evaluator=evaluator, photo=portrait, scene=wanted, **more)
        except graphface.RunError as error:
            if isinstance(error, AssetUnavailable) or "network" in str(error):
                pytest.skip(str(error))
            raise

    return run


class TestEnvironmentLight:
    def test_comes_from_where_the_panorama_is_bright(self, relit, tmp_path):
        """Column 1/4 of a panorama looks to the picture's right, column 3/4 to its left."""
        right = relit(str(write_hdr(tmp_path / "right.hdr", sky(column=8))))["image"].pixels
        left = relit(str(write_hdr(tmp_path / "left.hdr", sky(column=24))))["image"].pixels
        assert (right - left)[RIGHT].mean() > 0.1
        assert (left - right)[LEFT].mean() > 0.1

    def test_has_the_panoramas_color(self, relit, tmp_path):
        """A red window makes the side it lights redder than a white one does."""
        red, white = (
            relit(str(write_hdr(tmp_path / f"{name}.hdr", sky(color, 8))))["image"].pixels
            for name, color in (("red", (1.0, 0.2, 0.2)), ("white", (1.0, 1.0, 1.0)))
        )
        redness = (red[..., 0] - red[..., 2]) - (white[..., 0] - white[..., 2])
        assert redness[RIGHT].mean() > 0.1

    def test_turned(self, relit, tmp_path):
        """Azimuth turns the panorama to the right: light from ahead, turned by 90, is light from the right."""
        ahead = str(write_hdr(tmp_path / "ahead.hdr", sky(column=16)))
        right = str(write_hdr(tmp_path / "right.hdr", sky(column=8)))
        turned = relit(ahead, {"azimuth": 90})["image"].pixels
        np.testing.assert_allclose(turned, relit(right)["image"].pixels, atol=0.01)
        assert np.abs(turned - relit(ahead)["image"].pixels).max() > 0.1

    def test_the_same_from_all_sides_is_ambient_light(self, portrait, relit, tmp_path):
        """A grey panorama lights like a scene with `ambient` alone."""
        even = relit(str(write_hdr(tmp_path / "even.hdr", sky())))["image"].pixels
        graph = graphface.load("relight")
        ambient = graph.run(photo=portrait, scene={"ambient": 1, "background": 1, "hair": 0})["image"].pixels
        np.testing.assert_allclose(even, ambient, atol=0.01)
        assert np.abs(even - portrait.pixels).max() > 0.02

    def test_either_format(self, relit, tmp_path):
        """The same panorama as OpenEXR gives the same picture, but for the 8 bits of an .hdr."""
        radiance = sky((1.0, 0.7, 0.4), 8)
        write_panorama(Environment(radiance.astype(np.float32)), tmp_path / "sky.exr")
        one = relit(str(tmp_path / "sky.exr"))["image"].pixels
        other = relit(str(write_hdr(tmp_path / "sky.hdr", radiance)))["image"].pixels
        np.testing.assert_allclose(one, other, atol=0.01)

    def test_only_where_the_scene_asks(self, relit, tmp_path):
        """A panorama not seen before is projected for an environment light and left alone for any other."""
        panorama = str(write_hdr(tmp_path / "sky.hdr", sky(column=12)))
        for lights, expected in (({}, True), ({"lights": [{"type": "sh", "preset": "left"}]}, False)):
            ran = {r.name for r in relit(panorama, **lights).records if r.state in ("ran", "memory")}
            assert ("panorama" in ran) == expected

    def test_left_out(self, relit):
        """Without a panorama the error of an environment light names the missing input."""
        with pytest.raises(graphface.RunFailed, match="environment"):
            relit(None)

    @pytest.mark.parametrize(
        ("name", "content"), [("none.hdr", None), ("bad.hdr", b"#?RADIANCE\n\n-Y 16"), ("bad.exr", b"v/1\1")]
    )
    def test_unreadable(self, relit, tmp_path, name, content):
        """A panorama that is not there, or is cut short, is named."""
        if content is not None:
            (tmp_path / name).write_bytes(content)
        with pytest.raises(graphface.UnreadableFile, match=name):
            relit(str(tmp_path / name))
