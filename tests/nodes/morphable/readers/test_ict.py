"""ICT-FaceKit."""

from __future__ import annotations

import json

import numpy as np
import pytest
from expected import agrees

from graphface import UnreadableFile
from graphface.nodes.morphable.readers import guess_kind, read_model


class TestIct:
    def test_packed(self, face, tmp_path):
        """The packed form: differences to the mean, quads or triangles with the last corner twice."""
        mean, triangles, identity, expression, points = face
        path = tmp_path / "ict.npz"
        faces = np.column_stack([triangles, triangles[:, 2]])
        names = np.array(["jawOpen"])
        np.savez(
            path,
            mean=mean,
            faces=faces,
            identity=identity,
            expression=expression,
            expression_names=names,
            landmarks68=points,
        )
        model = read_model(path)
        agrees(model)
        assert model.expression.names == ("jawOpen",)

    def test_folder(self, face, tmp_path):
        """The makers' folder of OBJ files with vertex_indices.json."""
        mean, triangles, identity, expression, points = face
        shapes = {"generic_neutral_mesh": mean, "identity000": mean + identity[0], "identity001": mean + identity[1]}
        for name, shape in {**shapes, "jawOpen": mean + expression[0]}.items():
            lines = [f"v {x} {y} {z}" for x, y, z in shape] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
            (tmp_path / f"{name}.obj").write_text("\n".join(lines))
        (tmp_path / "vertex_indices.json").write_text(json.dumps({"idx_to_landmark_verts": points.tolist()}))
        assert guess_kind(tmp_path) == "ict"
        agrees(read_model(tmp_path))

    def test_other_archives_are_refused(self, tmp_path):
        """What lacks the arrays is named with the array."""
        np.savez(tmp_path / "other.npz", mean=np.zeros((4, 3)))
        with pytest.raises(UnreadableFile, match="faces"):
            read_model(tmp_path / "other.npz")
