"""Geometries against heads whose normals and depth are known: a quality gate, where the data is at hand."""

from __future__ import annotations

from statistics import fmean

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.geometry_truth import correlation, geometry_truth
from graphface.nodes.morphable.builtin import builtin_model


@pytest.fixture(scope="module")
def rows(networks, shared):
    return list(geometry_truth(shared, {"builtin": builtin_model()}))


def mean(rows, geometry, field):
    return fmean(getattr(row, field) for row in rows if row.geometry == geometry)


class TestGeometryTruth:
    def test_the_fit_is_best(self, rows):
        """Mean angle of normals over heads and lights: fit, then the average (by its relief), then the network's own
        depth."""
        fitted, direct, average = (
            mean(rows, name, "normals") for name in ("morphable, builtin", "facemesh", "average, builtin")
        )
        assert fitted < average - 0.5
        assert average < direct - 0.3

    def test_keeps_its_quality(self, rows):
        """Figures stay near what was reached: 11.0 degrees, 5.7 % of the eye distance, depth correlation 0.87."""
        assert mean(rows, "morphable, builtin", "normals") < 11.4
        assert mean(rows, "morphable, builtin", "landmarks") < 6.1
        assert mean(rows, "morphable, builtin", "depth") > 0.84

    def test_heads_without_points(self, heads):
        """Their landmarks are not judged; the rest is."""
        found = list(geometry_truth(heads, {}))
        assert {row.landmarks for row in found} == {None}
        assert all(0 <= row.normals < 90 and -1 <= row.depth <= 1 for row in found)

    def test_no_heads_is_an_error(self, tmp_path):
        """A folder without truth is named."""
        with pytest.raises(UnreadableFile, match="no heads"):
            next(geometry_truth(tmp_path, {}))

    def test_correlation_of_nothing_is_zero(self):
        """A map without variation correlates with nothing."""
        assert correlation(np.ones(5), np.arange(5.0)) == 0
        assert correlation(np.zeros(0), np.zeros(0)) == 0
