"""Rasterizing: exact barycentrics, visibility, and meshes that are hard to draw."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning
from graphface.nodes.rasterize import rasterized
from graphface.nodes.types import Camera, Mesh


def dome(width=60.0, center=(50.0, 40.0), steps=12, nearness=0.0):
    """A bulging square patch, counter-clockwise seen from outside."""
    line = np.linspace(-1, 1, steps)
    x, y = (a.ravel() for a in np.meshgrid(line, line))
    vertices = np.stack([x, y, np.sqrt(2.5 - x * x - y * y) - 1], axis=1) * width / 2
    index = np.arange(steps * steps).reshape(steps, steps)
    a, b, c, d = index[:-1, :-1].ravel(), index[:-1, 1:].ravel(), index[1:, :-1].ravel(), index[1:, 1:].ravel()
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([b, d, c], 1)]).astype(np.int32)
    normals = vertices + np.array([0, 0, width / 2])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    camera = Camera(1.0, center, nearness)
    return Mesh(vertices.astype(np.float32), triangles, normals.astype(np.float32), camera, width / 2)


def triangle(corners, z=(0.0, 0.0, 0.0)):
    """One triangle given by pixels (x right, y down), wound so as to face the camera."""
    corners = np.asarray(corners, float)
    a, b = corners[1] - corners[0], corners[2] - corners[0]
    order = [0, 1, 2] if a[1] * b[0] - a[0] * b[1] > 0 else [0, 2, 1]
    vertices = np.column_stack([corners[:, 0], -corners[:, 1], z]).astype(np.float32)
    normals = np.tile(np.float32([0, 0, 1]), (3, 1))
    return Mesh(vertices, np.array([order], np.int32), normals, Camera(), 10.0)


def inside(corners, height, width):
    """Pixel centers surely and possibly within a triangle; on its edges both are allowed."""
    y, x = np.mgrid[:height, :width]
    sides = []
    for k in range(3):
        (ax, ay), (bx, by) = corners[k], corners[k - 1]
        sides.append((bx - ax) * (y - ay) - (by - ay) * (x - ax))
    sides = np.stack(sides)
    return (sides > 1e-2).all(0) | (sides < -1e-2).all(0), (sides >= -1e-2).all(0) | (sides <= 1e-2).all(0)


class TestCoverage:
    def test_pixel_centers_are_at_integers(self):
        """A pixel is covered exactly where its integer coordinates lie in the triangle."""
        corners = [(10.3, 12.2), (50.7, 20.1), (20.5, 55.9)]
        surface = rasterized(triangle(corners), (64, 64))
        surely, possibly = inside(corners, 64, 64)
        covered = surface.coverage > 0
        assert covered[surely].all()
        assert possibly[covered].all()

    def test_back_faces_are_not_drawn(self):
        """A triangle that faces away leaves no trace."""
        mesh = triangle([(5, 5), (30, 6), (6, 30)])
        away = Mesh(mesh.vertices, mesh.triangles[:, ::-1].copy(), mesh.normals, mesh.camera, mesh.interocular)
        with pytest.warns(GraphfaceWarning, match="covers no pixel"):
            assert not rasterized(away, (40, 40)).coverage.any()

    def test_the_nearer_triangle_hides_the_farther(self):
        """Of two overlapping triangles the one with larger z is seen."""
        near, far = triangle([(0, 0), (30, 0), (0, 30)], (5, 5, 5)), triangle([(0, 0), (30, 0), (0, 30)])
        vertices = np.concatenate([far.vertices, near.vertices])
        triangles = np.concatenate([far.triangles, near.triangles + 3])
        mesh = Mesh(vertices, triangles, np.concatenate([far.normals, near.normals]), Camera(), 10.0)
        surface = rasterized(mesh, (32, 32))
        assert set(np.unique(surface.triangle)) == {-1, 1}
        np.testing.assert_allclose(surface.depth[surface.coverage > 0], 5)


class TestBarycentric:
    @pytest.mark.parametrize("nearness", [0.0, 1 / 300])
    @pytest.mark.parametrize("center", [(50.0, 40.0), (-10.3, 70.7), (95.5, 3.25)])
    def test_lead_back_to_the_pixel(self, nearness, center):
        """Their point projects onto the pixel's center within 0.01 px, also for a mesh cut by the frame."""
        mesh = dome(center=center, nearness=nearness)
        surface = rasterized(mesh, (80, 100))
        rows, columns = np.nonzero(surface.coverage)
        corners = mesh.vertices[mesh.triangles[surface.triangle[rows, columns]]]
        points = np.einsum("pk,pkc->pc", surface.barycentric[rows, columns], corners)
        assert len(rows) > 100
        np.testing.assert_allclose(mesh.camera.project(points), np.stack([columns, rows], 1), atol=0.01)
        np.testing.assert_allclose(surface.depth[rows, columns], points[:, 2], atol=1e-3)

    def test_sum_to_one_where_covered(self):
        """They are a partition of one on the mesh and zero elsewhere."""
        surface = rasterized(dome(), (80, 100))
        np.testing.assert_allclose(surface.barycentric.sum(axis=2), surface.coverage, atol=1e-6)


