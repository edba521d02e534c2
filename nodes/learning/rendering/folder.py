"""A folder of examples, or of people in several expressions, filled by one process or by several."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from graphface.nodes.io.image_write import write_image
from graphface.nodes.learning.rendering.example import write_example
from graphface.nodes.learning.rendering.expressions import expressive_photos
from graphface.nodes.learning.rendering.head_model import read_head
from graphface.nodes.learning.rendering.picture import make_example
from graphface.nodes.types import Image
from graphface.values.writing import make_folder


def example_path(folder: Path, seed: int) -> Path:
    return folder / f"{seed:07d}.npz"


def render_folder(head: Path, folder: Path, seeds: range, *, size: int, samples: int) -> Iterator[tuple[int, bool]]:
    """Render the example of each seed that is not there yet; yields (seed, whether it had to be rendered).

    An example depends on its seed alone. So a run that was stopped goes on where it was, and several processes may
    have a range each.

    Raises:
        UnreadableFile: `head` is no packed ICT-FaceKit. UsageError: mitsuba is not installed.
    """
    model = read_head(head)
    make_folder(folder)
    for seed in seeds:
        path = example_path(folder, seed)
        missing = not path.exists()
        if missing:
            write_example(make_example(model, seed, size=size, samples=samples), path)
        yield seed, missing


def photo_path(folder: Path, seed: int, number: int) -> Path:
    """Named as `graphface models learn --people` tells people apart."""
    return folder / f"{seed:07d}_{number:02d}.png"


def render_people(
    head: Path, folder: Path, seeds: range, *, expressions: int, size: int, samples: int
) -> Iterator[tuple[int, int]]:
    """Render every person, one a seed, in so many expressions; yields (seed, number of photos that were missing).

    Raises:
        UnreadableFile: `head` is no packed ICT-FaceKit. UsageError: mitsuba is not installed.
    """
    model = read_head(head)
    make_folder(folder)
    for seed in seeds:
        missing = [number for number in range(expressions) if not photo_path(folder, seed, number).exists()]
        if missing:
            for number, photo in expressive_photos(model, seed, missing, size=size, samples=samples):
                write_image(Image(photo.astype(np.float32) / np.float32(255)), photo_path(folder, seed, number))
        yield seed, len(missing)
