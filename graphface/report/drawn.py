"""Outputs that are written as pictures: drawn the moment they are there, over what they were made from."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.errors import UnwritableFile
from graphface.evaluate.evaluator import Evaluator
from graphface.graph.structure import Ref
from graphface.graph.wired import WiredGraph
from graphface.pictures import draw
from graphface.report.watching import Watcher
from graphface.values.picture import Picture, View
from graphface.values.writing import beside

_HOW: dict[str, dict[str, Any]] = {".png": {"compress_level": 1}, ".webp": {"lossless": True}}
"""What Pillow is told when it writes a picture; of a JPEG, something else."""


class DrawnOutputs(Watcher):
    """The pictures of some targets of a run.

    Args:
        targets: name to what is asked for.

    Attributes:
        wanted: names of those that are drawn; all, unless it is set.
    """

    def __init__(self, graph: WiredGraph, targets: Mapping[str, Ref], evaluator: Evaluator) -> None:
        super().__init__(evaluator)
        self._graph = graph
        self._targets = targets
        self._pictures: dict[str, Picture] = {}
        self.wanted: set[str] = set(targets)

    def on_value(self, slot: int, value: Any) -> None:
        for name, ref in self._targets.items():
            if ref.slot == slot and name in self.wanted:
                part = value
                for field in ref.fields:
                    part = getattr(part, field, None)
                self._pictures[name] = self._draw(part, ref, View(above=self.above(slot)))

    def picture(self, name: str, value: Any) -> Picture:
        """The picture of a target; `value` is drawn alone where the run did not tell it."""
        found = self._pictures.pop(name, None)
        return found if found is not None else self._draw(value, self._targets[name], View())

    def _draw(self, value: Any, ref: Ref, view: View) -> Picture:
        return draw(value, self._graph.type_of(ref), self._graph.registry, view)


def write_pixels(pixels: NDArray[np.uint8], path: Path) -> None:
    """Write uint8 H x W x 3 as PNG, WebP (both without loss) or JPEG; whole or not at all.

    Raises:
        UnwritableFile: the folder refuses, or the format does not hold a picture of that size.
    """
    from PIL import Image

    how = _HOW.get(path.suffix.lower(), {"quality": 95, "subsampling": 0})
    try:
        with beside(path) as temporary:
            Image.fromarray(pixels).save(temporary, **how)
    except (OSError, ValueError) as error:
        raise UnwritableFile(path, getattr(error, "strerror", None) or str(error)) from None
