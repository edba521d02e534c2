"""Meshes in Wavefront's OBJ format."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile

Corner = list[str]
"""Numbers of a vertex, of its texture coordinate and of its normal, from 1; the latter two may be absent or empty."""


def read_obj(path: Path) -> tuple[NDArray[np.float32], NDArray[np.float32] | None, NDArray[np.int64]]:
    """Vertices (V, 3), their texture coordinates (V, 2) or None, and polygons (F, 4); a triangle repeats its last.

    Raises:
        UnreadableFile: the file is missing, or not in this format.
    """
    vertices, texture, faces = [], [], []
    try:
        with path.open(encoding="utf-8", errors="replace") as lines:
            for line in lines:
                word, _, rest = line.partition(" ")
                if word == "v":
                    vertices.append([float(x) for x in rest.split()[:3]])
                elif word == "vt":
                    texture.append([float(x) for x in rest.split()[:2]])
                elif word == "f":
                    faces.append([corner.split("/") for corner in rest.split()[:4]])
        uv = _texture_of_vertices(texture, faces, len(vertices))
        return np.asarray(vertices, np.float32).reshape(-1, 3), uv, _polygons(faces)
    except (OSError, ValueError, IndexError) as error:
        raise UnreadableFile(path, f"not a Wavefront OBJ: {error}") from error


def _texture_of_vertices(
    texture: list[list[float]], faces: list[list[Corner]], vertices: int
) -> NDArray[np.float32] | None:
    """The texture coordinate of each vertex in the last face that has one; None where some vertex has none."""
    corners = (corner for face in faces for corner in face if len(corner) > 1 and corner[1])
    of_vertex = {int(corner[0]) - 1: int(corner[1]) - 1 for corner in corners}
    if not texture or len(of_vertex) != vertices:
        return None
    return np.asarray(texture, np.float32)[[of_vertex[vertex] for vertex in range(vertices)]]


def _polygons(faces: list[list[Corner]]) -> NDArray[np.int64]:
    numbers = [[int(corner[0]) - 1 for corner in face] for face in faces]
    return np.asarray([polygon + polygon[-1:] * (4 - len(polygon)) for polygon in numbers], np.int64).reshape(-1, 4)
