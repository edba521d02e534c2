"""FaceMesh: 468 points with depth on a face.

Kartynnik et al., Real-time Facial Surface Geometry from Monocular Video on Mobile GPUs, CVPR Workshops 2019. The
network sees an upright square crop. The first crop comes from the detector, further ones from the mesh itself, which
gives the face's extent and roll more exactly.
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import RunError, node, warn
from graphface.nodes.landmarks.blazeface import Face
from graphface.nodes.landmarks.crop import Crop, crop_about
from graphface.nodes.landmarks.network import run_network, sigmoid
from graphface.nodes.landmarks.search import search
from graphface.nodes.landmarks.weights import FACEMESH
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.types import FloatArray, Image, Landmarks

SIDE = 192
"""Pixels of the network's square input."""


MARGIN = 1.5
"""Side of the crop over the size of the face in it, as in the network's training."""


EYES = [33, 263]
"""The outer corners of the right and the left eye."""


_DETECTOR_POINTS = ([33, 133], [263, 362], [4], [13, 14])
"""The mesh's points at the detector's first four: right eye, left eye, nose tip, mouth."""


MAX_DISAGREEMENT = 0.25
"""Above this, detector and mesh do not show the same face; see `disagreement`."""


Unit = Annotated[float, Field(ge=0, le=1)]


class NoFaceFound(RunError):
    """No face in the picture; `tried` are the views that were searched."""

    def __init__(self, size: tuple[int, int], tried: list[str]) -> None:
        self.size = size
        self.tried = tried
        super().__init__(
            f"no face found in the photo ({size[0]} x {size[1]} pixels); searched it {', '.join(tried)}. "
            "Crop the photo closer to the face, lower min_score, or give the points from a file"
        )


class NoSuchFace(RunError):
    """There are fewer faces than the index asks for."""

    def __init__(self, index: int, faces: int) -> None:
        self.index = index
        self.faces = faces
        number = f"{faces} face{'s' if faces != 1 else ''}"
        super().__init__(f"the photo has {number}, so face: {index} does not exist; the largest is face: 0")


@node("landmarks.facemesh")
def facemesh(
    photo: Image,
    *,
    face: Literal["largest"] | Annotated[int, Field(ge=0)] = "largest",
    min_score: Unit = 0.5,
    min_mesh_score: Unit = 0.6,
    passes: Annotated[int, Field(ge=1, le=5)] = 2,
) -> Landmarks:
    """468 points (scheme "facemesh468") on one face of the photo, in its pixels at full resolution.

    Args:
        photo: any size; faces are searched on a reduced copy, points are found on the full picture.
        face: "largest", or an index in order of size, 0 being the largest. With an index the search for small faces is
            more thorough (0.1 s more on a large photo).
        min_score: least confidence of the detector in a face.
        min_mesh_score: least confidence of the mesh network in that face.
        passes: runs of the mesh network, each on a crop from the mesh of the previous run. On 15 portraits the points
            of 1, 2 and 3 passes differ from those of 5 by 1.9, 1.1 and 0.7 % of the inter-ocular distance; each pass
            takes about 4 ms.

    Returns:
        Points float32 (468, 3): x right, y down, z towards the viewer, all in pixels; z is about 0 in the middle.

    Raises:
        NoFaceFound: names the views that were searched.
        NoSuchFace: `face` is not below the number of faces.
        AssetUnavailable: the network weights are not on this machine and cannot be fetched.
    """

    def confirm(candidate: Face) -> tuple[FloatArray, float] | None:
        points, mesh_score = read_mesh(photo, candidate, passes=passes)
        if mesh_score < min_mesh_score or disagreement(points, candidate) > MAX_DISAGREEMENT:
            return None
        return points, min(candidate.score, mesh_score)

    found, tried = search(photo, confirm, min_score=min_score, thorough=face != "largest")
    if not found:
        raise NoFaceFound((photo.width, photo.height), tried)
    index = 0 if face == "largest" else face
    if index >= len(found):
        raise NoSuchFace(index, len(found))
    if len(tried) > 1:
        warn(f"the face was hard to find: searched the photo {', '.join(tried)}")
    points, score = found[index]
    return Landmarks(points, "facemesh468", score, len(found))


def read_mesh(photo: Image, face: Face, *, passes: int = 2) -> tuple[FloatArray, float]:
    """The mesh of one detected face, (468, 3) as `facemesh` returns it, and its confidence 0..1.

    The confidence is the lowest of all passes: on a false detection the first crop scores low, but a later one may have
    drifted to something that looks like a face, and score 1.
    """
    across = face.points[1] - face.points[0]
    angle = float(np.arctan2(across[1], across[0]))
    crop = Crop((float(face.center[0]), float(face.center[1])), max(face.size, 1.0) * MARGIN, angle)
    points, score = _mesh_in(photo, crop)
    for _ in range(passes - 1):
        crop = crop_about(points[:, :2], points[EYES, :2], margin=MARGIN)
        points, next_score = _mesh_in(photo, crop)
        score = min(score, next_score)
    return points, score


def disagreement(points: FloatArray, face: Face) -> float:
    """Mean distance between the mesh's and the detector's eyes, nose and mouth, over the mesh's inter-ocular distance.

    Measured at most 0.1 on faces, also in profile; 0.1 to 0.3 on false detections.
    """
    mesh = np.stack([points[group, :2].mean(axis=0) for group in _DETECTOR_POINTS])
    interocular = float(np.linalg.norm(points[EYES[0]] - points[EYES[1]]))
    return float(np.linalg.norm(mesh - face.points[:4], axis=1).mean()) / max(interocular, 1e-6)


def _mesh_in(photo: Image, crop: Crop) -> tuple[FloatArray, float]:
    outputs = run_network(FACEMESH, network_pixels(crop.read(photo.pixels, SIDE), photo.encoding))
    points = crop.to_picture(outputs["conv2d_20"].reshape(-1, 3), SIDE)
    return points, float(sigmoid(outputs["conv2d_30"]).reshape(()))
