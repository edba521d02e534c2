"""The page of a run: model, drawing, styles and scripts in one file that asks nobody for anything.

Texts of graphs, parameters and files are only in JSON, which the script puts on the page as text; the drawing escapes
its own. A content security policy backs that up: the browser runs this one script, known by its hash, and loads nothing.
"""

from __future__ import annotations

import json
from base64 import b64encode
from hashlib import sha256
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from graphface.report.page.model import model
from graphface.report.page.read import RUN
from graphface.report.page.tiles import draw_svg
from graphface.report.recorder import Recorder
from graphface.values.writing import beside

_SCRIPTS = ("element", "values", "viewer", "panel", "drawing", "timeline", "lists", "search", "page")
"""In this order, in one scope."""


def write_report(recorder: Recorder, path: Path) -> None:
    """Write the report of the run that was followed, whole or not at all.

    Raises:
        UnwritableFile: the folder cannot be written to. RuntimeError: no run was followed.
    """
    page = report_page(recorder)
    with beside(path) as temporary:
        temporary.write_text(page, encoding="utf-8")


def report_page(recorder: Recorder) -> str:
    """The page as text."""
    shown = model(recorder)
    assert recorder.request is not None
    script = "\n".join(_part(f"{name}.js") for name in _SCRIPTS)
    policy = f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'sha256-{_hash(script)}'"
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{escape(shown["graph"])}: run report</title>
<style>{_part("page.css")}</style>
</head>
<body>
{_part("body.html")}
<template id="svg">{draw_svg(recorder.request.graph)}</template>
<script type="application/json" id="{RUN}">{embedded(recorder.trace.as_json())}</script>
<script type="application/json" id="report">{embedded(shown)}</script>
<script type="application/json" id="blobs">{embedded(recorder.blobs.texts)}</script>
<script type="module">{script}</script>
</body>
</html>
"""


def embedded(value: Any) -> str:
    """JSON that may stand inside an element: nothing in it opens or closes one."""
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _part(name: str) -> str:
    return (files("graphface.report.page") / name).read_text(encoding="utf-8")


def _hash(script: str) -> str:
    return b64encode(sha256(script.encode("utf-8")).digest()).decode("ascii")
