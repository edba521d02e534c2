"""The Surrey face model in the binary form of eos (Huber et al., A Multiresolution 3D Morphable Face Model, 2016).

eos writes through cereal: matrices as rows and columns (int32) and column-major float32, vectors and strings after a
64-bit length. The shape model is mean, orthonormal basis, eigenvalues and triangles; blendshapes are a list of names
and displacements.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.readers.assemble import assemble, with_facemesh_points
from graphface.nodes.morphable.readers.landmark_file import read_landmark_numbers

_DEVIATION = 0.3
"""Assumed standard deviation of blendshape weights, which range from 0 to 1 and come without statistics."""


_MAX_LENGTH = 1 << 28
"""Largest plausible number of values in a matrix."""


def read_surrey(source: Path, landmarks: Path | None = None) -> MorphableModel:
    """The folder with `sfm_shape_*.bin` and, beside it, `expression_blendshapes_*.bin`, `ibug_to_sfm.txt` and
    `sfm_model_contours.json` (which gives the jaw); or the shape file in such a folder.

    Raises:
        UnreadableFile: a file is missing or damaged.
    """
    folder = source if source.is_dir() else source.parent
    shape = _one(folder, "sfm_shape*.bin") if source.is_dir() else source
    data = _Reader(shape)
    data.integer("I")  # the version of the class
    mean, basis, variances = data.matrix(), data.matrix(), data.matrix()
    triangles = data.triangles()
    vertices = len(mean) // 3
    deviations = np.sqrt(np.maximum(variances.reshape(-1), 0))
    identity = (basis * deviations).T.reshape(-1, vertices, 3)
    names, expression = _blendshapes(folder, vertices)
    points = read_landmark_numbers(landmarks if landmarks is not None else _one(folder, "ibug_to_sfm.txt"))
    points = _with_jaw(points, folder)
    points[points >= vertices] = -1  # the mapping also serves finer meshes
    model = assemble(
        shape,
        "surrey",
        mean.reshape(-1, 3),
        triangles,
        identity,
        expression * np.float32(_DEVIATION),
        points,
        expression_names=names,
        card={"license": "Apache-2.0 (shape only)", "source": "Surrey Face Model, University of Surrey, by way of eos"},
    )
    return with_facemesh_points(model)


def _one(folder: Path, pattern: str) -> Path:
    found = sorted(folder.glob(pattern))
    if not found:
        raise UnreadableFile(folder, f"holds no {pattern}")
    return found[0]


def _blendshapes(folder: Path, vertices: int) -> tuple[list[str], NDArray[np.float32]]:
    paths = sorted(folder.glob("expression_blendshapes*.bin"))
    if not paths:
        return [], np.zeros((0, vertices, 3), np.float32)
    data = _Reader(paths[0])
    names, shapes = [], []
    for _ in range(data.integer("Q")):
        names.append(data.text())
        shape = data.matrix().reshape(-1, 3)
        if len(shape) != vertices:
            raise UnreadableFile(paths[0], f"{names[-1]!r} has {len(shape)} vertices, the shape has {vertices}")
        shapes.append(shape)
    return names, np.stack(shapes) if shapes else np.zeros((0, vertices, 3), np.float32)


def _with_jaw(points: NDArray[np.int32], folder: Path) -> NDArray[np.int32]:
    """Jaw points 1-8 and 10-17 spread evenly over the model's contours, which run from the ears to the chin."""
    paths = sorted(folder.glob("sfm_model_contours.json"))
    if not paths:
        return points
    try:
        contours = json.loads(paths[0].read_text(encoding="utf-8"))["model_contour"]
        right, left = (np.asarray(contours[f"{side}_contour"], np.int32) for side in ("right", "left"))
    except (OSError, ValueError, KeyError) as error:
        raise UnreadableFile(paths[0], f"not eos's contours: {error}") from error
    filled = points.copy()
    filled[:8] = right[np.linspace(0, len(right) - 1, 8).round().astype(int)]
    filled[16:8:-1] = left[np.linspace(0, len(left) - 1, 8).round().astype(int)]
    return filled


class _Reader:
    """Reads values from a file in cereal's binary form, from its beginning on."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._place = 0
        try:
            self._data = path.read_bytes()
        except OSError as error:
            raise UnreadableFile(path, error.strerror or str(error)) from error

    def integer(self, form: str) -> int:
        return int(struct.unpack("<" + form, self._take(struct.calcsize(form)))[0])

    def text(self) -> str:
        return self._take(self._plausible(self.integer("Q"))).decode("utf-8", "replace")

    def matrix(self) -> NDArray[np.float32]:
        rows, columns = self._plausible(self.integer("i")), self._plausible(self.integer("i"))
        values = np.frombuffer(self._take(4 * self._plausible(rows * columns)), "<f4")
        return values.reshape(columns, rows).T.astype(np.float32)

    def triangles(self) -> NDArray[np.int64]:
        count = self._plausible(self.integer("Q"))
        return np.frombuffer(self._take(12 * count), "<i4").reshape(-1, 3).astype(np.int64)

    def _take(self, count: int) -> bytes:
        taken = self._data[self._place : self._place + count]
        if len(taken) < count:
            raise UnreadableFile(self._path, f"ends after {len(self._data)} bytes, in the middle of a value")
        self._place += count
        return taken

    def _plausible(self, count: int) -> int:
        if not 0 <= count <= _MAX_LENGTH:
            raise UnreadableFile(self._path, f"not a face model of eos: a length of {count} at byte {self._place}")
        return count
