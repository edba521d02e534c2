"""A face model from folders of photographs: `graphface models learn`."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import GraphfaceError, UnreadableFile, warn
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmarks.facemesh import facemesh
from graphface.nodes.learning.linear_model import Figures, learn_model
from graphface.nodes.morphable.model import MorphableModel

_SUFFIXES = {".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff"}


def learn_from_photos(
    folder: Path, people: Path | None, name: str, *, identity: int, expression: int, card: Path | None = None
) -> tuple[MorphableModel, Figures]:
    """A model learned from the landmarks of every photo; its card has the figures, and the fields of `card` (JSON).

    Raises:
        UnreadableFile: a folder without a photo that has a face; a card that is not JSON.
    """
    given = read_card(card)
    _, faces = points_in(folder)
    names, of_people = points_in(people) if people is not None else ([], np.zeros((0, 468, 3)))
    persons = [file.rsplit("_", 1)[0] for file in names]
    model, figures = learn_model(name, faces, of_people, persons, identity=identity, expression=expression)
    full: dict[str, Any] = {
        **given,
        "refine": 1,
        "command": f"graphface models learn {folder.name}/"
        + (f" --people {people.name}/" if people is not None else "")
        + f" --identity {identity} --expression {expression}",
        "figures": {key: round(value, 3) for key, value in asdict(figures).items()},
    }
    return replace(model, card=full), figures


def points_in(folder: Path) -> tuple[list[str], NDArray[np.float64]]:
    """File names, and points (n, 468, 3) with y up, of the photos of a folder that have a face."""
    names, found = [], []
    for path in _progress(folder):
        try:
            points = facemesh(read_image(path)).points
        except AssetUnavailable:
            raise
        except GraphfaceError as error:
            warn(f"{path.name} is left out: {error}")
            continue
        names.append(path.name)
        found.append(points.astype(np.float64) * (1, -1, 1))
    if not found:
        raise UnreadableFile(folder, "holds no photograph with a face")
    return names, np.stack(found)


def _progress(folder: Path) -> Iterator[Path]:
    from rich.progress import track

    photos = sorted(p for p in folder.glob("*") if p.suffix.lower() in _SUFFIXES)
    yield from track(photos, description=folder.name, disable=not sys.stderr.isatty())


def read_card(path: Path | None) -> dict[str, Any]:
    """The JSON card at `path`; empty without one.

    Raises:
        UnreadableFile: it is not one JSON object.
    """
    if path is None:
        return {}
    try:
        card = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UnreadableFile(path, f"not a JSON card: {error}") from error
    if not isinstance(card, dict):
        raise UnreadableFile(path, "a card is one JSON object")
    return card
