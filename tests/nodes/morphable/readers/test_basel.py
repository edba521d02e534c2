"""The Basel face models."""

from __future__ import annotations

import json

import numpy as np
import pytest
from expected import agrees

from graphface import UnreadableFile, UsageError
from graphface.nodes.morphable.readers import read_model


class TestBasel:
    def test_2017(self, face, numbers, tmp_path):
        """HDF5 with shape and expression."""
        h5py = pytest.importorskip("h5py")
        mean, triangles, identity, expression, _ = face
        path = tmp_path / "model2017.h5"
        with h5py.File(path, "w") as file:
            for name, basis, center in (("shape", identity, mean), ("expression", expression, 0 * mean)):
                columns = basis.reshape(len(basis), -1).T
                sizes = np.linalg.norm(columns, axis=0)
                file[f"{name}/model/mean"] = center.ravel()
                file[f"{name}/model/pcaBasis"] = columns / sizes
                file[f"{name}/model/pcaVariance"] = sizes**2
            file["shape/representer/cells"] = triangles.T
        agrees(read_model(path, landmarks=numbers))
        with pytest.raises(UsageError, match="--landmarks"):
            read_model(path)

    def test_2017_lists_its_own_landmarks(self, face, tmp_path):
        """Named landmarks are taken at the nearest vertex."""
        h5py = pytest.importorskip("h5py")
        from graphface.nodes.morphable.readers.basel import _NAMED

        mean, triangles, identity, _, points = face
        path = tmp_path / "model2017.h5"
        columns = identity.reshape(2, -1).T
        sizes = np.linalg.norm(columns, axis=0)
        with h5py.File(path, "w") as file:
            file["shape/model/mean"], file["shape/model/pcaBasis"] = mean.ravel(), columns / sizes
            file["shape/model/pcaVariance"], file["shape/representer/cells"] = sizes**2, triangles.T
            listed = [{"id": n, "coordinates": mean[points[k]].tolist()} for n, k in _NAMED.items()]
            file["metadata/landmarks/json"] = json.dumps(listed)
        found = read_model(path).landmarks["ibug68"]
        assert (found >= 0).sum() == len(_NAMED)

    def test_2009(self, face, numbers, tmp_path):
        """MATLAB: orthonormal columns and deviations, triangles from 1 and clockwise."""
        from scipy.io import savemat

        mean, triangles, identity, _, _ = face
        columns = identity.reshape(2, -1).T
        sizes = np.linalg.norm(columns, axis=0)
        content = {"shapeMU": mean.reshape(-1, 1), "shapePC": columns / sizes, "shapeEV": sizes[:, None]}
        savemat(tmp_path / "bfm.mat", {**content, "tl": triangles[:, ::-1] + 1})
        agrees(read_model(tmp_path / "bfm.mat", landmarks=numbers), expressions=0)
        with pytest.raises(UsageError, match="lists no landmarks"):
            read_model(tmp_path / "bfm.mat")

    def test_other_files_are_refused(self, tmp_path):
        """A file that is no HDF5 is named."""
        pytest.importorskip("h5py")
        (tmp_path / "model.h5").write_bytes(b"nothing of the kind")
        with pytest.raises(UnreadableFile, match="HDF5"):
            read_model(tmp_path / "model.h5")
