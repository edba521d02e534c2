"""The last step of all readers."""

from __future__ import annotations

import numpy as np
from faces import grid_model

from graphface.nodes.morphable.readers.assemble import boundary_loops, closed


class TestAssemble:
    def test_holes_are_closed_with_the_same_winding(self):
        """Every edge of a closed hole has two triangles, running in opposite directions."""
        triangles = grid_model().triangles
        center = np.flatnonzero((triangles == 66).any(axis=1))
        holed = np.delete(triangles, center, axis=0)
        loops = boundary_loops(holed)
        assert len(loops) == 2
        filled, fans = closed(holed, loops[1:], 144)
        assert len(boundary_loops(filled)) == 1
        assert len(fans) == 1