class TestNormals:
    def test_are_unit_on_the_mesh_and_zero_elsewhere(self):
        """Lengths are 1 or 0."""
        surface = rasterized(dome(), (80, 100), smoothing=0.1)
        np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=2), surface.coverage, atol=1e-5)

    def test_smoothing_keeps_a_plane(self):
        """Equal normals are not changed by smoothing, not even at the outline."""
        surface = rasterized(triangle([(5, 5), (60, 8), (10, 50)]), (64, 64), smoothing=0.3)
        np.testing.assert_allclose(
            surface.normals[surface.coverage > 0], [[0, 0, 1]] * int(surface.coverage.sum()), atol=1e-6
        )


class TestHardCases:
    @settings(max_examples=40, deadline=None)
    @given(
        st.lists(st.tuples(*[st.floats(-200, 200, width=32)] * 3), min_size=3, max_size=3),
        st.integers(1, 40),
        st.integers(1, 40),
    )
    @pytest.mark.filterwarnings("ignore::graphface.fallback.GraphfaceWarning")
    def test_any_triangle_gives_finite_maps(self, points, height, width):
        """Degenerate, huge, tiny or far outside: every map is finite, every triangle number exists."""
        corners = [(x, y) for x, y, _ in points]
        surface = rasterized(triangle(corners, [z for *_, z in points]), (height, width))
        for values in (surface.normals, surface.depth, surface.coverage, surface.barycentric):
            assert np.isfinite(values).all()
        assert surface.triangle.min() >= -1
        assert surface.triangle.max() <= 0

    def test_a_face_of_one_pixel(self):
        """A mesh about a pixel large is drawn as that pixel."""
        surface = rasterized(dome(width=1.2, center=(5.0, 5.0)), (11, 11))
        assert np.argwhere(surface.coverage).tolist() == [[5, 5]]

    def test_collapsed_triangles_are_left_out(self):
        """Zero-area triangles beside proper ones do no harm."""
        mesh = dome()
        triangles = np.concatenate([mesh.triangles, mesh.triangles[:, [0, 0, 1]]])
        more = Mesh(mesh.vertices, triangles, mesh.normals, mesh.camera, mesh.interocular)
        np.testing.assert_array_equal(rasterized(more, (80, 100)).depth, rasterized(mesh, (80, 100)).depth)

    def test_outside_the_frame_warns(self):
        """A mesh outside the picture gives empty maps and a warning."""
        with pytest.warns(GraphfaceWarning, match="covers no pixel"):
            surface = rasterized(dome(center=(-500.0, 0.0)), (20, 20))
        assert (surface.triangle == -1).all()


class TestHoles:
    def test_edges_through_pixel_centers_leave_no_crack(self):
        """Two triangles that share an edge through pixel centers cover it."""
        vertices = np.float32([[10, -5, 0], [40, -5, 0], [40, -35, 0], [10, -35, 0]])
        triangles = np.int32([[0, 3, 1], [1, 3, 2]])
        mesh = Mesh(vertices, triangles, np.tile(np.float32([0, 0, 1]), (4, 1)), Camera(), 10.0)
        assert rasterized(mesh, (50, 50)).coverage[6:35, 11:40].all()

    def test_a_fold_is_closed(self):
        """A triangle that faces away is drawn inside the surface, and not at its outline."""
        mesh = dome(steps=8)
        inner = len(mesh.triangles) // 4
        triangles = mesh.triangles.copy()
        triangles[inner] = triangles[inner, ::-1]
        folded = Mesh(mesh.vertices, triangles, mesh.normals, mesh.camera, mesh.interocular)
        whole, closed = rasterized(mesh, (80, 100)), rasterized(folded, (80, 100))
        np.testing.assert_array_equal(closed.coverage, whole.coverage)
        np.testing.assert_allclose(closed.depth, whole.depth, atol=1e-3)
