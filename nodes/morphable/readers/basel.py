"""The Basel face model: 2017 (HDF5, Gerig et al. 2018) and 2009 (MATLAB, Paysan et al. 2009). Needs a licence.

2017: groups `shape` and `expression` with `model/mean` (3V,), `model/pcaBasis` (3V, K, orthonormal),
`model/pcaVariance` (K,), and the triangles in `shape/representer/cells` (3, T). 2009: `shapeMU` (3V, 1), `shapePC`
(3V, K, orthonormal), `shapeEV` (K, 1, standard deviations), `tl` (T, 3, from 1, clockwise).
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile, UsageError
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.readers.assemble import assemble, with_facemesh_points
from graphface.nodes.morphable.readers.landmark_file import read_landmark_numbers

_LICENSE = "Basel Face Model licence (research; from the University of Basel)"


_NAMED = {
    "center.chin.tip": 8,
    "center.nose.tip": 30,
    "right.eye.corner_outer": 36,
    "right.eye.corner_inner": 39,
    "left.eye.corner_inner": 42,
    "left.eye.corner_outer": 45,
    "right.lips.corner": 48,
    "center.lips.upper.outer": 51,
    "left.lips.corner": 54,
    "center.lips.lower.outer": 57,
    "center.lips.upper.inner": 62,
    "center.lips.lower.inner": 66,
}
"""Names in the 2017 model's list of landmarks, and their iBUG points (from 0)."""


def read_basel(source: Path, landmarks: Path | None = None) -> MorphableModel:
    """The model of 2017 (.h5) or of 2009 (.mat).

    Args:
        landmarks: see `landmark_file`. The model of 2009 has none of its own, that of 2017 only a few.

    Raises:
        UnreadableFile: it is no such file.
        UsageError: h5py is missing, or the landmarks are.
    """
    if source.suffix.lower() == ".mat":
        return _read_2009(source, landmarks)
    return _read_2017(source, landmarks)


def _read_2017(path: Path, landmarks: Path | None) -> MorphableModel:
    try:
        import h5py
    except ImportError:
        raise UsageError("reading the Basel face model of 2017 needs h5py: pip install 'graphface[models]'") from None
    try:
        with h5py.File(path, "r") as file:
            mean = np.asarray(file["shape/model/mean"], np.float64)
            identity = _scaled(file["shape/model/pcaBasis"], np.sqrt(np.maximum(file["shape/model/pcaVariance"], 0)))
            cells = np.asarray(file["shape/representer/cells"], np.int64)
            expression = np.zeros((0, len(mean) // 3, 3))
            if "expression/model/pcaBasis" in file:
                mean = mean + np.asarray(file["expression/model/mean"], np.float64)
                deviations = np.sqrt(np.maximum(file["expression/model/pcaVariance"], 0))
                expression = _scaled(file["expression/model/pcaBasis"], deviations)
            listed = file["metadata/landmarks/json"][()] if "metadata/landmarks/json" in file else b"[]"
    except (OSError, ValueError) as error:
        raise UnreadableFile(path, f"not an HDF5 file: {error}") from error
    except KeyError as error:
        raise UnreadableFile(path, f"not a Basel face model of 2017: {error.args[0]}") from error
    shape = mean.reshape(-1, 3)
    points = read_landmark_numbers(landmarks) if landmarks is not None else _listed_landmarks(path, listed, shape)
    triangles = cells if cells.shape[-1] == 3 and cells.shape[0] != 3 else cells.T
    return _assembled(path, "basel2017", shape, triangles, identity, expression, points)


def _read_2009(path: Path, landmarks: Path | None) -> MorphableModel:
    from scipy.io import loadmat

    try:
        file = loadmat(path)
        mean = file["shapeMU"].reshape(-1).astype(np.float64)
        identity = _scaled(file["shapePC"], file["shapeEV"].reshape(-1))
        triangles = file["tl"].astype(np.int64)[:, ::-1] - 1
    except (OSError, ValueError, NotImplementedError) as error:
        raise UnreadableFile(path, f"not a MATLAB file: {error}") from error
    except KeyError as error:
        raise UnreadableFile(path, f"not the Basel face model of 2009: lacks {error.args[0]!r}") from None
    if landmarks is None:
        raise UsageError(f"{path}: the model of 2009 lists no landmarks; give --landmarks FILE with lines '37 = 2088'")
    shape = mean.reshape(-1, 3)
    points = read_landmark_numbers(landmarks)
    return _assembled(path, "basel2009", shape, triangles, identity, np.zeros((0, *shape.shape)), points)


def _assembled(
    path: Path,
    name: str,
    shape: NDArray[np.float64],
    triangles: NDArray[np.int64],
    identity: NDArray[np.float64],
    expression: NDArray[np.float64],
    points: NDArray[np.int32],
) -> MorphableModel:
    card = {"license": _LICENSE, "source": f"Basel Face Model ({path.name})"}
    model = assemble(path, name, shape, triangles, identity, expression, points, card=card)
    return with_facemesh_points(model)


def _scaled(basis: Any, deviations: NDArray[Any]) -> NDArray[np.float64]:
    """An orthonormal basis (3V, K) as displacements (K, V, 3) for one standard deviation."""
    columns = np.asarray(basis, np.float64) * np.asarray(deviations, np.float64)
    return columns.T.reshape(columns.shape[1], -1, 3)


def _listed_landmarks(path: Path, listed: Any, shape: NDArray[np.float64]) -> NDArray[np.int32]:
    """The landmarks in the file, each at the vertex nearest to its coordinates."""
    from scipy.spatial import cKDTree

    text = listed.decode("utf-8") if isinstance(listed, bytes) else str(listed)
    try:
        entries = {entry["id"]: entry["coordinates"] for entry in json.loads(text)}
    except (ValueError, KeyError, TypeError) as error:
        raise UnreadableFile(path, f"its list of landmarks cannot be read: {error}") from error
    points = np.full(68, -1, np.int32)
    tree = cKDTree(shape)
    for name, number in _NAMED.items():
        if name in entries:
            points[number] = tree.query(entries[name])[1]
    if (points >= 0).sum() < 6:
        raise UsageError(f"{path}: lists fewer than 6 known landmarks; give --landmarks FILE with lines '37 = 2088'")
    return points
