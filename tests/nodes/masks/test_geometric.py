"""Three masks from the projected geometry."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at, portrait, surface_of

from graphface import GraphfaceWarning
from graphface.nodes.masks.geometric import dilated, eroded, geometric
from graphface.nodes.types import Image
from graphface.testing import check_node


@pytest.fixture
def head():
    photo, landmarks, labels = portrait()
    return photo, landmarks, surface_of(landmarks, labels.shape), labels


class TestGeometric:
    def test_nested(self, head):
        """Conservative within normal within aggressive."""
        masks = geometric(*head[:3])
        assert (masks.conservative <= masks.normal).all()
        assert (masks.normal <= masks.aggressive).all()
        assert 0 < masks.conservative.sum() < masks.normal.sum() < masks.aggressive.sum()

    def test_conservative_is_face(self, head):
        """Nothing but face is surely face."""
        assert (head[3][geometric(*head[:3]).conservative > 0] == 0).all()

    def test_normal_holds_the_hair(self, head):
        """Cranium and ears belong to face and head."""
        assert (geometric(*head[:3]).normal[head[3] == 1] > 0).mean() > 0.98

    def test_head_as_the_mesh_has_it(self, head):
        """With a mesh of the whole head no solids are added."""
        masks = geometric(*head[:3], head="mesh")
        assert masks.normal.sum() < 0.8 * geometric(*head[:3]).normal.sum()

    def test_node(self, head):
        """It keeps an operator's promises."""
        check_node(geometric, *head[:3])

    def test_face_outside_the_frame(self):
        """No pixel of a face: empty masks, said."""
        landmarks = landmarks_at(5000, 5000, 20)
        with pytest.warns(GraphfaceWarning, match="outside"):
            masks = geometric(Image(np.zeros((20, 20, 3), np.float32)), landmarks, surface_of(landmarks, (20, 20)))
        assert not masks.aggressive.any()

    @pytest.mark.parametrize("interocular", [0.5, 2, 6])
    def test_a_tiny_face_keeps_a_pixel(self, interocular):
        """A face of a few pixels still has a surest part."""
        landmarks = landmarks_at(10, 10, interocular)
        photo = Image(np.zeros((20, 20, 3), np.float32))
        assert geometric(photo, landmarks, surface_of(landmarks, (20, 20))).conservative.any()


class TestMorphology:
    def test_frame_is_no_edge(self):
        """A full mask stays full when it shrinks, an empty one empty when it grows."""
        full = np.ones((5, 5), np.float32)
        assert eroded(full, 2).all()
        assert not dilated(0 * full, 2).any()

    def test_radius(self):
        """A pixel grows to the disc of the radius."""
        dot = np.zeros((9, 9), np.float32)
        dot[4, 4] = 1
        assert dilated(dot, 2)[4].tolist() == [0, 0, 1, 1, 1, 1, 1, 0, 0]
