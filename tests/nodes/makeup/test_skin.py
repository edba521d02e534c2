"""The skin that may be painted."""

import numpy as np

from graphface.nodes.makeup.skin import skin
from graphface.nodes.types import Segmentation


class TestSkin:
    def test_inside_of_the_mesh_geometry_decides(self, face):
        """A nose labelled background is skin; labelled hair, it is not."""
        nose = tuple(face.landmarks.points[4, 1::-1].astype(int))
        ones, zeros = face.everywhere, face.nowhere
        as_background = Segmentation(face=zeros, hair=zeros, background=ones)
        assert skin(as_background, face.surface, face.landmarks, face.features)[nose] > 0.9
        as_hair = Segmentation(face=zeros, hair=ones, background=zeros)
        assert skin(as_hair, face.surface, face.landmarks, face.features).max() == 0

    def test_near_the_outline_the_label_decides(self, face):
        """In the mesh's rim what is labelled background is not skin."""
        as_background = Segmentation(face=face.nowhere, hair=face.nowhere, background=face.everywhere)
        x, y = face.landmarks.points[10, :2].astype(int)  # the top of the forehead
        assert face.surface.coverage[y + 2, x] == 1
        assert skin(as_background, face.surface, face.landmarks, face.features)[y + 2, x] == 0

    def test_given(self, face):
        """A user's mask is returned as it is."""
        mask = np.full((200, 200), 0.25, np.float32)
        assert skin(Segmentation(mask, mask, mask), face.surface, face.landmarks, face.features, mask) is mask
