"""The table: a line for each variant, the mean over cases; in full precision as CSV, rounded for people."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from graphface.ablation.rounding import best, duration, rounded

if TYPE_CHECKING:
    from graphface.ablation.running import Ablation

_TIMES = ("alone ms", "swapped ms", "spent ms")
_MEANINGS = {
    "alone": "time of all its nodes, when nothing is memoized",
    "swapped nodes": "time of the nodes whose operator or parameters are not the same in every variant",
    "spent here": "time that it took in this run, after what earlier variants had left",
    "shared nodes": "how many nodes another variant had computed already",
}


@dataclass(frozen=True)
class Column:
    """One column for people.

    Attributes:
        title: its heading. meaning: in a sentence. texts: by variant. best: the variants that are best in it.
    """

    title: str
    texts: Sequence[str]
    meaning: str = ""
    best: frozenset[int] = frozenset()


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


def shown_columns(ablation: Ablation) -> list[Column]:
    """The table for people: rounded, the best of each column known where its metric says what is better."""
    table = rows(ablation)
    metrics = {metric.name: metric for metric in ablation.metrics}
    shown = [Column("variant", [str(row["variant"]) for row in table])]
    for name in columns(ablation)[1 : -len(_TIMES) - 2]:
        values = _values(table, name)
        better, unit = (metrics[name].better, metrics[name].unit) if name in metrics else (None, "")
        texts = rounded(values, unit)
        meaning = f"{better} is better" if better else ""
        shown.append(Column(name, texts, meaning, _said_best(best(values, better), texts)))
    for name, title in zip(_TIMES, ("alone", "swapped nodes", "spent here"), strict=True):
        values = _values(table, name)
        texts = ["" if v is None else duration(v / 1e3) for v in values]
        # what was spent here depends on the order of the variants: none of them is the best at that
        winners = best(values, "lower" if title != "spent here" else None)
        shown.append(Column(title, texts, _MEANINGS[title], _said_best(winners, texts)))
    shown.append(Column("shared nodes", [str(row.get("shared nodes", "")) for row in table], _MEANINGS["shared nodes"]))
    if any(row["failed"] for row in table):
        shown.append(Column("failed", [str(row["failed"]) for row in table], "cases that gave no output"))
    return shown


def as_csv(ablation: Ablation) -> str:
    """Full precision, one header line."""
    text = io.StringIO()
    writer = csv.DictWriter(text, columns(ablation), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows(ablation))
    return text.getvalue()


def as_markdown(ablation: Ablation) -> str:
    """A table that a README takes as it is, the best in bold, with the sentence on sharing under it."""
    shown = shown_columns(ablation)
    lines = [_line([c.title for c in shown]), "|" + "|".join([" --- "] + [" ---: "] * (len(shown) - 1)) + "|"]
    for place in range(len(ablation.variants)):
        lines.append(_line([f"**{c.texts[place]}**" if place in c.best else c.texts[place] for c in shown]))
    return "\n".join([*lines, "", f"{ablation.sharing}.", ""])


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _values(table: Sequence[dict[str, str | float | int]], name: str) -> list[float | None]:
    return [float(row[name]) if name in row else None for row in table]


def _said_best(places: set[int], texts: Sequence[str]) -> frozenset[int]:
    """The best, and those that read the same; none where all do."""
    said = {texts[place] for place in places}
    alike = frozenset(place for place, text in enumerate(texts) if text in said)
    return alike if len(alike) < len([t for t in texts if t]) else frozenset()
