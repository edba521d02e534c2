"""Three masks from the projected geometry."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at, portrait, surface_of

from graphface import GraphfaceWarning
from graphface.nodes.masks.geometric import geometric
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
        """The conservative mask holds face alone."""
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
        """No pixel of a face: empty masks and a warning."""
        landmarks = landmarks_at(5000, 5000, 20)
        with pytest.warns(GraphfaceWarning, match="outside"):
            masks = geometric(Image(np.zeros((20, 20, 3), np.float32)), landmarks, surface_of(landmarks, (20, 20)))
        assert not masks.aggressive.any()

    @pytest.mark.parametrize("interocular", [0.5, 2, 6])
    def test_a_tiny_face_keeps_a_pixel(self, interocular):
        """The conservative mask of a face of a few pixels is not empty."""
        landmarks = landmarks_at(10, 10, interocular)
        photo = Image(np.zeros((20, 20, 3), np.float32))
        assert geometric(photo, landmarks, surface_of(landmarks, (20, 20))).conservative.any()
