"""Relighting by known lights: the variants, the figures, and a quality gate on path-traced heads."""

from __future__ import annotations

from statistics import fmean

import numpy as np
import pytest

from graphface.nodes.bench.known_light_cases import Case, head_cases
from graphface.nodes.bench.known_lights import UNCHANGED, VARIANTS, Variant, compared, relight_known
from graphface.nodes.io.image_read import read_image
from graphface.nodes.types import DirectionalLight, Image, Scene
from graphface.nodes.types.image import image_from_array


class TestVariant:
    SCENE = Scene(lights=(DirectionalLight(azimuth=10), DirectionalLight(azimuth=-10)), scatter=0.1, hair=0.5)

    def test_shadow_of_every_light(self):
        """One kind of shadow for all lights, and hair without the old light."""
        scene = Variant("x", shadow="none").applied(self.SCENE)
        assert [light.shadow for light in scene.lights] == ["none", "none"]
        assert [light.azimuth for light in scene.lights] == [10, -10]
        assert scene.hair == 0

    def test_scene_override(self):
        """What the variant says of the scene wins; the rest is the known light's."""
        scene = Variant("x", scene={"specular": 2.0}).applied(self.SCENE)
        assert (scene.specular, scene.scatter) == (2.0, 0.1)

    def test_names_are_unique(self):
        """A name tells one variant."""
        assert len({v.name for v in VARIANTS}) == len(VARIANTS)


class TestCompared:
    @pytest.fixture
    def pair(self, rng):
        truth = rng.uniform(0.2, 0.8, (40, 40, 3)).astype(np.float32)
        return truth, np.ones((40, 40), np.float32)

    def test_offset(self, pair):
        """An error of 0.1 everywhere is 20 dB and a root mean square of 0.1."""
        truth, mask = pair
        found = compared(truth + np.float32(0.1), truth, mask)
        assert found["psnr"] == pytest.approx(20, abs=1e-3)
        assert found["rmse"] == pytest.approx(0.1, abs=1e-5)

    def test_exposure_is_forgiven(self, pair):
        """The scale-invariant figures know one best gain, the others none."""
        truth, mask = pair
        found = compared(truth / 2, truth, mask)
        assert found["si_mse"] < 1e-12
        assert found["si_psnr"] > 100
        assert found["psnr"] < 15

    def test_only_inside_the_mask(self, pair):
        """What happens outside does not count, but for the windows of SSIM that reach there."""
        truth, mask = pair
        mask[:, 20:] = 0
        spoilt = truth.copy()
        spoilt[:, 30:] = 0
        found = compared(spoilt, truth, mask)
        assert found["rmse"] == 0
        assert found["ssim"] == pytest.approx(1)

    def test_perfect_and_black_are_finite(self, pair):
        """No figure is infinite, whatever the pictures."""
        truth, mask = pair
        for one, other in ((truth, truth), (truth * 0, truth), (truth, truth * 0), (truth * 0, truth * 0)):
            assert np.isfinite(list(compared(one, other, mask).values())).all()

    def test_only_the_part_about_the_mask_is_looked_at(self, pair):
        """The figures of a small region are those that the whole picture gives there."""
        truth, mask = pair
        small = np.zeros_like(mask)
        small[18:25, 15:20] = 1
        far = truth.copy()
        far[:5] = 0
        near = truth + np.float32(0.01)
        near[:5] = 0.5
        assert compared(near, far, small) == compared(near, truth, small)


class TestRelightKnown:
    def test_variants_share_and_are_charged_alike(self, heads):
        """A variant's figures and whether they cost anything do not depend on which others ran before."""
        cases = [case for case in head_cases(heads) if case.light in ("left45", "right45")]
        chosen = [VARIANTS[0], next(v for v in VARIANTS if v.name == "detail.none")]
        together = [f for f in relight_known(cases, chosen) if f.variant == "detail.none"]
        alone = [f for f in relight_known(cases, chosen[1:]) if f.variant == "detail.none"]
        assert [f.measured for f in together] == [f.measured for f in alone]
        assert all(f.milliseconds > 0 for f in (*together, *alone))

    @pytest.mark.parametrize("linear", [False, True])
    def test_the_photos_own_light(self, face, tmp_path, linear):
        """A scene that changes nothing gives the photo, in the values it is compared in, without its border."""
        inner = image_from_array(face).pixels[8:-8, 8:-8]
        photo = Image(np.float32(face / 255), encoding="linear" if linear else "srgb")
        case = Case("me", "own", photo, lambda normals: Scene(mode="add"), inner, np.ones(inner.shape[:2]), crop=8)
        before, after = relight_known([case], VARIANTS[:1], tmp_path)
        assert (before.variant, before.milliseconds, before.measured["rmse"]) == (UNCHANGED, None, 0)
        assert after.measured["rmse"] == pytest.approx(0, abs=1e-6)
        np.testing.assert_array_equal(np.rint(read_image(tmp_path / "me/own.png").pixels * 255), face[8:-8, 8:-8])


@pytest.fixture(scope="module")
def figures(networks, shared):
    return [f for f in relight_known(head_cases(shared), VARIANTS[:1]) if f.variant != UNCHANGED]


class TestQuality:
    @pytest.mark.parametrize(
        ("light", "reached"), [("left45", 29.5), ("right45", 28.1), ("top", 26.0), ("left80_hard", 28.5)]
    )
    def test_keeps_its_quality(self, figures, light, reached):
        """Mean scale-invariant PSNR of the six path-traced heads stays near what was reached."""
        assert fmean(f.measured["si_psnr"] for f in figures if f.light == light) > reached - 0.3

    def test_of_all_lights(self, figures):
        """29.0 dB were reached on average."""
        assert fmean(f.measured["si_psnr"] for f in figures) > 28.7
