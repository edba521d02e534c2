"""A folder of examples, filled by one process or by several."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from graphface.nodes.learning.rendering.example import write_example
from graphface.nodes.learning.rendering.head_model import read_head
from graphface.nodes.learning.rendering.picture import make_example
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
