"""Intrinsic methods and light fits on heads whose albedo and lights are known."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.heads import heads_of
from graphface.nodes.bench.intrinsic_truth import WHITE_LIGHTS, intrinsic_truth


class TestIntrinsicTruth:
    def test_every_method_on_every_head_and_light(self, heads):
        """Figures are finite, and not all the same."""
        methods = ("intrinsic.intensity", "intrinsic.retinex")
        found = list(intrinsic_truth(heads, methods, ("frontal", "left45")))
        assert [(f.method, f.light) for f in found] == [(m, light) for light in ("frontal", "left45") for m in methods]
        errors = np.array([(f.albedo_si_mse, f.albedo_lmse, f.shading_si_mse, f.shading_lmse) for f in found])
        assert np.isfinite(errors).all()
        assert len(set(errors[:, 0])) == len(found)

    def test_colored_light_is_left_out(self):
        """Its shading is not one number a pixel."""
        assert "red_blue" not in WHITE_LIGHTS

    def test_keeps_its_quality(self, networks, shared, tmp_path):
        """The shipped method on one traced head in frontal light: albedo off by less than 4 % of its power."""
        (tmp_path / "truth").mkdir()
        (tmp_path / "truth/gt01").symlink_to(heads_of(shared)[0].folder)
        (found,) = intrinsic_truth(tmp_path, ("intrinsic.intensity",), ("frontal",))
        assert found.albedo_si_mse < 0.04

    def test_no_heads(self, tmp_path):
        """A folder without heads is named."""
        with pytest.raises(UnreadableFile, match="no heads"):
            next(intrinsic_truth(tmp_path, ()))
