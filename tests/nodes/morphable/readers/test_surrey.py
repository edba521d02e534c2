"""The Surrey face model."""

from __future__ import annotations

import json
import struct

import numpy as np
import pytest
from expected import agrees

from graphface import UnreadableFile
from graphface.nodes.morphable.readers import read_model


class TestSurrey:
    def write(self, folder, face):
        mean, triangles, identity, expression, points = face

        def matrix(values):
            return struct.pack("<ii", *values.shape) + values.T.astype("<f4").tobytes()

        columns = identity.reshape(len(identity), -1).T
        sizes = np.linalg.norm(columns, axis=0)
        data = (
            struct.pack("<I", 1) + matrix(mean.reshape(-1, 1)) + matrix(columns / sizes) + matrix(sizes[:, None] ** 2)
        )
        data += struct.pack("<Q", len(triangles)) + triangles.astype("<i4").tobytes()
        (folder / "sfm_shape_1.bin").write_bytes(data)
        shapes = struct.pack("<Q", 1) + struct.pack("<Q", 5) + b"smile" + matrix(expression[0].reshape(-1, 1))
        (folder / "expression_blendshapes_1.bin").write_bytes(shapes)
        (folder / "ibug_to_sfm.txt").write_text(
            "".join(f"{k + 1} = {v}\n" for k, v in enumerate(points) if k == 8 or k > 16)
        )
        jaw = {"right_contour": points[:8].tolist(), "left_contour": points[16:8:-1].tolist()}
        (folder / "sfm_model_contours.json").write_text(json.dumps({"model_contour": jaw}))

    def test_reads_eos_files(self, face, tmp_path):
        """Shape, blendshapes, mapping and contours of eos."""
        self.write(tmp_path, face)
        model = read_model(tmp_path)
        agrees(model)
        assert model.expression.names == ("smile",)
        np.testing.assert_allclose(model.mean[model.landmarks["ibug68"][:17], 0] > 1e-4, np.arange(17) > 8)

    @pytest.mark.parametrize("keep", [3, 50, 5000])
    def test_half_files_are_refused(self, face, tmp_path, keep):
        """A file that ends in the middle is named."""
        self.write(tmp_path, face)
        shape = tmp_path / "sfm_shape_1.bin"
        shape.write_bytes(shape.read_bytes()[:keep])
        with pytest.raises(UnreadableFile, match=r"sfm_shape_1\.bin"):
            read_model(tmp_path)

    def test_the_real_one(self, shared):
        """The Surrey face model as eos ships it: 3448 vertices and the mouth closed, 63 and 6 directions."""
        model = read_model(shared / "models" / "sfm")
        assert (len(model.identity), len(model.expression)) == (63, 6)
        assert len(model.mean) == 3449
        assert (model.landmarks["ibug68"] >= 0).sum() == 66
