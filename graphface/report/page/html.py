"""The page of a run: model, drawing, styles and scripts in one file that loads nothing from elsewhere.

Texts of graphs, parameters and files are only in JSON, which the script puts on the page as text; the drawing escapes
its own. A content security policy backs that up: browsers run this one script, known by its hash, and load nothing.
"""

from __future__ import annotations

import json
from base64 import b64encode
from hashlib import sha256
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from graphface.errors import RefusedOutput
from graphface.report.drawing.marks import Mark, MarkState
from graphface.report.drawing.svg import draw_svg
from graphface.report.page.model import model
from graphface.report.page.read import RUN
from graphface.report.page.seven_bit import seven_bit
from graphface.report.recorder import Recorder
from graphface.values.writing import beside, check_folder

_SCRIPTS = ("element", "viewer", "panel", "drawing", "timeline", "lists", "search", "page")
"""In this order, in one scope."""


def write_report(recorder: Recorder, path: Path) -> None:
    """Write the report of the run that was followed, whole or not at all.

    Raises:
        UnwritableFile: the folder cannot be written to. RuntimeError: no run was followed.
    """
    page = report_page(recorder)
    with beside(path) as temporary:
        temporary.write_bytes(page.encode("utf-8"))


def check_report(path: Path) -> None:
    """See before anything runs that a report could be written there.

    Raises:
        RefusedOutput: the folder is missing or read-only, the path is a folder, or its name is not that of a page.
    """
    if path.suffix.lower() not in (".html", ".htm"):
        raise RefusedOutput(path, "a report is a page; name it .html")
    check_folder(path)


def report_page(recorder: Recorder) -> str:
    """The page as text."""
    shown = model(recorder)
    assert recorder.request is not None
    values = (files("graphface.report") / "values.js").read_text(encoding="utf-8")
    script = "\n".join([values, *(_part(f"{name}.js") for name in _SCRIPTS)])
    blobs = "\n".join(map(seven_bit, recorder.blobs.contents))
    policy = f"default-src 'none'; img-src blob:; style-src 'unsafe-inline'; script-src 'sha256-{_hash(script)}'"
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
<template id="svg">{_drawing(recorder, shown["nodes"])}</template>
<script type="application/json" id="{RUN}">{embedded(recorder.trace.as_json())}</script>
<script type="application/json" id="report">{embedded(shown)}</script>
<script type="text/plain" id="blobs">{blobs}</script>
<script type="module">{script}</script>
</body>
</html>
"""


def _drawing(recorder: Recorder, nodes: list[dict[str, Any]]) -> str:
    """The graph with the state of every node. Thumbnails are the numbers of blobs, which are stored once."""
    assert recorder.request is not None
    marks = {node["name"]: _mark(node) for node in nodes}
    thumbnails = {n["name"]: f"data:image/webp;#{n['sheets'][0]['image']}" for n in nodes if n["sheets"]}
    return draw_svg(recorder.request.graph, marks=marks, thumbnails=thumbnails)


def _mark(node: dict[str, Any]) -> Mark:
    state: MarkState = "failed" if node["state"] == "stopped" else node["state"]
    if node["state"] == "blocked":
        return Mark(state, label=node["reason"])
    label = {"memory": "from memory", "disk": "from disk", "skipped": "not run"}.get(node["state"], node["state"])
    if node["state"] == "ran":
        label = f"ran {node['seconds'] * 1e3:.3g} ms" if node["seconds"] < 1 else f"ran {node['seconds']:.3g} s"
    return Mark(state, node["reason"], 0.0, label)


def embedded(value: Any) -> str:
    """JSON that may stand inside an element: nothing in it opens or closes one."""
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _part(name: str) -> str:
    return (files("graphface.report.page") / name).read_text(encoding="utf-8")


def _hash(script: str) -> str:
    return b64encode(sha256(script.encode("utf-8")).digest()).decode("ascii")
