"""Relit photographs and their labels as folders that a scorer of visible defects reads, and two figures of the light.

There is no truth for a relit photograph. What the eye objects to can be counted all the same: colors that no skin of
the photo has, stains on the wall, lamps that turned grey. `looks.py` counts them in folders of one case each:

    SCENE/PHOTO/photo.png, result.png, points.npy, face.png, hair.png, background.png
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface import Graph, GraphfaceError, read_yaml, warn
from graphface.evaluate.session import Session
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, decode_srgb
from graphface.nodes.image.resize import resize
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_image, write_picture
from graphface.nodes.landmarks.scaled import scaled
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.types import FloatArray, Image, Landmarks, Scene, Segmentation
from graphface.values.writing import beside, make_folder

_CHEEKS = (50, 280)
"""FaceMesh points in the middle of the cheeks."""

_FOREHEAD = (10, 338, 109, 297, 67, 332, 103)
"""FaceMesh points along the top of the face mesh, the middle one first."""

_BRIDGE = 168
"""FaceMesh point between the eyes; up is from here to the top."""

_CHEEK_RADIUS = 0.12
"""Inter-ocular distances, as are the ends and the step of the lines across the forehead."""

_LINE = np.arange(-0.3, 0.4, 0.01)
_LEAST_LINE, _LEAST_SIDE = 45, 8
"""Samples of a line that the picture must hold, and samples on each side of a dip."""

_SKIN = 0.7
"""Least label of face at a dip: hair hides what would be seen."""

_LEAST_LIGHT = 0.02


@dataclass(frozen=True)
class Look:
    """One photo under one scene.

    Attributes:
        cheeks: mean linear light of the cheek that is farther from the light over that of the nearer one; NaN if the
            scene's light comes from neither side.
        rim: the deepest dip of shadow along lines across the upper edge of the face mesh, as a share of the lower of
            the two sides of the dip: 0 where the forehead is evenly lit. NaN if the scene casts no shadow.
    """

    photo: str
    scene: str
    cheeks: float
    rim: float


def relit_looks(
    photos: Iterable[Path], scenes: Sequence[Path], graph: Graph, out: Path, long_side: int
) -> Iterator[Look]:
    """Relight every photo under every scene and write the case folders; a photo that cannot be used is named.

    Args:
        graph: a relight graph.
        out: folder for the cases.
        long_side: larger photos are scaled down to this many pixels.
    """
    lights = {path.stem: read_yaml(path, Scene) for path in scenes}
    for file in photos:
        try:
            session = Session(graph, {"photo": resize(read_image(file), long_side=long_side)})
            for name, scene in lights.items():
                yield _look(session, file.stem, name, scene, out / name / file.stem)
        except GraphfaceError as problem:
            warn(f"{file.name} is left out: {str(problem).splitlines()[0]}")


def _look(session: Session, photo: str, name: str, scene: Scene, folder: Path) -> Look:
    session.edit(scene=scene)
    found = session.render(["image", "photo", "face.working", "face.landmarks", "face.labels"])
    own, working = found["photo"], found["face.working"]
    landmarks = scaled(found["face.landmarks"], working, own)
    write_case(folder, own, found["image"], landmarks, _enlarged(found["face.labels"], own))
    shadow = _shadow(session, scene) if scene.casting else None
    rim = np.nan if shadow is None else rim_dip(shadow, found["face.landmarks"], found["face.labels"].face)
    return Look(photo, name, _far_over_near(found["image"], landmarks, scene), rim)


def _enlarged(labels: Segmentation, photo: Image) -> Segmentation:
    """Labels of the working size at the photo's."""
    import cv2

    size = photo.width, photo.height
    parts = (labels.face, labels.hair, labels.background)
    return Segmentation(
        *(np.asarray(cv2.resize(part, size, interpolation=cv2.INTER_LINEAR), np.float32) for part in parts)
    )


