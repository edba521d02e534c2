"""FLAME."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.morphable.readers import read_model


def pathlib_touch(path):
    """An object whose unpickling would make a file."""

    class Trap:
        def __reduce__(self):
            return (open, (str(path), "w"))

    return Trap()


class TestFlame:
    def write(self, path, face, extra=None):
        mean, triangles, identity, _, _ = face
        directions = np.zeros((len(mean), 3, 301))
        directions[..., :2] = identity.transpose(1, 2, 0)
        weights = np.zeros((len(mean), 5))
        weights[:, 0], weights[mean[:, 1] < mean[:, 1].mean(), 2] = 1, 1
        joints = np.full((5, len(mean)), 1 / len(mean))
        data = {"v_template": mean, "shapedirs": directions, "f": triangles, "weights": weights, "J_regressor": joints}
        path.write_bytes(pickle.dumps({**data, **(extra or {})}, protocol=2))

    def test_reads_arrays_and_the_jaw(self, face, numbers, tmp_path):
        """Identity, expression and the opening of the jaw."""
        self.write(tmp_path / "flame.pkl", face)
        model = read_model(tmp_path / "flame.pkl", landmarks=numbers)
        assert model.expression.names == ("expression 0", "jaw open")
        assert len(model.identity) == 300
        moved = np.abs(model.expression.directions[1]).sum(axis=1) > 0
        assert moved.any()
        assert not moved.all()

    def test_the_embedding_beside_it_gives_the_landmarks(self, face, tmp_path):
        """The 51 inner points come from the file that FLAME has for them."""
        self.write(tmp_path / "flame.pkl", face)
        triangles, points = face[1], face[4]
        faces = [int(np.flatnonzero((triangles == p).any(axis=1))[0]) for p in points[17:]]
        weights = np.stack([(triangles[f] == p) * 0.8 + 0.1 for f, p in zip(faces, points[17:], strict=True)])
        data = pickle.dumps({"lmk_face_idx": np.array(faces), "lmk_b_coords": weights}, protocol=2)
        (tmp_path / "flame_static_embedding.pkl").write_bytes(data)
        found = read_model(tmp_path / "flame.pkl").landmarks["ibug68"]
        assert (found[:17] == -1).all()
        assert (found[17:] >= 0).all()

    def test_code_in_a_pickle_does_not_run(self, face, numbers, tmp_path):
        """A pickle that asks for anything but arrays is refused."""
        self.write(tmp_path / "flame.pkl", face, {"trap": pathlib_touch(tmp_path / "ran")})
        with pytest.raises(UnreadableFile, match="no array"):
            read_model(tmp_path / "flame.pkl", landmarks=numbers)
        assert not (tmp_path / "ran").exists()
