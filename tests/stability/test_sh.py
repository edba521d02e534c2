"""Light fitted to too little: slivers, walls, three pixels, holes. Bounded answers that say what they rest on."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.sh.fit import fit

SIDE = 48
HOW = [{"robust": r, "nonnegative": n} for r in ("none", "huber", "trimmed") for n in (False, True)]


def bowl():
    """Normals of a shallow bowl that fills the picture."""
    y, x = np.mgrid[0.7 : -0.7 : SIDE * 1j, -0.7 : 0.7 : SIDE * 1j]
    normals = np.stack([x, y, np.sqrt(1 - x * x - y * y)], axis=2)
    return normals.astype(np.float32)


def wall():
    normals = np.zeros((SIDE, SIDE, 3), np.float32)
    normals[..., 2] = 1
    return normals


def sliver():
    mask = np.zeros((SIDE, SIDE), np.float32)
    mask[10:40, 5] = 1
    return mask


def pixels(count):
    mask = np.zeros((SIDE, SIDE), np.float32)
    mask.flat[100 : 100 + count] = 1
    return mask


HARD = {
    "sliver": (bowl, sliver),
    "constant normal": (wall, lambda: np.ones((SIDE, SIDE), np.float32)),
    "three pixels": (bowl, lambda: pixels(3)),
    "one pixel": (bowl, lambda: pixels(1)),
    "a trace of a mask": (bowl, lambda: np.full((SIDE, SIDE), 1e-8, np.float32)),
}


@pytest.mark.parametrize("how", HOW, ids=lambda h: f"{h['robust']}-{'bounded' if h['nonnegative'] else 'free'}")
@pytest.mark.parametrize("order", [0, 1, 2, 3])
class TestTooLittle:
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    @pytest.mark.parametrize("case", HARD)
    @pytest.mark.parametrize("level", ["black", "noise", "bright"])
    def test_bounded(self, order, how, case, level, rng):
        """The light found is finite and shades its own pixels within the range of the data, or a little beyond."""
        normals, mask = (make() for make in HARD[case])
        shading = {"black": 0.0, "noise": rng.random((SIDE, SIDE)), "bright": 5.0}[level]
        shading = np.broadcast_to(np.float32(shading), (SIDE, SIDE)).astype(np.float32)
        found = fit(shading, normals, mask, order=order, **how)
        assert np.isfinite(found.light.coefficients).all()
        assert np.isfinite(found.residual).all()
        assert np.isfinite(found.condition)
        assert np.abs(found.light.coefficients).max() <= 60 * max(float(shading.max()), 1e-6)

    def test_holes_take_no_part(self, order, how):
        """NaN in the shading is left out of the fit and of the residual."""
        shading = np.full((SIDE, SIDE), 0.5, np.float32)
        shading[10:20] = np.nan
        found = fit(shading, bowl(), np.ones_like(shading), order=order, **how)
        assert np.isfinite(found.residual).all()
        assert found.light.coefficients[0] * 0.282095 == pytest.approx(0.5, abs=0.05)


class TestSaysSo:
    @pytest.mark.parametrize("case", ["sliver", "constant normal", "three pixels", "one pixel"])
    def test_ill_conditioned_fits_are_reported(self, case):
        """A warning, and a condition number beyond the limit."""
        normals, mask = (make() for make in HARD[case])
        with pytest.warns(GraphfaceWarning, match="hardly differ"):
            found = fit(np.full((SIDE, SIDE), 0.5, np.float32), normals, mask)
        assert found.condition > 1e3

    def test_an_empty_mask_is_reported(self):
        """No pixel to go by: the mean of the picture as ambient light, and a warning."""
        with pytest.warns(GraphfaceWarning, match="no pixel"):
            found = fit(np.full((SIDE, SIDE), 0.5, np.float32), bowl(), np.zeros((SIDE, SIDE), np.float32))
        assert found.light.coefficients[0] * 0.282095 == pytest.approx(0.5)
