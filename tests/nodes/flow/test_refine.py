"""Optical flow refines a correspondence where that makes two faces match, and only there; whatever the method."""

from dataclasses import replace

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.node import operator_of
from graphface.nodes.flow.deepflow import deepflow
from graphface.nodes.flow.dis import dis
from graphface.nodes.flow.farneback import farneback
from graphface.nodes.flow.none import none
from graphface.nodes.flow.refine import flow_operator
from graphface.nodes.flow.tvl1 import tvl1
from graphface.nodes.types import Image
from graphface.nodes.warp.mesh import mesh as correspond
from graphface.registry import default_registry

METHODS = [dis, farneback, deepflow, tvl1]


def blobs(size: int, shift: float = 0.0) -> Image:
    """Dark and bright spots over the whole picture, moved to the right."""
    y, x = np.mgrid[:size, :size].astype(np.float32)
    x = x - np.float32(shift)
    waves = np.sin(x / 3.1) * np.cos(y / 3.7) + np.sin((x + y) / 5.3)
    return Image(np.repeat((0.5 + 0.15 * waves)[..., None], 3, axis=2).astype(np.float32))


@pytest.fixture
def pair(make_face):
    _, landmarks, mesh, surface = make_face(size=200, scale=0.5)
    return correspond(surface, mesh, surface, mesh), landmarks


def deep_inside(correspondence):
    import cv2

    return cv2.erode(correspondence.inside, np.ones((41, 41))) > 0


@pytest.mark.parametrize("method", METHODS)
class TestRefined:
    def test_a_shift_is_found(self, pair, method):
        """Where the reference's features lie 3 pixels beside what the meshes say, most of that is corrected."""
        correspondence, landmarks = pair
        got = method(blobs(200), blobs(200, shift=3.0), correspondence, landmarks)
        moved = (got.places - correspondence.places)[deep_inside(correspondence)]
        assert 1.5 < np.median(moved[:, 0]) < 3.5
        assert abs(np.median(moved[:, 1])) < 0.5

    def test_equal_pictures_stay(self, pair, method):
        """What matches already is not moved."""
        correspondence, landmarks = pair
        got = method(blobs(200), blobs(200), correspondence, landmarks)
        np.testing.assert_array_equal(got.places, correspondence.places)

    def test_flat_pictures_stay(self, pair, method):
        """Where there is nothing to match the meshes decide."""
        correspondence, landmarks = pair
        flat = Image(np.full((200, 200, 3), 0.5, np.float32))
        got = method(flat, flat, correspondence, landmarks)
        np.testing.assert_allclose(got.places, correspondence.places, atol=0.05)

    def test_unrelated_pictures_move_little(self, pair, method, rng):
        """Two fields of noise have no flow to trust: no place moves further than the reach."""
        correspondence, landmarks = pair
        one, other = (Image(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        got = method(one, other, correspondence, landmarks)
        assert np.isfinite(got.places).all()
        assert np.abs(got.places - correspondence.places).max() < 0.15 * landmarks.interocular


class TestSmallFaces:
    def test_too_small_to_match(self, make_face):
        """A face of a few pixels keeps the meshes' correspondence, with a warning."""
        photo, landmarks, mesh, surface = make_face(size=24, scale=0.25)
        correspondence = correspond(surface, mesh, surface, mesh)
        with pytest.warns(GraphfaceWarning, match="too few"):
            assert dis(photo, photo, correspondence, landmarks) is correspondence

    def test_nothing_inside(self, pair):
        """Without any mesh in the picture nothing is done."""
        correspondence, landmarks = pair
        empty = replace(correspondence, inside=np.zeros_like(correspondence.inside))
        assert dis(blobs(200), blobs(200), empty, landmarks) is empty


class TestFlowOperator:
    @pytest.mark.parametrize(("method", "resolution"), [(dis, 90), (farneback, 100), (deepflow, 60), (tvl1, 60)])
    def test_declares_the_shared_ports_and_parameters(self, method, resolution):
        """Each method is an operator of its own name, with its own default resolution and its paper in the help."""
        operator = operator_of(method)
        assert operator.name == f"flow.{method.__name__}"
        assert list(operator.inputs) == ["photo", "reference", "correspondence", "landmarks"]
        assert operator.parameters().model_dump() == {
            "resolution": resolution,
            "smoothing": 0.1,
            "tolerance": 0.03,
            "reach": 0.15,
        }
        assert operator.doc.splitlines()[0].endswith((".", ":"))
        assert "smoothing:" in operator.doc

    def test_one_of_our_own(self, pair):
        """Any function from two grey pictures to displacements becomes an operator."""

        @flow_operator("flow.shift", resolution=50)
        def shift(source, target):
            """Everything moves by one pixel."""
            return np.ones((*source.shape, 2), np.float32)

        correspondence, landmarks = pair
        moved = shift(blobs(200), blobs(200, 3), correspondence, landmarks)
        assert np.isfinite(moved.places).all()

    def test_methods_are_interchangeable(self):
        """Any of them, or none, may stand where another stands."""
        registry = default_registry()
        names = {o.name for o in registry.alternatives(registry.operator("flow.dis"))}
        assert names == {"flow.none", "flow.farneback", "flow.deepflow", "flow.tvl1"}


class TestNone:
    def test_is_the_identity(self, pair):
        """The correspondence as it comes."""
        correspondence, landmarks = pair
        assert none(blobs(200), blobs(200, 3), correspondence, landmarks) is correspondence
