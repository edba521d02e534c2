"""The container of a face model."""

from __future__ import annotations

import numpy as np
import pytest
from faces import grid_model

from graphface.nodes.morphable.model import Basis, InvalidModel
from graphface.nodes.morphable.prior import standard


class TestMorphableModel:
    @pytest.mark.parametrize(
        ("changes", "reason"),
        [
            ({"triangles": np.array([[0, 1, 999]], np.int32)}, "outside"),
            ({"mean": np.zeros((3, 3), np.float32)}, "mean has the shape"),
            (
                {"identity": Basis(np.zeros((1, 5, 3), np.float32), np.ones(1, np.float32), ("a",))},
                "identity directions",
            ),
            ({"identity": Basis(np.zeros((2, 144, 3), np.float32), np.ones(2, np.float32), ("a",))}, "1 names"),
            ({"landmarks": {}}, "no landmark scheme"),
            ({"landmarks": {"ibug68": np.zeros(5, np.int32)}}, "5 vertices"),
            ({"landmarks": {"ibug68": np.full(68, -1, np.int32)}}, "at least 6"),
            ({"uv": np.zeros((2, 2), np.float32)}, "uv has the shape"),
            ({"parts": np.zeros(2, np.int32)}, "parts has 2"),
            ({"prior": standard(9)}, "prior is over 9"),
        ],
    )
    def test_names_what_does_not_agree(self, changes, reason):
        """Parts that do not agree are refused, with the sizes in the message."""
        with pytest.raises(InvalidModel, match=reason):
            grid_model(**changes)

    def test_refuses_values_that_are_not_numbers(self):
        """A mean with NaN is no face."""
        mean = grid_model().mean.copy()
        mean[0] = np.nan
        with pytest.raises(InvalidModel, match="not numbers"):
            grid_model(mean=mean)

    def test_vertices_are_linear_in_the_coefficients(self):
        """F(a) - F(0) is the sum of the directions times a; missing coefficients are zero."""
        model = grid_model()
        expected = model.mean + 2 * model.identity.directions[0] - model.identity.directions[1]
        np.testing.assert_allclose(model.vertices(np.array([2.0, -1.0])), expected, atol=1e-5)
