"""What a fitted surface is good for: coordinates, visibility, textures, drawings, files."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import coefficients_of, landmarks_of, rotation_of
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import GraphfaceWarning, UnwritableFile, UsageError
from graphface.nodes.export.textured import textured
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.io.files import TEXTURED_MESH
from graphface.nodes.io.mesh import write_mesh
from graphface.nodes.overlay.checkerboard import checkerboard
from graphface.nodes.overlay.depth import depth
from graphface.nodes.overlay.mesh import mesh as draw_mesh
from graphface.nodes.overlay.normals import normals
from graphface.nodes.surface.coordinates import coordinates
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.surface.visibility import visibility
from graphface.nodes.texture.project import project
from graphface.nodes.texture.unwrap import unwrap
from graphface.nodes.types import Camera, Image
from graphface.nodes.vertex_visibility import facing_camera

SIZE = (300, 400)


def seen(yaw=0.0, seed=1, center=(200.0, 150.0), near=0.0):
    """A photo, the fitted mesh and its surface, of a face about 150 pixels wide."""
    y, x = np.mgrid[: SIZE[0], : SIZE[1]].astype(np.float32)
    pixels = np.stack([x / SIZE[1], y / SIZE[0], 0.5 + 0.4 * np.sin(x / 25) * np.sin(y / 25)], axis=2)
    photo = Image(pixels.astype(np.float32))
    face = landmarks_of(
        coefficients=coefficients_of(seed, 0.5), rotation=rotation_of(yaw), scale=80, center=center, near=near
    )
    mesh = morphable(face, camera="assumed" if near else "weak")
    return photo, mesh, rasterize(mesh, photo)


class TestCoordinates:
    def test_are_the_same_point_on_any_face(self):
        """Where two different faces in different poses agree in coordinates, it is the same place of the model."""
        _, one, one_surface = seen(0, 1)
        _, other, other_surface = seen(25, 2)
        at = coordinates(one_surface, one)
        vertex = 4  # the nose tip
        x, y = np.rint(one.camera.project(one.vertices[vertex])).astype(int)
        there = coordinates(other_surface, other)
        nearest = np.linalg.norm(there - at[y, x], axis=2)
        found = np.unravel_index(nearest.argmin(), nearest.shape)[::-1]
        assert np.linalg.norm(found - other.camera.project(other.vertices[vertex])) < 2

    def test_off_the_face_there_are_none(self):
        """Minus one off the face, within [0, 1] on it."""
        _, mesh, surface = seen()
        at = coordinates(surface, mesh)
        assert (at[surface.coverage == 0] == -1).all()
        assert 0 <= at[surface.coverage > 0].min() <= at[surface.coverage > 0].max() <= 1

    def test_a_mesh_without_them_is_an_error(self):
        """The user is told which geometry has them."""
        _, mesh, surface = seen()
        with pytest.raises(UsageError, match=r"geometry\.morphable"):
            coordinates(surface, replace(mesh, uv=None))


class TestVisibility:
    def test_a_turned_head_hides_its_far_side(self):
        """Of a face turned right, the vertices far on its own far side are hidden, the near cheek is seen."""
        _, mesh, surface = seen(60)
        shown = visibility(surface, mesh)
        assert shown[234] > 0.9  # near the ear that is turned to the camera
        assert shown[454] == 0  # near the other
        assert 0.2 < shown.mean() < 0.9

    def test_outside_the_frame_nothing_is_seen(self):
        """Vertices beyond the picture's edge do not count as seen."""
        _, mesh, surface = seen(center=(0.0, 150.0))
        outside = mesh.camera.project(mesh.vertices)[:, 0] < -1
        assert outside.any()
        assert not visibility(surface, mesh)[outside].any()

    def test_a_near_camera_looks_past_the_sides(self):
        """Seen from near by, the same vertex turns further away than seen from afar."""
        _, mesh, _ = seen()
        near = replace(mesh, camera=replace(mesh.camera, nearness=1 / 300))
        side = int(np.argmax(mesh.vertices[:, 0]))
        assert facing_camera(near)[side] < facing_camera(mesh)[side]


