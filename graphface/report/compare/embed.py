"""A page that needs no other file: scripts, styles, pictures and data inside it.

Words from graphs and files travel as JSON in which no "<" stands, and the script puts them into the page as text. A
policy in the page has the browser run this one script, known by its hash, and load nothing.
"""

from __future__ import annotations

import json
from base64 import b64encode
from dataclasses import asdict
from hashlib import sha256
from html import escape
from importlib.resources import files
from typing import Any

from graphface.report.blobs import Blobs, Sheet


def page(title: str, body: str, *, styles: list[str], scripts: list[str], data: dict[str, Any]) -> str:
    """The HTML text.

    Args:
        body: markup. styles, scripts: their texts, after those of the viewer. data: what scripts find by `id`, as JSON.
    """
    style = "\n".join([_asset("viewer.css"), *styles])
    values = (files("graphface.report") / "values.js").read_text(encoding="utf-8")
    script = "\n".join([values, _asset("viewer.js"), *scripts])
    digest = b64encode(sha256(f"\n{script}\n".encode()).digest()).decode("ascii")
    policy = f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    blocks = "\n".join(
        f'<script type="application/json" id="{key}">{inert(held)}</script>' for key, held in data.items()
    )
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>\n{style}\n</style></head>\n<body>\n{body}\n{blocks}\n"
        f"<script>\n{script}\n</script></body></html>\n"
    )


def layer(sheet: Sheet, label: str, *, title: str = "") -> dict[str, Any]:
    """A picture as the viewer takes it, under a label."""
    made: dict[str, Any] = {
        "label": label,
        "title": title,
        "note": sheet.note,
        "width": sheet.width,
        "height": sheet.height,
        "image": sheet.image,
    }
    if sheet.packed is not None and sheet.full is not None:
        packed = asdict(sheet.packed)
        packed["planes"] = list(sheet.planes)
        made |= {"data": packed, "full": list(sheet.full)}
    return made


def texts(blobs: Blobs) -> list[str]:
    """The blobs as a page holds them, in base64."""
    return [b64encode(content).decode("ascii") for content in blobs.contents]


def message(label: str, words: str) -> dict[str, Any]:
    """In place of a picture: why there is none."""
    return {"label": label, "message": words, "note": ""}


def inert(data: Any) -> str:
    """JSON that can stand in a page: it cannot end its block or begin another."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _asset(name: str) -> str:
    return (files("graphface.report.compare") / name).read_text(encoding="utf-8")
