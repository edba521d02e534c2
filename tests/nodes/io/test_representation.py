"""The representation as one file."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.detail.split import split as split_detail
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.io.representation import read_representation, write_representation
from graphface.nodes.render.surroundings import surroundings
from graphface.nodes.representation.bundle import bundle
from graphface.nodes.sh.render import render as render_light
from graphface.nodes.types import Camera, Image, Landmarks, Lighting, Mesh, Segmentation, Surface
from graphface.values.digest import digest_value


@pytest.fixture
def representation(rng):
    pixels = rng.random((12, 10, 3)).astype(np.float32)
    photo, plane = Image(pixels), np.ones((12, 10), np.float32)
    normals = np.zeros((12, 10, 3), np.float32)
    normals[..., 2] = 1
    triangle = np.zeros((12, 10), np.int32)
    surface = Surface(normals, plane, plane, triangle, np.full((12, 10, 3), 1 / 3, np.float32))
    corners = rng.random((3, 3)).astype(np.float32)
    mesh = Mesh(corners, np.int32([[0, 1, 2]]), corners, Camera(2.0, (5.0, 6.0)), 4.0)
    landmarks = Landmarks(rng.random((468, 3)).astype(np.float32), "facemesh468")
    parts = intensity(photo)
    light = Lighting(np.float32([1, 0, 0.5, 0]))
    shading = render_light(light, normals)
    return bundle(
        working=photo,
        landmarks=landmarks,
        mesh=mesh,
        surface=surface,
        mask=plane,
        labels=Segmentation(plane, plane * 0, plane * 0),
        head=mesh,
        head_surface=surface,
        head_mask=plane,
        surroundings=surroundings(plane, surface, landmarks),
        albedo=parts.albedo,
        shading=parts.shading,
        light=light,
        estimated=shading,
        spread=shading,
        detail=split_detail(photo, parts.albedo, shading),
    )


class TestRepresentation:
    def test_comes_back_as_it_was(self, representation, tmp_path):
        """Every array, number and word."""
        write_representation(representation, tmp_path / "a.face")
        again = read_representation(tmp_path / "a.face")
        assert digest_value(again) == digest_value(representation)

    def test_optional_parts_may_be_absent(self, representation, tmp_path):
        """An additive detail map has neither gain nor pivot."""
        additive = replace(representation, detail=replace(representation.detail, gain=None, pivot=None))
        write_representation(additive, tmp_path / "a.face")
        assert read_representation(tmp_path / "a.face").detail.gain is None

    @pytest.mark.parametrize("keep", [0, 7, 200, -1])
    def test_damaged_files_are_refused(self, representation, tmp_path, keep):
        """A file cut short is an error that names it, not a traceback."""
        path = tmp_path / "a.face"
        write_representation(representation, path)
        path.write_bytes(path.read_bytes()[:keep])
        with pytest.raises(UnreadableFile, match=r"a\.face"):
            read_representation(path)

    def test_other_files_are_refused(self, tmp_path):
        """Nothing there, or safetensors of something else."""
        from safetensors.numpy import save_file

        with pytest.raises(UnreadableFile, match="no such file"):
            read_representation(tmp_path / "none.face")
        save_file({"a": np.zeros(3)}, tmp_path / "other.face")
        with pytest.raises(UnreadableFile, match="representation"):
            read_representation(tmp_path / "other.face")