def write_case(folder: Path, photo: Image, result: Image, landmarks: Landmarks, labels: Segmentation) -> None:
    """Photo, result, landmarks and labels as files in a folder, which is made where it does not exist."""
    make_folder(folder)
    write_image(photo, folder / "photo.png")
    write_image(result, folder / "result.png")
    with beside(folder / "points.npy") as path, path.open("wb") as file:
        np.save(file, landmarks.points)
    for part in ("face", "hair", "background"):
        write_picture(np.asarray(np.rint(255 * getattr(labels, part)), np.uint8), folder / f"{part}.png")


def _far_over_near(image: Image, landmarks: Landmarks, scene: Scene) -> float:
    """See `Look.cheeks`."""
    sides = irradiance(scene, np.array([[-1, 0, 0], [1, 0, 0]], np.float32))
    from_left, from_right = sides.reshape(2, -1).mean(axis=1)
    if abs(from_left - from_right) < 0.1 * max(from_left, from_right, 1e-6):
        return float("nan")
    left, right = (
        _light_at(image, landmarks, point) for point in sorted(_CHEEKS, key=lambda p: landmarks.points[p, 0])
    )
    near, far = (left, right) if from_left > from_right else (right, left)
    return far / max(near, 1e-4)


def _light_at(image: Image, landmarks: Landmarks, point: int) -> float:
    """Mean linear intensity in a disc around a landmark."""
    x, y = landmarks.points[point, :2]
    rows, columns = np.ogrid[: image.height, : image.width]
    disc = np.hypot(columns - x, rows - y) <= max(_CHEEK_RADIUS * landmarks.interocular, 1)
    pixels = image.pixels[disc]
    return float(np.mean(decode_srgb(np.clip(pixels, 0, 1)))) if pixels.size else float("nan")


def _shadow(session: Session, scene: Scene) -> FloatArray:
    """The share of the scene's light that shadows leave, H x W: shading with them over shading without them."""

    def shade(**changes: Any) -> FloatArray:
        session.edit(scene=scene.model_copy(update={"keep_mean": False, **changes}))
        shading: FloatArray = session.render(["shade"])["shade"]
        return channel_mean(shading) if shading.ndim == 3 else shading

    unshadowed = tuple(
        light.model_copy(update={"shadow": "none"}) if index in scene.casting else light
        for index, light in enumerate(scene.lights)
    )
    return (shade() + _LEAST_LIGHT) / (shade(lights=unshadowed) + _LEAST_LIGHT)


def rim_dip(shadow: FloatArray, landmarks: Landmarks, face: FloatArray) -> float:
    """The deepest dip of a shadow along lines across the upper edge of the face mesh; see `Look.rim`.

    Args:
        shadow: the share of the light that is left, H x W.
        face: the label, H x W; dips count only on skin.
    """
    smooth = blurred(shadow, max(0.01 * landmarks.interocular, 0.5))
    up = landmarks.points[_FOREHEAD[0], :2] - landmarks.points[_BRIDGE, :2]
    up = up / max(float(np.linalg.norm(up)), 1e-6)
    height, width = shadow.shape
    deepest = np.nan
    for point in _FOREHEAD:
        columns, rows = (landmarks.points[point, :2, None] + up[:, None] * _LINE * landmarks.interocular).astype(int)
        inside = (columns > 1) & (columns < width - 2) & (rows > 1) & (rows < height - 2)
        if np.count_nonzero(inside) >= _LEAST_LINE:
            line, skin = (values[rows[inside], columns[inside]] for values in (smooth, face))
            deepest = np.fmax(deepest, _deepest_dip(line, skin))
    return float(deepest)


def _deepest_dip(line: FloatArray, skin: FloatArray) -> float:
    """Of values along a line, against the lower of the two maxima beside it; NaN where no part of the line is skin."""
    deepest = np.nan
    for k in range(_LEAST_SIDE, len(line) - _LEAST_SIDE):
        if skin[k - 4 : k + 4].min() >= _SKIN:
            sides = min(line[:k].max(), line[k + 1 :].max())
            deepest = np.fmax(deepest, 1 - line[k] / max(float(sides), 1e-3))
    return float(deepest)
