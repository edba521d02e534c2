"""From rendered examples to weights of the normals network."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.learning.normal_learning import learn_normals
from graphface.nodes.learning.rendering.example import FORMAT, Example, write_example


class TestLearnNormals:
    def test_no_face_is_left_out(self, tmp_path):
        """An example in which no face is found is left out, and the reason kept."""
        flat = np.full((64, 64), 1, np.uint8)
        photo = np.repeat(flat[..., None], 3, axis=2)
        write_example(Example(photo, photo.astype(np.int8), flat, flat, flat, {"format": FORMAT}), tmp_path / "0.npz")
        with pytest.raises(UnreadableFile, match="no two examples"):
            learn_normals(tmp_path, minutes=0)
        assert "no face" in next(tmp_path.glob("seen/*/0.txt")).read_text()
