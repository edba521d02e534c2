"""ICT-FaceKit (Li et al., Learning Formation of Physically-Based Face Attributes, CVPR 2020; MIT licence).

Either the makers' folder, with `generic_neutral_mesh.obj`, `identityNNN.obj`, one OBJ an expression and
`vertex_indices.json`, or the same packed as NumPy arrays. Of the full head only the face is read (the first 6560
polygons, "narrow face" in its README); ears, neck, mouth cavity, teeth and eyes are separate parts. The holes of eyes
and mouth are closed.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.readers.assemble import assemble, with_facemesh_points
from graphface.nodes.morphable.readers.wavefront import read_obj

_NARROW_FACE = 6560
"""Polygons of the narrow face, first in the list (ICT-FaceKit's README)."""


_LANDMARKS = (
    1225, 1888, 1052, 367, 1719, 1722, 2199, 1447, 966, 3661, 4390, 3927, 3924, 2608, 3272, 4088, 3443, 268, 493,
    1914, 2044, 1401, 3615, 4240, 4114, 2734, 2509, 978, 4527, 4942, 4857, 1140, 2075, 1147, 4269, 3360, 1507, 1542,
    1537, 1528, 1518, 1511, 3742, 3751, 3756, 3721, 3725, 3732, 5708, 5695, 2081, 0, 4275, 6200, 6213, 6346, 6461,
    5518, 5957, 5841, 5702, 5711, 5533, 6216, 6207, 6470, 5517, 5966,
)  # fmt: skip
"""Vertices of the 68 iBUG points (ICT-FaceKit's `vertex_indices.json`)."""


_DEVIATION = 0.3
"""Assumed standard deviation of blendshape weights, which range from 0 to 1 and come without statistics."""


_CARD = {"license": "MIT", "source": "ICT-FaceKit, USC Institute for Creative Technologies"}


@dataclass(frozen=True)
class IctHead:
    """The whole head in the makers' units: `mean` (V, 3), `polygons` (F, 4), `identity` and `expression` (K, V, 3)
    differences to the mean, `names` of the expressions, `landmarks` (68,) vertices."""

    mean: NDArray[np.float32]
    polygons: NDArray[np.int64]
    identity: NDArray[np.float32]
    expression: NDArray[np.float32]
    names: tuple[str, ...]
    landmarks: NDArray[np.int32]
    uv: NDArray[np.float32] | None


def read_ict(source: Path, _landmarks: Path | None = None) -> MorphableModel:
    """ICT-FaceKit from its folder or from a packed .npz.

    Raises:
        UnreadableFile: files are missing or do not agree.
    """
    head = read_head(source)
    model = assemble(
        source,
        "ict",
        head.mean,
        triangles_of(head.polygons[:_NARROW_FACE]),
        head.identity,
        head.expression * np.float32(_DEVIATION),
        head.landmarks,
        expression_names=head.names,
        uv=head.uv,
        card=_CARD,
    )
    return with_facemesh_points(model)


def read_head(source: Path) -> IctHead:
    """The makers' folder or a packed .npz, with every part of the head.

    Raises:
        UnreadableFile: files are missing or do not agree.
    """
    return _from_folder(source) if source.is_dir() else _from_archive(source)


def _from_archive(path: Path) -> IctHead:
    """The arrays `mean`, `identity`, `expression` (differences to the mean), `faces` or `triangles`, `landmarks68`."""
    try:
        with np.load(path, allow_pickle=False) as file:
            faces = file["faces"].astype(np.int64)
            uv = file["uv"][file["uv_index_of_vertex"]] if "uv_index_of_vertex" in file else None
            return IctHead(
                mean=file["mean"],
                polygons=np.where(faces < 0, faces[:, 2:3], faces),  # a triangle's fourth corner is -1
                identity=file["identity"],
                expression=file["expression"],
                names=tuple(str(name) for name in file["expression_names"]),
                landmarks=file["landmarks68"].astype(np.int32),
                uv=uv,
            )
    except (OSError, ValueError, EOFError) as error:
        raise UnreadableFile(path, f"not a packed ICT-FaceKit: {error}") from error
    except KeyError as error:
        raise UnreadableFile(path, f"not a packed ICT-FaceKit: lacks {error.args[0]!r}") from None


def _from_folder(folder: Path) -> IctHead:
    neutral = next(folder.rglob("generic_neutral_mesh.obj"), None)
    if neutral is None:
        raise UnreadableFile(folder, "holds no generic_neutral_mesh.obj; give the folder FaceXModel of ICT-FaceKit")
    mean, uv, polygons = read_obj(neutral)
    others = sorted(path for path in neutral.parent.glob("*.obj") if path != neutral)
    identities = [path for path in others if path.stem.startswith("identity")]
    expressions = [path for path in others if not path.stem.startswith("identity")]
    if not identities:
        raise UnreadableFile(folder, "holds no identityNNN.obj")
    return IctHead(
        mean=mean,
        polygons=polygons.astype(np.int64),
        identity=_differences(identities, mean),
        expression=_differences(expressions, mean),
        names=tuple(path.stem for path in expressions),
        landmarks=_landmarks_beside(neutral, len(mean)),
        uv=uv,
    )


def _landmarks_beside(neutral: Path, vertices: int) -> NDArray[np.int32]:
    """From `vertex_indices.json` where it is there, else as published."""
    file = neutral.with_name("vertex_indices.json")
    numbers: Any = _LANDMARKS
    if file.is_file():
        try:
            numbers = json.loads(file.read_text(encoding="utf-8"))["idx_to_landmark_verts"]
        except (OSError, ValueError, KeyError) as error:
            raise UnreadableFile(file, f"has no list 'idx_to_landmark_verts': {error}") from error
    landmarks = np.asarray(numbers, np.int32)
    if landmarks.shape != (68,) or landmarks.max() >= vertices:
        raise UnreadableFile(file, f"names {landmarks.shape} landmark vertices, expected 68 below {vertices}")
    return landmarks


def _differences(paths: list[Path], mean: NDArray[np.float32]) -> NDArray[np.float32]:
    shapes = []
    for path in paths:
        shape = read_obj(path)[0]
        if shape.shape != mean.shape:
            raise UnreadableFile(path, f"has {len(shape)} vertices, the neutral mesh has {len(mean)}")
        shapes.append(shape - mean)
    return np.stack(shapes) if shapes else np.zeros((0, *mean.shape), np.float32)


def triangles_of(polygons: NDArray[np.int64]) -> NDArray[np.int64]:
    """Polygons of four corners (or three, the last twice) as triangles."""
    triangles = np.concatenate([polygons[:, [0, 1, 2]], polygons[:, [0, 2, 3]]])
    proper: NDArray[np.int64] = triangles[triangles[:, 1] != triangles[:, 2]]
    return proper
