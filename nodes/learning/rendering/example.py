"""One picture of a head with everything known about it, and its file."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile
from graphface.values.writing import beside

FORMAT = "graphface-example-1"


REST, BARE_SKIN, EYES_AND_TEETH = range(3)
"""Labels: hair, mouth and background are the rest."""


@dataclass(frozen=True)
class Example:
    """A picture, H x W, and its truth.

    Attributes:
        photo: uint8 H x W x 3, sRGB.
        normals: int8 H x W x 3, 127 times the unit normal in the camera frame; 0 beyond the head.
        depth: float16 H x W, towards the camera, in inter-ocular distances; 0 beyond the head.
        labels: uint8 H x W, REST, BARE_SKIN or EYES_AND_TEETH.
        visibility: uint8 H x W, 255 times the share of the first lamp that nothing stands before.
        facts: seed, lights, pose, expression and camera, as JSON holds them.
    """

    photo: NDArray[np.uint8]
    normals: NDArray[np.int8]
    depth: NDArray[np.float16]
    labels: NDArray[np.uint8]
    visibility: NDArray[np.uint8]
    facts: dict[str, Any]


def write_example(example: Example, path: Path) -> None:
    """Write an example as .npz, whole or not at all.

    Raises:
        UnwritableFile: the folder refuses.
    """
    with beside(path) as unfinished:
        np.savez_compressed(
            unfinished,
            photo=example.photo,
            normals=example.normals,
            depth=example.depth,
            labels=example.labels,
            visibility=example.visibility,
            facts=np.array(json.dumps(example.facts)),
        )


def read_example(path: Path) -> Example:
    """An example as `write_example` wrote it.

    Raises:
        UnreadableFile: it is missing, damaged or of another format.
    """
    names = ("photo", "normals", "depth", "labels", "visibility")
    try:
        with np.load(path, allow_pickle=False) as file:
            facts = json.loads(str(file["facts"]))
            arrays = {name: file[name] for name in names}
    except (OSError, ValueError, EOFError, KeyError) as error:
        raise UnreadableFile(path, f"not an example of `graphface models render`: {error}") from error
    if facts.get("format") != FORMAT:
        raise UnreadableFile(path, f"its format is not {FORMAT!r}")
    return Example(**arrays, facts=facts)
