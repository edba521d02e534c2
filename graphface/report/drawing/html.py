"""A graph as one HTML page that works offline: the SVG to move about in, with frames that fold and a search."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib.resources import files

from graphface.graph.wired import WiredGraph
from graphface.report.drawing.figure import figure
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.states import as_json, states
from graphface.report.drawing.svg import escape, svg_of


def draw_html(graph: WiredGraph, *, marks: Mapping[str, Mark] = {}, thumbnails: Mapping[str, str] = {}) -> str:
    """The page, complete with its style and script."""
    drawn = figure(graph, marks, thumbnails)
    placed = list(states(drawn))
    frames = list(placed[0].frames)
    known = [as_json(drawn, layout, frames) for layout in placed]
    words = f"{len(graph.steps)} nodes, {len(graph.inputs)} inputs, outputs: {', '.join(graph.outputs)}"
    page = {
        "name": escape(graph.name or "graph"),
        "words": escape(words),
        "doc": escape(graph.composition.doc),
        "style": _part("page.css"),
        "script": _part("page.js"),
        "svg": svg_of(drawn, placed[0], graph.name),
        "states": json.dumps(known, separators=(",", ":")).replace("<", "\\u003c"),
    }
    return _PAGE.format_map(page)


def _part(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{name}</title>
<style>
{style}</style>
</head>
<body>
<header>
<h1>{name}</h1><p title="{doc}">{words}</p>
<label><input id="search" type="search" placeholder="Find a node or operator (/)" autocomplete="off"></label>
<output id="found"></output>
<nav>
<button id="fold">Fold all</button><button id="open">Open all</button>
<button id="out" title="Smaller (-)">−</button><button id="fit" title="All of it (0)">Fit</button>
<button id="in" title="Larger (+)">+</button>
</nav>
</header>
<main id="view">
{svg}
</main>
<script type="application/json" id="states">{states}</script>
<script>
{script}</script>
</body>
</html>
"""
