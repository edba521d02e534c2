"""The operator that draws a mesh."""

from __future__ import annotations

import numpy as np

from graphface.nodes.rasterize import rasterized
from graphface.nodes.surface.rasterize import rasterize
from graphface.testing import check_node


class TestRasterize:
    def test_size_of_the_photo(self, make_face):
        """Maps have the photo's size, with the operator's parameters."""
        photo, _, mesh, _ = make_face(80)
        found = rasterize(mesh, photo, smoothing=0.0)
        np.testing.assert_array_equal(found.normals, rasterized(mesh, (80, 80), smoothing=0.0).normals)

    def test_node(self, make_face):
        """It keeps an operator's promises."""
        photo, _, mesh, _ = make_face(60)
        check_node(rasterize, mesh, photo)
