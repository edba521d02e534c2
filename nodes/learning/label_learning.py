"""The weights of the label network from photographs and path-traced heads: `graphface models labels`.

The shipped weights were made by it, see their card. Their accuracy on people outside the training set was measured with
other weights, trained by the same schedule on three quarters of the varied portraits, split by person and source.
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
from graphface.nodes.learning.label_pictures import TrainingPicture, head_pictures, photo_pictures
from graphface.nodes.learning.label_training import Examples, trained
from graphface.nodes.learning.label_variations import example
from graphface.nodes.learning.unet_training import folded
from graphface.nodes.masks.network_input import CHANNELS
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH

_SUFFIXES = {".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff"}
_PER_PERSON = 3


@dataclass(frozen=True)
class Schedule:
    """Number of variations of each of the `photos`, `portraits`, pictures of `people` and `heads`; `steps` of eight
    pictures each; `seed` of all random numbers."""

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
    schedule: Schedule,
    without: Sequence[str] = (),
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Weights for `masks.cue`, and their card.

    Args:
        photos: a folder of varied pictures of faces, labelled by `masks.network` as all photographs are.
        without: patterns of names (without suffix; heads are called gt01_top) that are left out, as a test set.
        portraits: a folder of similar pictures. people: a folder of several pictures of each person,
            PERSON_anything.jpg, of which three are used. data: a folder whose truth/ has heads with true labels.

    Raises:
        UnreadableFile: there is no face to learn from. UsageError: PyTorch or LiteRT is not installed.
    """
    counted = [(one, schedule.photos) for one in photo_pictures(_pictures(photos, without))]
    if portraits is not None:
        counted += [(one, schedule.portraits) for one in photo_pictures(_pictures(portraits, without))]
    if people is not None:
        counted += [(one, schedule.people) for one in photo_pictures(_some_of_each(_pictures(people, without)))]
    plates = [one for one, _ in counted]
    if not plates:
        raise UnreadableFile(photos, "holds no photograph with a face")
    heads = [] if data is None else [head for head in head_pictures(data) if not _kept_out(head.name, without)]
    counted += [(head, schedule.heads) for head in heads]
    examples = examples_of(counted, plates, schedule.seed)
    weights = folded(trained(examples, steps=schedule.steps, seed=schedule.seed))
    card = {
        "teacher": "MediaPipe selfie_multiclass_256x256 (Apache-2.0), by masks.network",
        "photographs": len(plates),
        "path_traced_pictures": len(heads),
        "variations": len(examples.cells),
        "course": asdict(schedule),
        **({"without": list(without)} if without else {}),
    }
    return weights, card


def examples_of(
    counted: Sequence[tuple[TrainingPicture, int]], plates: Sequence[TrainingPicture], seed: int
) -> Examples:
    """The given number of variations of each picture, about 160 KB each; backdrops come from `plates`."""
    from rich.progress import track

    count, random = sum(number for _, number in counted), np.random.default_rng(seed)
    cells = np.empty((count, CHANNELS, HEIGHT // 2, WIDTH // 2), np.float16)
    labels, weight = np.empty((count, 3, HEIGHT, WIDTH), np.float16), np.empty((count, HEIGHT, WIDTH), np.float16)
    place = 0
    for picture, number in track(counted, description="variations", disable=not sys.stderr.isatty()):
        for _ in range(number):
            made = example(picture, plates, random)
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
    """The first and the last picture of each person, and others evenly spaced between them."""
    of_person = defaultdict(list)
    for path in pictures:
        of_person[path.stem.rsplit("_", 1)[0]].append(path)
    return [
        own[k]
        for own in of_person.values()
        for k in sorted({round(position) for position in np.linspace(0, len(own) - 1, _PER_PERSON)})
    ]
