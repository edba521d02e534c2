"""ICT-FaceKit's whole head: face, ears, neck and skull, eyes, teeth and the cavities behind them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile
from graphface.nodes.morphable.subdivide import loop

SKIN, EYE, TEETH, GUMS, CAVITY = range(5)
"""What a vertex belongs to."""


_PARTS = {
    "face": SKIN,
    "head_neck": SKIN,
    "mouth_socket": CAVITY,
    "eye_socket_l": CAVITY,
    "eye_socket_r": CAVITY,
    "gums_tongue": GUMS,
    "teeth": TEETH,
    "eyeball_l": EYE,
    "eyeball_r": EYE,
}
"""The parts that are rendered. Lashes and the fluids of the eye are transparent sheets and are left out."""


_SMOOTH = {SKIN, CAVITY}
"""Parts that are subdivided once, so that relief of a millimetre can stand on them."""


@dataclass(frozen=True)
class HeadModel:
    """A linear model of a head: N coarse vertices, M refined ones; centimetres, x right, y up, z out of the face.

    Attributes:
        mean: float64 (N, 3). identity: float32 (I, N, 3). expression: float32 (E, N, 3), for weights 0 to 1.
        names: of the expressions.
        refinement: sparse (M, N), from coarse vertices to those that are rendered.
        triangles: int32 (T, 3), of the refined vertices.
        part: int8 (M,), SKIN, EYE, TEETH, GUMS or CAVITY.
        landmarks: int64 (68,), coarse vertices of the iBUG points.
    """

    mean: NDArray[np.float64]
    identity: NDArray[np.float32]
    expression: NDArray[np.float32]
    names: tuple[str, ...]
    refinement: Any
    triangles: NDArray[np.int32]
    part: NDArray[np.int8]
    landmarks: NDArray[np.int64]


def read_head(path: Path) -> HeadModel:
    """The head of ICT-FaceKit, packed as NumPy arrays.

    Raises:
        UnreadableFile: the file is missing, or has not the parts of a whole head.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        return _assembled(arrays)
    except (OSError, ValueError, EOFError) as error:
        raise UnreadableFile(path, f"not a packed ICT-FaceKit: {error}") from error
    except KeyError as error:
        raise UnreadableFile(path, f"not a packed ICT-FaceKit: lacks {error.args[0]!r}") from None


def _assembled(arrays: dict[str, NDArray[Any]]) -> HeadModel:
    from scipy.sparse import csr_array, vstack

    count = len(arrays["mean"])
    names = [str(name) for name in arrays["part_names"]]
    part = np.full(count, -1, np.int8)
    part_of_face = np.full(len(arrays["faces"]), -1, np.int8)
    for name, kind in _PARTS.items():
        row = names.index(name)
        part[slice(*arrays["part_vertex_range"][row])] = kind
        part_of_face[slice(*arrays["part_face_range"][row])] = kind
    part_of_triangle = part_of_face[arrays["tri_face"]]
    triangles = arrays["triangles"].astype(np.int32)
    fine = np.isin(part_of_triangle, list(_SMOOTH))
    matrix, refined = loop(triangles[fine], count)
    kinds = np.concatenate([part, _kinds_of_edges(matrix[count:], part)])
    coarse = triangles[(part_of_triangle >= 0) & ~fine]
    used, flat = np.unique(np.concatenate([refined, coarse]), return_inverse=True)
    # Loop's rule also moves vertices without a smooth triangle: those keep their places.
    keep = csr_array((np.ones(count), (np.arange(count), np.arange(count))), shape=(count, count))
    smooth = np.zeros(count, bool)
    smooth[np.unique(triangles[fine])] = True
    select = csr_array((smooth.astype(float), (np.arange(count), np.arange(count))), shape=(count, count))
    first = select @ matrix[:count] + (keep - select)
    return HeadModel(
        mean=arrays["mean"].astype(np.float64),
        identity=arrays["identity"],
        expression=arrays["expression"],
        names=tuple(str(name) for name in arrays["expression_names"]),
        refinement=csr_array(vstack([first, matrix[count:]]))[used],
        triangles=flat.reshape(-1, 3).astype(np.int32),
        part=kinds[used],
        landmarks=arrays["landmarks68"].astype(np.int64),
    )


def _kinds_of_edges(rows: Any, part: NDArray[np.int8]) -> NDArray[np.int8]:
    """The part of each new vertex: that of the coarse vertex with the largest share in it; skin wins a tie."""
    dense = rows.tocoo()
    shares = np.zeros((rows.shape[0], CAVITY + 1))
    np.add.at(shares, (dense.coords[0], np.maximum(part[dense.coords[1]], 0)), dense.data)
    return np.asarray(np.argmax(shares, axis=1), np.int8)


def normals_of(vertices: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Unit normals (M, 3), means of the adjoining triangles' weighted by area: quicker than by angle."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    flat = np.cross(b - a, c - a)
    corners = triangles.ravel()
    sums = [np.bincount(corners, np.repeat(flat[:, axis], 3), len(vertices)) for axis in range(3)]
    normals = np.stack(sums, axis=1)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12))
