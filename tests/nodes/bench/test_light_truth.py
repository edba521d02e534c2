"""The direction of light that is fitted, beside the true one."""

from __future__ import annotations

from statistics import fmean

import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.heads import heads_of
from graphface.nodes.bench.light_truth import DIRECTED_LIGHTS, light_truth


class TestLightTruth:
    def test_every_fit(self, heads):
        """Each order and robustness under each light from one side; angles are angles."""
        found = list(light_truth(heads, orders=(1, 2), robust=("none",)))
        assert [(f.light, f.order) for f in found] == [(light, n) for light in DIRECTED_LIGHTS for n in (1, 2)]
        assert all(0 <= angle <= 180 for f in found for angle in (f.mesh_degrees, f.true_degrees))

    def test_trimming_helps_on_traced_heads(self, networks, shared, tmp_path):
        """Cast shadows turn plain least squares; leaving out what fits badly does not follow them as far."""
        (tmp_path / "truth").mkdir()
        (tmp_path / "truth/gt01").symlink_to(heads_of(shared)[0].folder)
        found = list(light_truth(tmp_path, orders=(1,), robust=("none", "trimmed")))
        plain, trimmed = (fmean(f.mesh_degrees for f in found if f.robust == how) for how in ("none", "trimmed"))
        assert trimmed < plain - 5

    def test_no_heads(self, tmp_path):
        """A folder without heads is named."""
        with pytest.raises(UnreadableFile, match="no heads"):
            next(light_truth(tmp_path))
