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
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, decode_srgb
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_image, write_picture
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.types import FloatArray, Image, Landmarks, Scene, Segmentation
from graphface.nodes.types.image import image_from_array
from graphface.values.writing import beside, make_folder

CHEEKS = (50, 280)
"""FaceMesh points in the middle of the cheeks, the picture's left and right one of a face that looks at the camera."""

FOREHEAD = (10, 338, 109, 297, 67, 332, 103)
"""FaceMesh points along the top of the face mesh, the middle one first."""

_BRIDGE = 168
"""FaceMesh point between the eyes; up is from here to the top."""

_CHEEK_RADIUS = 0.12
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
        long_side: larger photos are scaled down to this many pixels; 0 keeps their size.
    """
    lights = {path.stem: read_yaml(path, Scene) for path in scenes}
    for file in photos:
        try:
            session = Session(graph, {"photo": _scaled(read_image(file), long_side)}, evaluator=MeteredEvaluator())
            for name, scene in lights.items():
                yield _look(session, file.stem, name, scene, out / name / file.stem)
        except GraphfaceError as problem:
            warn(f"{file.name} is left out: {str(problem).splitlines()[0]}")


def _look(session: Session, photo: str, name: str, scene: Scene, folder: Path) -> Look:
    session.edit(scene=scene)
    found = session.render(["image", "photo", "face.landmarks", "face.labels"])
    _write_case(folder, found["photo"], found["image"], found["face.landmarks"], found["face.labels"])
    landmarks = found["face.landmarks"]
    rim = _rim_dip(_shadow(session, scene), landmarks, found["face.labels"].face) if scene.casting else np.nan
    return Look(photo, name, _far_over_near(found["image"], landmarks, scene), rim)


def _write_case(folder: Path, photo: Image, result: Image, landmarks: Landmarks, labels: Segmentation) -> None:
    make_folder(folder)
    write_image(photo, folder / "photo.png")
    write_image(result, folder / "result.png")
    with beside(folder / "points.npy") as path, path.open("wb") as file:
        np.save(file, landmarks.points)
    for part in ("face", "hair", "background"):
        write_picture(np.asarray(np.rint(255 * getattr(labels, part)), np.uint8), folder / f"{part}.png")


def _far_over_near(image: Image, landmarks: Landmarks, scene: Scene) -> float:
    sides = irradiance(scene, np.array([[-1, 0, 0], [1, 0, 0]], np.float32))
    from_left, from_right = sides.reshape(2, -1).mean(axis=1)
    if abs(from_left - from_right) < 0.1 * max(from_left, from_right, 1e-6):
        return float("nan")
    left, right = (_light_at(image, landmarks, point) for point in sorted(CHEEKS, key=lambda p: landmarks.points[p, 0]))
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


def _rim_dip(shadow: FloatArray, landmarks: Landmarks, face: FloatArray) -> float:
    """See `Look.rim`. Only where the label is face: hair hides what would be seen."""
    unit = landmarks.interocular
    smooth = blurred(shadow, max(0.01 * unit, 0.5))
    up = landmarks.points[FOREHEAD[0], :2] - landmarks.points[_BRIDGE, :2]
    up = up / max(float(np.linalg.norm(up)), 1e-6)
    along = np.arange(-0.3, 0.4, 0.01) * unit
    deepest = np.nan
    for point in FOREHEAD:
        columns, rows = (landmarks.points[point, :2, None] + up[:, None] * along).astype(int)
        inside = (columns > 1) & (columns < shadow.shape[1] - 2) & (rows > 1) & (rows < shadow.shape[0] - 2)
        if np.count_nonzero(inside) < 45:
            continue
        line, skin = (map_[rows[inside], columns[inside]] for map_ in (smooth, face))
        for k in range(8, len(line) - 8):
            if skin[k - 4 : k + 4].min() >= 0.7:
                sides = min(line[:k].max(), line[k + 1 :].max())
                deepest = np.fmax(deepest, 1 - line[k] / max(sides, 1e-3))
    return float(deepest)


def _scaled(image: Image, long_side: int) -> Image:
    """The photo with a long side of at most so many pixels, in whole steps of 8 bits, as its file will have them."""
    import cv2

    factor = long_side / max(image.width, image.height)
    if not 0 < factor < 1:
        return image
    size = max(1, round(image.width * factor)), max(1, round(image.height * factor))
    small = cv2.resize(image.pixels, size, interpolation=cv2.INTER_AREA)
    return image_from_array(np.asarray(np.rint(np.clip(small, 0, 1) * 255), np.uint8))
