"""What the normals network sees of rendered examples, and what it should say: computed once, kept beside them."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import Evaluator, Graph, GraphfaceError, MemoryTier, UnreadableFile, load
from graphface.fingerprint import fingerprint
from graphface.nodes.learning.rendering.example import BARE_SKIN, EYES_AND_TEETH, Example, read_example
from graphface.nodes.surface.face_crop import SIZE, FaceCrop, face_crop
from graphface.nodes.surface.normal_network import COVERAGE, network_input
from graphface.nodes.types import FloatArray, Image
from graphface.values.writing import beside, make_folder

ASKED = {
    "photo": "working",
    "surface": "fitted_surface",
    "landmarks": "landmarks",
    "mask": "mask",
    "light": "light",
}
"""Outputs of the graph `represent` behind what the network sees."""

_INTERIOR = 0.25
"""Weight of eyes and teeth, which few pixels show and which the mesh has not."""

_INSIDE = 0.9
"""Share of skin in a pixel from which its shadow counts."""

_EDGE = 4
"""Pixels along the edge of skin that nothing is learned from."""


@dataclass(frozen=True)
class Lesson:
    """What is seen and what is true on the crop, float16.

    Attributes:
        seen: SIZE x SIZE x CHANNELS.
        normals: SIZE x SIZE x 3; `weight`, SIZE x SIZE, is what an error counts there.
        shadow: SIZE x SIZE, 1 where something stands before the first lamp; `lit` is what an error counts there.
    """

    seen: NDArray[np.float16]
    normals: NDArray[np.float16]
    weight: NDArray[np.float16]
    shadow: NDArray[np.float16]
    lit: NDArray[np.float16]


def lessons_of(folder: Path) -> Iterator[Lesson]:
    """The lesson of each example in which the graph finds a face.

    Lessons are kept in `folder`/seen, with the reason as a text where there is none. They are made
    again when the graph or the code of its operators has changed.

    Raises:
        UnreadableFile: there are no examples.
    """
    from rich.progress import track

    graph = load("represent")
    paths = sorted(folder.glob("*.npz"))
    if not paths:
        raise UnreadableFile(folder, "holds no examples; `graphface models render` makes them")
    kept = folder / "seen" / _version(graph, read_example(paths[0]))
    make_folder(kept)
    for path in track(paths, description="examples", disable=not sys.stderr.isatty()):
        own = kept / path.name
        without = own.with_suffix(".txt")
        if not own.exists() and not without.exists():
            try:
                _write(lesson_of(read_example(path), graph), own)
            except GraphfaceError as error:
                without.write_text(f"{error}\n", encoding="utf-8")
        if own.exists():
            yield _read(own)


def lesson_of(example: Example, graph: Graph) -> Lesson:
    """What the network sees of an example, and what it should say.

    Raises:
        GraphfaceError: no face is found.
    """
    import cv2

    photo = Image(example.photo.astype(np.float32) / np.float32(255))
    found = graph.run(list(ASKED.values()), evaluator=Evaluator(memory=MemoryTier()), photo=photo)
    crop = face_crop(found["landmarks"])
    seen = network_input(crop, **{port: found[output] for port, output in ASKED.items() if port != "landmarks"})
    normals = crop.turned(crop.sampled(example.normals.astype(np.float32) / 127))
    normals /= np.maximum(np.sqrt(np.square(normals).sum(axis=2, keepdims=True)), 1e-3)
    skin, inner = (crop.sampled((example.labels == k).astype(np.float32)) for k in (BARE_SKIN, EYES_AND_TEETH))
    known = (seen[..., COVERAGE] > 0.9) & (skin + inner > 0.9) & (_inside(crop.matrix, example.photo.shape))
    # Beside hair, which stands off the scalp like a step, the skin's own normals are those of the step.
    known = cv2.erode(known.astype(np.uint8), np.ones((2 * _EDGE + 1, 2 * _EDGE + 1), np.uint8)) > 0
    weight = np.where(skin > 0.5, skin, _INTERIOR * inner) * known
    shadow, lit = shadow_of(example, crop)
    return Lesson(*(np.asarray(part, np.float16) for part in (seen, normals, weight, shadow, lit)))


def shadow_of(example: Example, crop: FaceCrop) -> tuple[FloatArray, FloatArray]:
    """Where something stands before the first lamp, and what an error counts there, SIZE x SIZE each.

    What is turned away from the lamp is dark in any case, and counts little. Even light has no shadow to be found.
    """
    skin = crop.sampled((example.labels == BARE_SKIN).astype(np.float32))
    lights = example.facts["lights"]
    if lights["kind"] == "even":
        return np.zeros_like(skin), np.asarray(skin > _INSIDE, np.float32)
    towards = np.array(lights["lamps"][0]["direction"], np.float32)
    facing = np.clip(example.normals.astype(np.float32) / 127 @ towards, 0, 1)
    shadow = crop.sampled(1 - example.visibility.astype(np.float32) / 255)
    return np.clip(shadow, 0, 1), np.asarray(crop.sampled(facing) * (skin > _INSIDE), np.float32)


def _inside(matrix: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Pixels of the crop that lie within the photo."""
    y, x = np.mgrid[:SIZE, :SIZE].astype(np.float64)
    places = np.stack([x - matrix[0, 2], y - matrix[1, 2]], axis=-1) @ np.linalg.inv(matrix[:, :2]).T
    inside: NDArray[np.bool_] = ((places >= 0) & (places <= np.array(shape[1::-1]) - 1)).all(axis=2)
    return inside


def _version(graph: Graph, example: Example) -> str:
    """Changes with the graph, the code of its operators and what makes the network's input of their results."""
    photo = Image(example.photo.astype(np.float32))
    request = graph.request({"photo": photo}, list(ASKED.values()))
    keys = [request.key(request.graph.targets([output])[output].slot).hex()[:8] for output in ASKED.values()]
    return "-".join([*keys, fingerprint(lesson_of).digest.hex()[:8]])


def _write(lesson: Lesson, path: Path) -> None:
    with beside(path) as unfinished:
        np.savez(unfinished, **{part.name: getattr(lesson, part.name) for part in fields(lesson)})


def _read(path: Path) -> Lesson:
    with np.load(path, allow_pickle=False) as file:
        return Lesson(**{part.name: file[part.name] for part in fields(Lesson)})
