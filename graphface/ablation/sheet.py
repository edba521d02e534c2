"""The contact sheet: for each case and variant the whole output, a crop, and the difference from the reference."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from graphface.ablation.drawing import Box, Picture, cropped, difference, picture_of, where_they_differ
from graphface.values.writing import beside

if TYPE_CHECKING:
    from PIL.Image import Image

    from graphface.ablation.running import Ablation, Cell

WIDTH = 320
_CAPTION = 22
_GAP = 4
_PAPER, _INK = (24, 24, 24), (235, 235, 235)
_MOST_ROWS = 60


def write_sheet(ablation: Ablation, path: Path, *, crop: Box | None = None) -> None:
    """Write the sheet as PNG: whole, crop (the same window for every variant) and difference x 4.

    The reference is the truth where there is one, else the first variant. A variant that failed has its reason instead.

    Raises:
        UnwritableFile: the folder cannot be written to.
    """
    from PIL import Image as pillow

    rows = []
    for case in range(len(ablation.cases)):
        rows += _case_rows(ablation, case, crop)
    rows = rows[:_MOST_ROWS]
    high = max(picture.shape[0] * WIDTH // max(1, picture.shape[1]) for row in rows for _, picture in row)
    sheet = pillow.new("RGB", (3 * (WIDTH + _GAP), len(rows) * (high + _CAPTION)), _PAPER)
    for line, row in enumerate(rows):
        for column, (caption, picture) in enumerate(row):
            _paste(sheet, picture, caption, column * (WIDTH + _GAP), line * (high + _CAPTION), high)
    with beside(path) as temporary:
        sheet.save(temporary)


def _case_rows(ablation: Ablation, case: int, crop: Box | None) -> list[list[tuple[str, Picture]]]:
    """A row for the truth, where there is one, and for each variant: the whole, a part enlarged, the difference."""
    declared = ablation.graph.type_of(ablation.graph.targets([ablation.output])[ablation.output])
    registry = ablation.graph.registry
    cells, truth = ablation.of_case(case), ablation.truths[case]
    pictures = [(cell, picture_of(cell.value, declared, registry)) for cell in cells if cell.value is not None]
    if not pictures:
        return [[(f"{cell.variant.name}: {cell.failure or 'no picture'}", _blank())] for cell in cells]
    true_picture = None if truth is None else picture_of(truth, declared, registry)
    box = crop if crop is not None else where_they_differ([picture for _, picture in pictures])
    rows = []
    if true_picture is not None:
        rows.append([("truth", true_picture), ("", cropped(true_picture, box)), ("", np.full_like(true_picture, 128))])
        against, reference = "difference from the truth x 4", true_picture
    else:
        against, reference = "difference from the first x 4", pictures[0][1]
    for cell, picture in pictures:
        rows.append([(caption(cell), picture), ("", cropped(picture, box)), (against, difference(picture, reference))])
    return rows + [[(f"{c.variant.name}: {c.failure}", _blank())] for c in cells if c.value is None]


def caption(cell: Cell) -> str:
    """A variant's name, its first two figures and its time."""
    figures = [f"{name} {value:.4g}" for name, value in list(cell.figures.items())[:2]]
    return "   ".join([cell.variant.name, *figures, f"{cell.alone * 1e3:.0f} ms"])


def _blank() -> Picture:
    return np.full((WIDTH // 4, WIDTH, 3), 60, np.uint8)


def _paste(sheet: Image, picture: Picture, text: str, left: int, top: int, high: int) -> None:
    from PIL import Image as pillow
    from PIL import ImageDraw

    scale = min(WIDTH / picture.shape[1], high / picture.shape[0])
    size = (max(1, round(picture.shape[1] * scale)), max(1, round(picture.shape[0] * scale)))
    sheet.paste(pillow.fromarray(picture).resize(size, pillow.Resampling.LANCZOS), (left, top + _CAPTION))
    ImageDraw.Draw(sheet).text((left + 4, top + 5), text, fill=_INK)
