"""Correspondence through two meshes."""

import numpy as np
import pytest

from graphface import GraphfaceWarning, UsageError
from graphface.nodes.render.head import head
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Mesh, Pins
from graphface.nodes.warp.mesh import mesh as correspond


def pixels_of(inside):
    y, x = np.mgrid[: inside.shape[0], : inside.shape[1]]
    return np.dstack([x, y])


class TestMesh:
    def test_a_face_onto_itself_stays_in_place(self, make_face):
        """Every pixel of the mesh corresponds to itself, and all of them are valid."""
        _, _, mesh, surface = make_face(yaw=30)
        found = correspond(surface, mesh, surface, mesh)
        apart = np.abs(found.places - pixels_of(found.inside)).max(axis=2)
        assert apart[found.inside > 0].max() < 1e-2
        assert found.valid[found.inside > 0].min() > 0.999

    def test_a_moved_face_moves(self, make_face):
        """The same face elsewhere in the picture is found there."""
        _, _, mesh, surface = make_face()
        _, _, other, other_surface = make_face(shift=(7, -4))
        found = correspond(surface, mesh, other_surface, other)
        moved = (found.places - pixels_of(found.inside))[found.inside > 0]
        np.testing.assert_allclose(moved, np.broadcast_to((7, -4), moved.shape), atol=1e-2)

    def test_a_turned_reference_hides_its_far_cheek(self, make_face):
        """Of a profile one half is valid, the other comes from its mirror image."""
        _, _, mesh, surface = make_face()
        _, _, other, other_surface = make_face(yaw=70)
        found = correspond(surface, mesh, other_surface, other)
        half = found.inside.shape[1] // 2
        shares = [found.valid[:, s][found.inside[:, s] > 0].mean() for s in (slice(0, half), slice(half, None))]
        assert min(shares) < 0.3
        assert max(shares) > 0.8
        assert found.known[found.inside > 0].mean() > max(shares) - 0.1

    def test_no_line_between_a_point_and_its_mirror_image(self, make_face):
        """On the way from the half that is shown to the one that is not, every pixel is known by one of the two."""
        _, _, mesh, surface = make_face(size=320)
        _, _, other, other_surface = make_face(size=320, yaw=40)
        found = correspond(surface, mesh, other_surface, other)
        between = (found.valid > 0.1) & (found.valid < 0.9) & (found.inside > 0)
        # The mirror image of what lies near the middle may be hidden itself.
        away = np.abs(pixels_of(found.inside)[..., 0] - 160) > 20
        assert between[away].any()
        assert (found.known[between & away] > 0.5).mean() > 0.95

    def test_a_face_onto_itself_needs_no_mirror_image(self, make_face):
        """Nothing is hidden, and what lies beyond the mesh does not count."""
        _, _, mesh, surface = make_face(yaw=30)
        assert correspond(surface, mesh, surface, mesh).mirrored_valid.max() == 0

    def test_a_head_has_no_other_half(self, make_face):
        """Skull and neck added to a face correspond by themselves; the face's own points still have mirror images."""
        _, _, mesh, _ = make_face()
        photo, _, other, _ = make_face(yaw=50)
        heads = [head(m) for m in (mesh, other)]
        surfaces = [rasterize(m, photo) for m in heads]
        found = correspond(surfaces[0], heads[0], surfaces[1], heads[1])
        assert len(heads[0].vertices) > len(mesh.vertices)
        assert np.isfinite(found.mirrored).all()
        assert found.mirrored_valid.max() > 0.9

    def test_hidden_parts_may_stay_the_inputs(self, make_face):
        """Without mirroring what is hidden is known nowhere."""
        _, _, mesh, surface = make_face()
        _, _, other, other_surface = make_face(yaw=70)
        found = correspond(surface, mesh, other_surface, other, hidden="input")
        assert found.mirrored is None
        np.testing.assert_array_equal(found.known, found.valid)

    def test_beyond_the_frame_is_not_valid(self, make_face):
        """A reference cut by its frame shows only the part inside."""
        _, _, mesh, surface = make_face()
        _, _, other, other_surface = make_face(shift=(80, 0))
        found = correspond(surface, mesh, other_surface, other, hidden="input")
        outside = (found.places[..., 0] > 160) & (found.inside > 0)
        assert outside.any()
        assert found.valid[outside].max() == 0

    def test_what_the_mask_leaves_out_is_not_valid(self, make_face):
        """An empty mask of the reference leaves nearly nothing to take."""
        _, _, mesh, surface = make_face()
        found = correspond(surface, mesh, surface, mesh, None, np.zeros_like(surface.coverage), hidden="input")
        assert found.valid.max() < 0.1

    def test_a_pin_beside_the_mesh(self, make_face):
        """A pin a few pixels off the face, where it and its place agree with the mesh, moves nothing."""
        _, _, mesh, surface = make_face()
        plain = correspond(surface, mesh, surface, mesh)
        columns = np.flatnonzero(plain.inside[90])
        beside = columns[-1] + 5
        found = correspond(surface, mesh, surface, mesh, pins=Pins(np.array([[beside, 90, beside, 90]], np.float32)))
        assert np.abs(found.places - plain.places)[plain.inside > 0].max() < 0.5

    def test_pins_are_met(self, make_face):
        """A correspondence set by hand is what comes out at its pixel, and far away nothing changes."""
        _, _, mesh, surface = make_face()
        pins = Pins(np.array([[80, 90, 86, 87]], np.float32))
        found = correspond(surface, mesh, surface, mesh, pins=pins, pin_reach=0.1)
        np.testing.assert_allclose(found.places[90, 80], (86, 87), atol=0.1)
        plain = correspond(surface, mesh, surface, mesh)
        np.testing.assert_allclose(found.places[50, 60], plain.places[50, 60], atol=0.1)

    def test_other_triangles(self, make_face):
        """Meshes of different models have no correspondence: an error that says so."""
        _, _, mesh, surface = make_face()
        other = Mesh(mesh.vertices, mesh.triangles[:-1], mesh.normals, mesh.camera, mesh.interocular)
        with pytest.raises(UsageError, match="same geometry node"):
            correspond(surface, mesh, surface, other)

    def test_an_empty_mesh_is_told(self, make_face):
        """A face outside of its photo corresponds to nothing, with a warning."""
        with pytest.warns(GraphfaceWarning, match="covers no pixel"):
            _, _, mesh, surface = make_face(shift=(1000, 0))
        _, _, other, other_surface = make_face()
        with pytest.warns(GraphfaceWarning, match="nothing corresponds"):
            assert correspond(surface, mesh, other_surface, other).known.max() == 0
