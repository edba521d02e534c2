"""The table: a line for each variant, the mean over cases, as CSV and as Markdown."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from graphface.ablation.running import Ablation

_TIMES = ("alone ms", "swapped ms", "spent ms")


def columns(ablation: Ablation) -> list[str]:
    """Variant, every metric, the three times, shared nodes, failures."""
    names = dict.fromkeys(name for cell in ablation.cells for name in cell.figures)
    return ["variant", *names, *_TIMES, "shared nodes", "failed"]


def rows(ablation: Ablation) -> list[dict[str, str | float | int]]:
    """One for each variant; a figure that no case has is absent. "swapped ms": the swapped nodes alone."""
    made = []
    for variant in ablation.variants:
        cells = ablation.of_variant(variant)
        done = [cell for cell in cells if not cell.failure]
        row: dict[str, str | float | int] = {"variant": variant.name}
        for name in dict.fromkeys(n for cell in done for n in cell.figures):
            row[name] = float(np.mean([cell.figures[name] for cell in done if name in cell.figures]))
        if done:
            for column, attribute in zip(_TIMES, ("alone", "swapped", "spent"), strict=True):
                row[column] = float(np.mean([getattr(cell, attribute) for cell in done])) * 1e3
            row["shared nodes"] = f"{sum(c.shared for c in done)} of {sum(c.nodes for c in done)}"
        row["failed"] = len(cells) - len(done)
        made.append(row)
    return made


def as_csv(ablation: Ablation) -> str:
    """Full precision, one header line."""
    text = io.StringIO()
    writer = csv.DictWriter(text, columns(ablation), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows(ablation))
    return text.getvalue()


def as_markdown(ablation: Ablation) -> str:
    """A table that a README takes as it is, with the sentence on sharing under it."""
    names = columns(ablation)
    lines = ["| " + " | ".join(names) + " |", "|" + "|".join([" --- "] + [" ---: "] * (len(names) - 1)) + "|"]
    for row in rows(ablation):
        lines.append("| " + " | ".join(shown(row.get(name, "")) for name in names) + " |")
    return "\n".join([*lines, "", f"{ablation.sharing}.", ""])


def shown(value: str | float | int) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
