"""The weights of the label network from photographs and path-traced heads: `graphface models labels`.

The shipped weights were made by it, see their card, from official portraits and rendered heads alone: what is published
for research may judge them, but does not teach them.
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
from graphface.nodes.learning.label_pictures import TrainingPicture, head_pictures
from graphface.nodes.learning.label_renderings import rendered_pictures
from graphface.nodes.learning.label_store import kept_pictures
from graphface.nodes.learning.label_training import Examples, trained
from graphface.nodes.learning.label_variations import example
from graphface.nodes.learning.unet_training import folded
from graphface.nodes.masks.network_input import CHANNELS
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH

_SUFFIXES = {".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff"}
_PER_PERSON = 3

_MUCH_HAIR = 0.05
"""Share of a picture's lower half."""


@dataclass(frozen=True)
class Schedule:
    """Number of variations of each of the `photos`, `portraits`, pictures of `people`, `heads` and `rendered` heads, of
    which `renderings` are taken; `steps` of eight pictures each; `seed` of all random numbers.

    Pictures with much hair are rarer among portraits and count twice.
    """

    photos: int = 60
    portraits: int = 36
    people: int = 20
    heads: int = 20
    rendered: int = 5
    renderings: int = 800
    steps: int = 15000
    seed: int = 0


@dataclass(frozen=True)
class Sources:
    """Where training pictures come from.

    Attributes:
        photos: a folder of varied pictures of faces, labelled by `masks.network` as all photographs are.
        portraits: a folder of similar pictures.
        people: a folder of several pictures of each person, PERSON_anything.jpg, of which three are used.
        data: a folder whose truth/ has heads with true labels.
        rendered: a folder that `graphface models render` filled.
        only, without: patterns of names (without suffix; heads of `data` are called gt01_top). Of `photos` those that
            `only` names are taken, all where it is empty; what `without` names is left out everywhere, as a test set.
        kept: a folder for labelled photographs, so that another run need not label them again.
    """

    photos: Path
    portraits: Path | None = None
    people: Path | None = None
    data: Path | None = None
    rendered: Path | None = None
    only: Sequence[str] = ()
    without: Sequence[str] = ()
    kept: Path | None = None


def learn_labels(sources: Sources, schedule: Schedule) -> tuple[dict[str, Any], dict[str, Any]]:
    """Weights for `masks.cue`, and their card.

    Raises:
        UnreadableFile: there is no face to learn from. UsageError: PyTorch or LiteRT is not installed.
    """
    without = sources.without
    photos = [
        path for path in _pictures(sources.photos, without) if not sources.only or _named(path.stem, sources.only)
    ]
    found = [(photos, schedule.photos)]
    if sources.portraits is not None:
        found.append((_pictures(sources.portraits, without), schedule.portraits))
    if sources.people is not None:
        found.append((_some_of_each(_pictures(sources.people, without)), schedule.people))
    counted = [
        (picture, number * (2 if hairy(picture) else 1))
        for paths, number in found
        for picture in kept_pictures(paths, sources.kept)
    ]
    plates = [one for one, _ in counted]
    if not plates:
        raise UnreadableFile(sources.photos, "holds no photograph with a face")
    heads = (
        [] if sources.data is None else [head for head in head_pictures(sources.data) if not _named(head.name, without)]
    )
    counted += [(head, schedule.heads) for head in heads]
    rendered = [] if sources.rendered is None else list(rendered_pictures(sources.rendered, schedule.renderings))
    counted += [(head, schedule.rendered) for head in rendered]
    examples = examples_of(counted, plates, schedule.seed)
    weights = folded(trained(examples, steps=schedule.steps, seed=schedule.seed))
    card = {
        "teacher": "MediaPipe selfie_multiclass_256x256 (Apache-2.0), by masks.network",
        "photographs": len(plates),
        "path_traced_pictures": len(heads) + len(rendered),
        "variations": len(examples.cells),
        "course": asdict(schedule),
        **({"only": list(sources.only)} if sources.only else {}),
        **({"without": list(without)} if without else {}),
    }
    return weights, card


def hairy(picture: TrainingPicture) -> bool:
    """Whether there is much hair below the middle of the face: it can be put on others."""
    middle = float(picture.landmarks.points[:, 1].mean())
    return bool((picture.labels[int(max(middle, 0)) :, :, 1] > 200).mean() > _MUCH_HAIR)


def examples_of(
    counted: Sequence[tuple[TrainingPicture, int]], plates: Sequence[TrainingPicture], seed: int
) -> Examples:
    """The given number of variations of each picture, about 160 KB each; backdrops and hair come from `plates`."""
    from rich.progress import track

    count, random = sum(number for _, number in counted), np.random.default_rng(seed)
    donors = [plate for plate in plates if hairy(plate)]
    cells = np.empty((count, CHANNELS, HEIGHT // 2, WIDTH // 2), np.float16)
    labels, weight = np.empty((count, 3, HEIGHT, WIDTH), np.float16), np.empty((count, HEIGHT, WIDTH), np.float16)
    place = 0
    for picture, number in track(counted, description="variations", disable=not sys.stderr.isatty()):
        for _ in range(number):
            made = example(picture, plates, random, donors)
            cells[place], labels[place] = made.cells.transpose(2, 0, 1), made.labels.transpose(2, 0, 1)
            weight[place] = made.weight
            place += 1
    return Examples(cells, labels, weight)


def _pictures(folder: Path, without: Sequence[str]) -> list[Path]:
    found = (path for path in folder.glob("*") if path.suffix.lower() in _SUFFIXES)
    return sorted(path for path in found if not _named(path.stem, without))


def _named(name: str, without: Sequence[str]) -> bool:
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
