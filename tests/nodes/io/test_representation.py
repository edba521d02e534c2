"""The representation as one file."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphface import UnreadableFile, load
from graphface.nodes.detail.split import split as split_detail
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.io.representation import read_representation, write_representation
from graphface.nodes.render.surroundings import surroundings
from graphface.nodes.representation.bundle import bundle
from graphface.nodes.sh.render import render as render_light
from graphface.nodes.types import Camera, Image, Landmarks, Lighting, Mesh, Segmentation, Surface
from graphface.values.digest import digest_value

GRAPH = """graphface: 1
inputs: {saved: Representation}
nodes: {s: {use: surface.rasterize, in: {mesh: saved.mesh, photo: saved.working}}}
outputs: {s: s}
"""


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


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        (lambda r: replace(r, mesh=replace(r.mesh, triangles=np.int32([[0, 1, 3]]))), "mesh: triangles has indices"),
        (lambda r: replace(r, mesh=replace(r.mesh, triangles=np.int32([[0, 1, 1 << 30]]))), "mesh: triangles"),
        (lambda r: replace(r, mesh=replace(r.mesh, triangles=r.mesh.triangles * 1.0)), "expected int32"),
        (lambda r: replace(r, surface=replace(r.surface, triangle=r.surface.triangle + 1)), "surface.triangle"),
        (lambda r: replace(r, head=replace(r.head, vertices=r.head.vertices[:2])), "head: "),
        (lambda r: replace(r, mask=r.mask[:5]), "mask has the shape"),
        (lambda r: replace(r, mask=r.mask * 2), "mask: a Mask lies within 0 and 1"),
        (lambda r: replace(r, albedo=r.albedo * np.nan), "albedo: has values that are not numbers"),
        (lambda r: replace(r, landmarks=replace(r.landmarks, points=r.landmarks.points[:5])), "landmarks: points"),
        (lambda r: replace(r, surroundings=replace(r.surroundings, nearest=r.surroundings.nearest + 99)), "nearest"),
    ],
)
def test_parts_that_do_not_belong_together(representation, tmp_path, changed, said):
    """A file that somebody edited is an error that names file and part, and never reaches an operator."""
    path = tmp_path / "a.face"
    write_representation(changed(representation), path)
    graph = load(GRAPH)
    with pytest.raises(UnreadableFile, match=said) as caught:
        graph.run(saved=path)
    assert str(path) in str(caught.value)


def test_as_written_it_enters(representation, tmp_path):
    """What a run wrote enters another."""
    write_representation(representation, tmp_path / "a.face")
    graph = load(GRAPH)
    assert graph.run(saved=tmp_path / "a.face").outputs["s"].coverage.shape == (12, 10)