class TestTexture:
    def test_goes_there_and_back(self):
        """Unwrapping and putting back changes the photo's face by little, and nothing else."""
        photo, mesh, surface = seen(15)
        back = project(unwrap(photo, mesh, surface, size=512), photo, mesh, surface)
        apart = np.abs(back.pixels - photo.pixels)
        assert apart[surface.coverage > 0].mean() < 0.01
        assert not apart[surface.coverage == 0].any()

    def test_hidden_texels_are_not_seen(self):
        """The far half of a turned face is marked as not seen, and left alone on another photo."""
        photo, mesh, surface = seen(60)
        texture = unwrap(photo, mesh, surface)
        half = texture.seen.shape[1] // 2
        assert texture.seen[:, :half].sum() > 3 * texture.seen[:, half:].sum()

    def test_no_face_in_the_frame_is_said(self):
        """An empty texture comes with a warning."""
        photo, mesh, _ = seen()
        away = replace(mesh, camera=Camera(center=(-5000.0, 0.0)))
        with pytest.warns(GraphfaceWarning):
            texture = unwrap(photo, away, rasterize(away, photo))
        assert not texture.seen.any()
        assert np.isfinite(texture.image.pixels).all()

    @given(st.integers(8, 80), st.floats(-40, 40))
    @settings(max_examples=6, deadline=None)
    def test_any_size(self, size, yaw):
        """Small textures too are finite and within the photo's range."""
        photo, mesh, surface = seen(yaw)
        texture = unwrap(photo, mesh, surface, size=size)
        assert texture.image.pixels.shape == (size, size, 3)
        assert photo.pixels.min() * 0 <= texture.image.pixels.min() <= texture.image.pixels.max() <= photo.pixels.max()


class TestOverlay:
    @pytest.mark.parametrize("draw", [draw_mesh, normals, depth, checkerboard])
    def test_draws_on_the_face_only(self, draw):
        """The face changes, the rest does not; values stay in range."""
        photo, mesh, surface = seen(20)
        arguments = {draw_mesh: (mesh,), checkerboard: (mesh, surface)}.get(draw, (surface,))
        drawn = draw(photo, *arguments).pixels
        change = np.abs(drawn - photo.pixels).max(axis=2)
        assert change[surface.coverage > 0].mean() > 0.02
        far = np.ones_like(change, bool)
        rows, columns = np.nonzero(surface.coverage)
        far[rows.min() - 3 : rows.max() + 4, columns.min() - 3 : columns.max() + 4] = False
        assert not change[far].any()
        assert 0 <= drawn.min() <= drawn.max() <= 1

    def test_squares_move_with_the_face(self):
        """The nose tip has the same square's color in two poses."""
        colors = []
        for yaw in (0, 25):
            photo, mesh, surface = seen(yaw)
            x, y = np.rint(mesh.camera.project(mesh.vertices[205])).astype(int)
            black = photo.with_pixels(photo.pixels * 0)
            colors.append(checkerboard(black, mesh, surface, cells=4, strength=1).pixels[y, x])
        np.testing.assert_allclose(*colors, atol=1e-6)


class TestExport:
    @pytest.mark.parametrize("suffix", [".obj", ".ply", ".glb", ".gltf"])
    def test_comes_back_with_every_vertex(self, tmp_path, suffix):
        """Vertices and triangles survive, with the texture and without."""
        trimesh = pytest.importorskip("trimesh")
        photo, mesh, surface = seen()
        texture = unwrap(photo, mesh, surface, size=64)
        write_mesh(mesh, tmp_path / f"plain{suffix}")
        TEXTURED_MESH.write(textured(mesh, texture), tmp_path / f"colored{suffix}")
        for name in ("plain", "colored"):
            back = trimesh.load(tmp_path / f"{name}{suffix}", force="mesh", process=False)
            assert len(back.faces) == len(mesh.triangles)
            np.testing.assert_allclose(back.vertices[back.faces], mesh.vertices[mesh.triangles], atol=0.01)

    def test_unknown_suffixes_are_refused(self, tmp_path):
        """The suffixes there are, are named."""
        pytest.importorskip("trimesh")
        with pytest.raises(UnwritableFile, match=r"\.glb"):
            write_mesh(seen()[1], tmp_path / "face.stl")

    def test_a_missing_package_is_said(self, tmp_path, monkeypatch):
        """Without trimesh the user is told what to install."""
        import sys

        monkeypatch.setitem(sys.modules, "trimesh", None)
        with pytest.raises(UsageError, match=r"graphface\[models\]"):
            write_mesh(seen()[1], tmp_path / "face.obj")
