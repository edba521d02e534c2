"""From photographs and path-traced heads to the weights of the label network: `graphface models labels`.

The shipped weights were made so, see their card. How well they label people that they have not seen was measured with
weights that had not seen them: the same course on three quarters of the varied portraits, by person and source.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import numpy as np

from graphface import UnreadableFile
from graphface.nodes.learning.label_lessons import Lesson, head_lessons, photo_lessons
from graphface.nodes.learning.label_training import Examples, folded, trained
from graphface.nodes.learning.label_variations import example
from graphface.nodes.masks.network_input import CHANNELS
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH

_SUFFIXES = {".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff"}
_OF_EACH_PERSON = 3


@dataclass(frozen=True)
class Course:
    """How often the network is shown what: variations of each of the `photos`, `portraits`, pictures of `people` and
    `heads`; `steps` of eight pictures each; `seed` of everything random."""

    photos: int = 60
    portraits: int = 16
    people: int = 20
    heads: int = 36
    steps: int = 12000
    seed: int = 0


def learn_labels(
    photos: Path,
    portraits: Path | None,
    people: Path | None,
    data: Path | None,
    course: Course,
    without: Sequence[str] = (),
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Weights for `masks.cue`, and what their card says.

    Args:
        photos: a folder of varied pictures of faces, labelled by `masks.network` as all photographs are.
        without: patterns of names (without suffix; heads are called gt01_top) that are kept out, to be tested on.
        portraits: a folder of pictures that are much alike. people: one of several pictures of each person,
            PERSON_anything.jpg, of which three are taken. data: a folder whose truth/ has heads with true labels.

    Raises:
        UnreadableFile: there is no face to learn from. UsageError: PyTorch or LiteRT is not installed.
    """
    lessons = [(lesson, course.photos) for lesson in photo_lessons(_pictures(photos, without))]
    if portraits is not None:
        lessons += [(lesson, course.portraits) for lesson in photo_lessons(_pictures(portraits, without))]
    if people is not None:
        lessons += [(lesson, course.people) for lesson in photo_lessons(_some_of_each(_pictures(people, without)))]
    plates = [lesson for lesson, _ in lessons]
    if not plates:
        raise UnreadableFile(photos, "holds no photograph with a face")
    heads = [] if data is None else [head for head in head_lessons(data) if not _kept_out(head.name, without)]
    lessons += [(head, course.heads) for head in heads]
    examples = examples_of(lessons, plates, course.seed)
    weights = folded(trained(examples, steps=course.steps, seed=course.seed))
    card = {
        "teacher": "MediaPipe selfie_multiclass_256x256 (Apache-2.0), by masks.network",
        "photographs": len(plates),
        "path_traced_pictures": len(heads),
        "variations": len(examples.cells),
        "course": asdict(course),
        **({"without": list(without)} if without else {}),
    }
    return weights, card


def examples_of(lessons: Sequence[tuple[Lesson, int]], plates: Sequence[Lesson], seed: int) -> Examples:
    """As many variations of each lesson as its number says; about 160 KB each."""
    from rich.progress import track

    count, random = sum(number for _, number in lessons), np.random.default_rng(seed)
    cells = np.empty((count, CHANNELS, HEIGHT // 2, WIDTH // 2), np.float16)
    labels, weight = np.empty((count, 3, HEIGHT, WIDTH), np.float16), np.empty((count, HEIGHT, WIDTH), np.float16)
    place = 0
    for lesson, number in track(lessons, description="variations", disable=not sys.stderr.isatty()):
        for _ in range(number):
            made = example(lesson, plates, random)
            cells[place], labels[place] = made.cells.transpose(2, 0, 1), made.labels.transpose(2, 0, 1)
            weight[place] = made.weight
            place += 1
    return Examples(cells, labels, weight)


def _pictures(folder: Path, without: Sequence[str]) -> list[Path]:
    found = (path for path in folder.glob("*") if path.suffix.lower() in _SUFFIXES)
    return sorted(path for path in found if not _kept_out(path.stem, without))


def _kept_out(name: str, without: Sequence[str]) -> bool:
    return any(fnmatchcase(name, pattern) for pattern in without)


def _some_of_each(pictures: list[Path]) -> list[Path]:
    """Of each person's pictures the first, the last and those evenly between."""
    of_person = defaultdict(list)
    for path in pictures:
        of_person[path.stem.rsplit("_", 1)[0]].append(path)
    return [
        theirs[k]
        for theirs in of_person.values()
        for k in sorted({round(place) for place in np.linspace(0, len(theirs) - 1, _OF_EACH_PERSON)})
    ]
