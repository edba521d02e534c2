"""FaceMesh: 468 points with depth on a face.

Kartynnik et al., Real-time Facial Surface Geometry from Monocular Video on Mobile GPUs, CVPR Workshops 2019. The
network reads an upright square crop; the first crop comes from the detector, further ones from the mesh itself,
which knows the face's extent and tilt much better.
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
from graphface.nodes.types import FloatArray, Image, Landmarks

SIDE = 192
"""Pixels of the network's square input."""

MARGIN = 1.5
"""Side of the crop over the size of the face in it, as in training."""

EYES = [33, 263]
"""The outer corners of the right and the left eye."""

Unit = Annotated[float, Field(ge=0, le=1)]


class NoFaceFound(RunError):
    """No face in the picture; `tried` are the ways it was looked for."""

    def __init__(self, size: tuple[int, int], tried: list[str]) -> None:
        self.size = size
        self.tried = tried
        super().__init__(
            f"no face found in the photo ({size[0]} x {size[1]} pixels); looked at it {', '.join(tried)}. "
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
    min_mesh_score: Unit = 0.5,
    passes: Annotated[int, Field(ge=1, le=5)] = 2,
) -> Landmarks:
    """468 points (scheme "facemesh468") on one face of the photo, in its pixels at full resolution.

    Args:
        photo: any size; the faces are searched on a reduced copy, the points read from the full picture.
        face: "largest", or an index in order of size, 0 being the largest.
        min_score: confidence that a detection needs.
        min_mesh_score: confidence, from the mesh network, that a detection is a face after all.
        passes: runs of the mesh network, each crop taken from the mesh before.

    Returns:
        Points float32 (468, 3): x right, y down, z towards the viewer, all in pixels; z is zero near the head's middle.

    Raises:
        NoFaceFound: says everything that was tried.
        NoSuchFace: `face` is not below the number of faces.
        AssetUnavailable: the network weights are not on this machine and cannot be fetched.
    """
    pixels = _network_pixels(photo)
    wanted = 0 if face == "largest" else face

    def confirm(faces: list[Face]) -> list[tuple[FloatArray, float, int]]:
        """The meshes down to the wanted face, with scores and the number of faces, false detections left out."""
        meshes: list[tuple[FloatArray, float, int]] = []
        rejected = 0
        for candidate in faces:
            points, mesh_score = read_mesh(pixels, candidate, passes=passes)
            if mesh_score < min_mesh_score:
                rejected += 1
                continue
            meshes.append((points, min(candidate.score, mesh_score), len(faces)))
            if len(meshes) > wanted:
                break
        return [(points, score, len(faces) - rejected) for points, score, _ in meshes]

    found, tried = search(pixels, confirm, min_score=min_score)
    if not found:
        raise NoFaceFound((photo.width, photo.height), tried)
    if wanted >= len(found):
        raise NoSuchFace(wanted, len(found))
    if len(tried) > 1:
        warn(f"the face was found only when looking at the photo {tried[-1]}")
    points, score, count = found[wanted]
    return Landmarks(points, "facemesh468", score, count)


def read_mesh(pixels: FloatArray, face: Face, *, passes: int = 2) -> tuple[FloatArray, float]:
    """The mesh of one detected face, (468, 3) as `facemesh` returns it, and its confidence 0..1."""
    center = (face.box[:2] + face.box[2:]) / 2
    across = face.points[1] - face.points[0]
    angle = float(np.arctan2(across[1], across[0]))
    crop = Crop((float(center[0]), float(center[1])), max(face.size, 1.0) * MARGIN, angle)
    points, score = _mesh_in(pixels, crop)
    for _ in range(passes - 1):
        crop = crop_about(points[:, :2], points[EYES, :2], margin=MARGIN)
        points, score = _mesh_in(pixels, crop)
    return points, score


def _mesh_in(pixels: FloatArray, crop: Crop) -> tuple[FloatArray, float]:
    outputs = run_network(FACEMESH, crop.read(pixels, SIDE))
    points = crop.to_picture(outputs["conv2d_20"].reshape(-1, 3), SIDE)
    return points, float(sigmoid(outputs["conv2d_30"]).reshape(()))


def _network_pixels(photo: Image) -> FloatArray:
    """The photo as the networks know pictures: sRGB-encoded, 0..1, finite."""
    pixels = photo.pixels
    if photo.encoding == "linear":
        from graphface.nodes.image import encode_srgb

        pixels = encode_srgb(pixels)
    if not np.isfinite(pixels).all():
        warn("the photo has values that are not numbers: taken as black to find the face")
        pixels = np.nan_to_num(pixels, nan=0, posinf=1, neginf=0)
    return np.clip(pixels, 0, 1)
