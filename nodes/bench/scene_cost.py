"""What a scene costs: the nodes that run after an edit of the light, and their time."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from graphface import load, read_yaml
from graphface.evaluate.session import Session
from graphface.nodes.bench.shipped import astronaut, shipped_scenes
from graphface.nodes.io.image_read import read_image
from graphface.nodes.types import Image, Scene
from graphface.nodes.types.image import image_from_array

_ARRAYS = 5
"""Pictures of three channels that recombining must read or write: photo, albedo, detail's two parts, result."""

_BEFORE = 6
"""Edits before the measured ones: they fill what all edits share, and all memory that a session uses."""

_EFFECTS = {"shadows": "shadows", "scatter": "scattering", "highlights": "highlights", "composite": "labels"}

_SUN = {"type": "directional", "azimuth": -40, "shadow": "none"}
_SPOT = {"type": "spot", "azimuth": -40, "elevation": 20, "cone": 40}

PLAIN: dict[str, dict[str, Any]] = {
    "harmonics only": {"lights": [{"type": "sh", "preset": "left"}], "background": 1, "hair": 0},
    "sun, no shadow": {"specular": 0, "ambient": 0.3, "lights": [_SUN]},
    "soft-shadowed spot": {"specular": 0, "ambient": 0.3, "lights": [_SPOT]},
}
"""Edits that the targets of interactive speed name."""


@dataclass(frozen=True)
class Cost:
    """`milliseconds` from the edit to the picture, representation in memory, and `cpu_ms` of all threads meanwhile.

    `copy`: milliseconds of copying the arrays that the edit reads or writes.
    """

    scene: str
    nodes: int
    effects: str
    milliseconds: float
    cpu_ms: float
    copy: float


def scene_costs(photo: Path | None, megapixels: float, repeats: int) -> Iterator[Cost]:
    """One row for each plain edit and each shipped scene; times are medians of `repeats` edits."""
    image = _scaled(image_from_array(astronaut()) if photo is None else read_image(photo), megapixels)
    session = Session(load("relight"), {"photo": image})
    session.render(["image", "face.labels"])
    named = {name: Scene.coerce(given) for name, given in PLAIN.items()}
    named |= {path.stem: read_yaml(path, Scene) for path in shipped_scenes()}
    for name, scene in named.items():
        yield _cost(session, name, scene, repeats, _copy_time(image, repeats))


def _cost(session: Session, name: str, scene: Scene, repeats: int, copy: float) -> Cost:
    took, spent, ran = [], [], set[str]()
    for turn in range(_BEFORE + repeats):
        # A hair's breadth of exposure makes each edit a new one.
        session.edit(scene=scene.model_copy(update={"exposure": scene.exposure * (1 + 1e-5 * (turn + 1))}))
        start, cpu = time.perf_counter(), time.process_time()
        result = session.render(["image"])
        took.append(time.perf_counter() - start)
        spent.append(time.process_time() - cpu)
        ran = {record.name for record in result.records if record.state == "ran"} - {"scene", "photo"}
    effects = ", ".join(label for node, label in _EFFECTS.items() if node in ran and _used(node, scene))
    milliseconds, cpu_ms = (1e3 * median(seconds[_BEFORE:]) for seconds in (took, spent))
    return Cost(name, len(ran), effects or "none", milliseconds, cpu_ms, copy)


def _used(node: str, scene: Scene) -> bool:
    return node != "composite" or scene.background != 1 or scene.hair != 0


def _copy_time(image: Image, repeats: int) -> float:
    """Milliseconds to copy the arrays that an edit must touch."""
    arrays = [image.pixels.copy() for _ in range(_ARRAYS)]
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        for array in arrays:
            array.copy()
        seconds.append(time.perf_counter() - start)
    return 1e3 * median(seconds)


def _scaled(image: Image, megapixels: float) -> Image:
    import cv2

    factor = float(np.sqrt(megapixels * 1e6 / max(image.width * image.height, 1)))
    size = (max(1, round(image.width * factor)), max(1, round(image.height * factor)))
    scaled = cv2.resize(image.pixels, size, interpolation=cv2.INTER_AREA if factor < 1 else cv2.INTER_CUBIC)
    return image_from_array(np.ascontiguousarray(np.clip(scaled, 0, 1), np.float32))
