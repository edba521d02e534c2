"""Where the painted face is used as it is."""

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.makeup.core import core
from graphface.nodes.warp.mesh import mesh as correspond


class TestCore:
    def test_inside_of_the_face(self, face):
        """1 deep inside of the mesh, 0 off it, and a ramp at its rim."""
        inner = core(face.everywhere, face.everywhere, face.onto_itself, face.landmarks)
        assert inner[tuple(face.landmarks.points[4, 1::-1].astype(int))] == 1
        assert inner[face.surface.coverage == 0].max() == 0
        assert ((inner > 0) & (inner < 1)).any()

    def test_shrunk(self, face):
        """A wider rim leaves a smaller core."""
        whole, shrunk = (
            core(face.everywhere, face.everywhere, face.onto_itself, face.landmarks, shrink=s) for s in (0, 0.2)
        )
        assert 0 < shrunk.sum() < 0.9 * whole.sum()

    def test_a_brow_is_used_as_a_whole_or_not_at_all(self, face):
        """Where hair hides half of a brow of the reference, that whole brow stays the input's; the other is painted."""
        half = face.everywhere
        half[:, : int(face.landmarks.points[105, 0])] = 0
        found = correspond(face.surface, face.mesh, face.surface, face.mesh, face.everywhere, half, hidden="input")
        inner = core(face.everywhere, face.everywhere, found, face.landmarks, face.features)
        brows = face.features.brows > 0.5
        left = np.arange(200) < face.landmarks.points[168, 0]
        assert inner[brows & left].max() == 0
        assert inner[brows & ~left].mean() > 0.5

    def test_small_holes_are_filled(self, face):
        """A nostril that corresponds to nothing is painted along; a large hole is not."""
        x, y = face.landmarks.points[4, :2].astype(int)
        small, large = face.everywhere, face.everywhere
        small[y - 3 : y + 4, x - 3 : x + 4] = 0
        large[y - 20 : y + 21, x - 20 : x + 21] = 0
        filled, hole = (core(face.everywhere, s, face.onto_itself, face.landmarks)[y, x] for s in (small, large))
        assert (filled, hole) == (1, 0)

    def test_nothing_is_painted_on_occluders(self, face):
        """Where something covers the skin the core is 0."""
        inner = core(face.everywhere, face.everywhere, face.onto_itself, face.landmarks, face.features, face.everywhere)
        assert inner.max() == 0

    def test_what_both_photos_hide_is_not_painted(self, face):
        """A point may have a counterpart that is no visible skin of the reference."""
        left = face.everywhere
        left[:, 100:] = 0
        inner = core(
            face.everywhere, face.everywhere, face.onto_itself, face.landmarks, face.features, reference_skin=left
        )
        assert inner[:, :100].max() > 0
        assert inner[:, 100:].max() == 0

    def test_nothing_in_common_is_reported(self, face):
        """Without any usable pixel the core is empty, with a warning."""
        with pytest.warns(GraphfaceWarning, match="nothing is painted"):
            assert core(face.nowhere, face.nowhere, face.onto_itself, face.landmarks).max() == 0
