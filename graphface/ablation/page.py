"""The HTML page: one file with the table, and the pictures of all variants under the viewer that pages share."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphface.ablation.pictures import CasePictures, Pictures
from graphface.ablation.table import shown_columns
from graphface.report.compare.embed import page, texts
from graphface.values.writing import beside

if TYPE_CHECKING:
    from graphface.ablation.running import Ablation


def write_page(ablation: Ablation, pictures: Pictures, path: Path) -> None:
    """Write the page; pictures are inside it, so that it can be mailed.

    Args:
        pictures: what was drawn while the ablation ran.

    Raises:
        UnwritableFile: the folder cannot be written to.
    """
    with beside(path) as temporary:
        temporary.write_text(page_text(ablation, pictures), encoding="utf-8")


def page_text(ablation: Ablation, pictures: Pictures) -> str:
    """The HTML of the page."""
    title = f"{ablation.graph.name}: {ablation.output}"
    data = {
        "title": title,
        "sharing": f"{ablation.sharing}.",
        "columns": [
            {"title": c.title, "meaning": c.meaning, "texts": list(c.texts), "best": sorted(c.best)}
            for c in shown_columns(ablation)
        ],
        "cases": [_case(ablation, place, shown) for place, shown in enumerate(pictures.cases)],
    }
    assets = files("graphface.ablation")
    return page(
        f"{title}: ablation",
        '<div id="ablation"></div><noscript>This page needs JavaScript; nothing is loaded.</noscript>',
        styles=[(assets / "page.css").read_text(encoding="utf-8")],
        scripts=[(assets / "page.js").read_text(encoding="utf-8")],
        data={"ablated": data, "blobs": texts(pictures.blobs)},
    )


def _case(ablation: Ablation, case: int, shown: CasePictures) -> dict[str, Any]:
    given = ", ".join(f"{name} = {_short(value)}" for name, value in ablation.cases[case].items())
    variants = range(len(ablation.variants))
    return {
        "label": given or "the graph's defaults",
        "original": shown.original,
        "truth": shown.truth,
        "places": shown.places,
        "layers": [[shown.layers.get((place, v)) for v in variants] for place in shown.places],
    }


def _short(value: Any) -> str:
    """A file by its name, anything else as it is."""
    return Path(value).name if isinstance(value, str | Path) else repr(value)[:60]
