"""Points on the surface of a head model."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.head_points import OnSurface, nearest_on

VERTICES = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], np.float64)
TRIANGLES = np.array([(0, 1, 2), (0, 2, 3)])


class TestNearestOn:
    def test_a_point_above_a_square_lies_on_it(self):
        """Within the spacing of the points that are tried."""
        points = np.array([(0.7, 0.2, 0.5), (0.1, 0.8, -2.0), (1.0, 0.0, 0.0)])
        found = nearest_on(points, VERTICES, TRIANGLES).at(VERTICES, TRIANGLES)
        np.testing.assert_allclose(found[:, 2], 0, atol=1e-12)
        np.testing.assert_allclose(found[:, :2], points[:, :2], atol=0.12)

    def test_beyond_the_edge_it_is_the_edge(self):
        """The weights stay within the triangle."""
        found = nearest_on(np.array([(5.0, 0.0, 0.0)]), VERTICES, TRIANGLES)
        np.testing.assert_allclose(found.at(VERTICES, TRIANGLES), [(1, 0, 0)])
        assert (found.weights >= 0).all()


class TestOnSurface:
    def test_interpolates_any_values(self):
        """Leading axes, such as identities, stay."""
        place = OnSurface(np.array([0]), np.array([[0.5, 0.5, 0.0]]))
        values = np.stack([VERTICES, 2 * VERTICES])
        np.testing.assert_allclose(place.at(values, TRIANGLES), [[(0.5, 0, 0)], [(1, 0, 0)]])
