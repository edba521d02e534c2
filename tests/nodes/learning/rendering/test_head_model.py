"""ICT-FaceKit's whole head."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.learning.rendering.head_model import CAVITY, EYE, SKIN, TEETH, normals_of, read_head


class TestReadHead:
    def test_other_files(self, tmp_path):
        """What is no packed head is refused with the reason."""
        with pytest.raises(UnreadableFile, match="not a packed"):
            read_head(tmp_path / "none.npz")
        np.savez(tmp_path / "a.npz", mean=np.zeros((3, 3)))
        with pytest.raises(UnreadableFile, match="lacks"):
            read_head(tmp_path / "a.npz")
        face = {"faces": np.zeros((2, 4), int), "identity": [], "expression": [], "expression_names": []}
        np.savez(tmp_path / "face.npz", mean=np.zeros((3, 3)), landmarks68=np.zeros(68, int), **face)
        with pytest.raises(UnreadableFile, match="not the whole head"):
            read_head(tmp_path / "face.npz")

    def test_the_head(self, head):
        """It has skin, eyes, teeth and cavities, refined where relief stands, and closed triangles only."""
        vertices = head.refinement @ head.mean
        assert set(np.unique(head.part)) >= {SKIN, EYE, TEETH, CAVITY}
        assert len(vertices) == len(head.part)
        assert head.triangles.max() == len(vertices) - 1
        np.testing.assert_allclose(head.refinement.sum(axis=1), 1, atol=1e-9)
        front = vertices[(head.part == SKIN) & (vertices[:, 2] > 11)]
        normals = normals_of(vertices, head.triangles)[(head.part == SKIN) & (vertices[:, 2] > 11)]
        assert len(front) > 100
        assert normals[:, 2].mean() > 0.3  # the mouth and the nostrils fold back
