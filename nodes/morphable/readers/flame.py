"""FLAME (Li et al., Learning a model of facial shape and expression from 4D scans, 2017). Needs a licence.

The makers distribute pickled dictionaries: `v_template` (V, 3), `shapedirs` (V, 3, 400: 300 identity, then expression),
`f` (T, 3), `weights` (V, joints), `J_regressor` (joints, V). Unpickling can run any code, so only arrays are allowed:
NumPy's, SciPy's sparse matrices, and the array in chumpy's wrapper. Skinning is not linear; its largest part, the
opening of the jaw, becomes one more expression, linearized about the closed mouth.
"""

from __future__ import annotations

import io
import pickle
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile, UsageError
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.readers.assemble import assemble, with_facemesh_points
from graphface.nodes.morphable.readers.landmark_file import read_landmark_numbers

_IDENTITIES = 300


_JAW = 2
"""FLAME's joints: global, neck, jaw, two eyes."""


_JAW_DEVIATION = 0.15
"""Radians of jaw opening taken as one standard deviation."""


_EMBEDDING = "flame_static_embedding.pkl"


_ALLOWED = {
    ("numpy", "dtype"),
    ("numpy", "ndarray"),
    ("numpy.core.multiarray", "_reconstruct"),
    ("numpy.core.multiarray", "scalar"),
    ("numpy._core.multiarray", "_reconstruct"),
    ("numpy._core.multiarray", "scalar"),
    ("scipy.sparse.csc", "csc_matrix"),
    ("scipy.sparse._csc", "csc_matrix"),
    ("scipy.sparse.csr", "csr_matrix"),
    ("scipy.sparse._csr", "csr_matrix"),
    ("_codecs", "encode"),
}


def read_flame(source: Path, landmarks: Path | None = None) -> MorphableModel:
    """FLAME's .pkl; the 51 inner landmarks are read from `flame_static_embedding.pkl` beside it, or from a file.

    Raises:
        UnreadableFile: not such a pickle, or one that holds more than arrays.
        UsageError: there are no landmarks.
    """
    data = _arrays_in(source)
    try:
        mean = np.asarray(data["v_template"], np.float64)
        directions = np.asarray(data["shapedirs"], np.float64)
        triangles = np.asarray(data["f"]).astype(np.int64)
    except KeyError as error:
        raise UnreadableFile(source, f"not a FLAME model: lacks {error.args[0]!r}") from None
    if mean.ndim != 2 or directions.shape[:2] != mean.shape:
        raise UnreadableFile(source, f"v_template {mean.shape} and shapedirs {directions.shape} do not agree")
    basis = directions.transpose(2, 0, 1)
    expression = basis[_IDENTITIES:]
    names = [f"expression {k}" for k in range(len(expression))]
    jaw = _jaw_opening(data, mean)
    if jaw is not None:
        expression = np.concatenate([expression, jaw[None]])
        names.append("jaw open")
    points = read_landmark_numbers(landmarks) if landmarks is not None else _embedded(source, triangles)
    model = assemble(
        source,
        "flame",
        mean,
        triangles,
        basis[:_IDENTITIES],
        expression,
        points,
        expression_names=names,
        card={"license": "FLAME licence (from the Max Planck Institute)", "source": f"FLAME ({source.name})"},
    )
    return with_facemesh_points(model)


def _jaw_opening(data: dict[str, Any], mean: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Displacement of every vertex by a rotation of the jaw about the x axis through its joint; None without joints."""
    weights, regressor = data.get("weights"), data.get("J_regressor")
    if weights is None or regressor is None or np.shape(weights)[1] <= _JAW:
        return None
    joint = np.asarray(regressor @ mean)[_JAW]
    arm = mean - joint
    turn = np.stack([np.zeros(len(mean)), -arm[:, 2], arm[:, 1]], axis=1)
    moved: NDArray[np.float64] = _JAW_DEVIATION * np.asarray(weights)[:, _JAW, None] * turn
    return moved


def _embedded(source: Path, triangles: NDArray[np.int64]) -> NDArray[np.int32]:
    """The nearest corner of each landmark's triangle."""
    path = source.with_name(_EMBEDDING)
    if not path.is_file():
        raise UsageError(
            f"{source}: put FLAME's {_EMBEDDING} beside it, or give --landmarks FILE with lines '37 = 2088'"
        )
    data = _arrays_in(path)
    try:
        faces, weights = np.asarray(data["lmk_face_idx"]), np.asarray(data["lmk_b_coords"])
        corners = triangles[faces.astype(np.int64)]
        points = np.full(68, -1, np.int32)
        points[17:] = corners[np.arange(51), weights.argmax(axis=1)]
    except (KeyError, IndexError, ValueError) as error:
        raise UnreadableFile(path, f"not FLAME's embedding of 51 landmarks: {error}") from error
    return points


class _ArraysOnly(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        if module.startswith("chumpy") and name in ("Ch", "Select"):
            return _Chumpy
        if (module, name) in _ALLOWED:
            return super().find_class(module, name)
        raise pickle.UnpicklingError(f"it asks for {module}.{name}, which is no array")


class _Chumpy:
    """In place of chumpy's array, whose state has the numbers under "x"."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.x = state.get("x")

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return np.asarray(self.x, dtype)


def _arrays_in(path: Path) -> dict[str, Any]:
    try:
        data = _ArraysOnly(io.BytesIO(path.read_bytes()), encoding="latin1").load()
    except OSError as error:
        raise UnreadableFile(path, error.strerror or str(error)) from error
    except Exception as error:  # a damaged pickle raises nearly anything
        raise UnreadableFile(path, f"cannot be unpickled safely: {error}") from error
    if not isinstance(data, dict):
        raise UnreadableFile(path, f"holds a {type(data).__name__}, expected a dictionary of arrays")
    return data
