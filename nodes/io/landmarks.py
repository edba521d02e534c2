"""Files of landmarks: iBUG .pts, comma- or space-separated text, NumPy .npy."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.landmark_schemes import POINTS
from graphface.nodes.types import FloatArray, Landmarks


def read_landmarks(path: Path) -> Landmarks:
    """68 or 468 points with two or three columns: x, y in pixels, z in pixels towards the viewer (0 where absent).

    In a .pts file (iBUG) the first pixel's centre is (1, 1), as in MATLAB; elsewhere it is (0, 0).

    Raises:
        UnreadableFile: with the reason, and the line where there is one.
    """
    path = Path(path)
    try:
        if path.suffix.lower() == ".npy":
            values = np.load(path, allow_pickle=False)
        else:
            values = _parse(path, path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, EOFError) as error:
        raise UnreadableFile(path, _reason(error)) from error
    values = np.asarray(values)
    schemes = {count: scheme for scheme, count in POINTS.items()}
    shaped = values.ndim == 2 and values.shape[0] in schemes and values.shape[1] in (2, 3)
    if not shaped or values.dtype.kind not in "fiu":
        raise UnreadableFile(path, f"expected 68 or 468 rows of x, y or x, y, z; found {values.shape} {values.dtype}")
    points = np.zeros((len(values), 3), np.float32)
    points[:, : values.shape[1]] = values
    if path.suffix.lower() == ".pts":
        points[:, :2] -= 1
    if not np.isfinite(points).all():
        raise UnreadableFile(path, "has values that are not numbers")
    return Landmarks(points, schemes[len(points)])


def write_landmarks(landmarks: Landmarks, path: Path) -> None:
    """Write the points as `read_landmarks` reads them: .pts (x and y), .csv or .npy (x, y, z).

    Raises:
        UnwritableFile: unknown suffix, or the folder refuses.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    rows = [[f"{v:.9g}" for v in row] for row in landmarks.points + np.array([1, 1, 0]) * (suffix == ".pts")]
    try:
        if suffix == ".npy":
            np.save(path, landmarks.points)
        elif suffix == ".csv":
            path.write_text("".join(",".join(row) + "\n" for row in rows), encoding="ascii")
        elif suffix == ".pts":
            body = "".join(f"{row[0]} {row[1]}\n" for row in rows)
            path.write_text(f"version: 1\nn_points: {len(rows)}\n{{\n{body}}}\n", encoding="ascii")
        else:
            raise UnwritableFile(
                path, f"landmarks cannot be written as {suffix or 'a file without suffix'!r}; use .pts, .csv or .npy"
            )
    except OSError as error:
        raise UnwritableFile(path, _reason(error)) from error


def _parse(path: Path, text: str) -> FloatArray:
    """The numbers of a text file; the header and braces of .pts, blank lines, # comments and a heading are skipped."""
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.partition("#")[0].strip()
        if not content or content in "{}" or content.startswith(("version:", "n_points:")):
            continue
        try:
            row = [float(word) for word in content.replace(",", " ").replace(";", " ").split()]
        except ValueError:
            if rows or path.suffix.lower() == ".pts":
                raise ValueError(f"line {number} is not numbers: {content[:40]!r}") from None
            continue  # a heading such as "x,y,z"
        if rows and len(row) != len(rows[0]):
            raise ValueError(f"line {number} has {len(row)} numbers, those above have {len(rows[0])}")
        rows.append(row)
    return np.array(rows, np.float64)


def _reason(error: Exception) -> str:
    return error.strerror or str(error) if isinstance(error, OSError) else str(error)
