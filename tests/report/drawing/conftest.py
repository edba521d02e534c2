"""A small nested graph, and one whose texts try to be markup."""

import json

import pytest

from graphface import Graph, Registry, load
from graphface.report.drawing.marks import Mark

TEXT = """graphface: 1
name: sums
inputs: {x: float, y: {type: float, default: 2}, z: float | None}
nodes:
  g: {use: toy.grid}
  p: {use: toy.pair, in: {grid: g}}
  f/m: {use: toy.mean, in: {grid: p.low}}
  f/deep/a: {use: toy.add, in: {a: x, b: f/m}}
  gate: {use: toy.gate, in: {a: y, extra: f/deep/a}}
outputs: {total: gate, pair: p.high}
"""
HOSTILE = (
    '<script>alert(1)</script>"\'`]]>--><!-- &amp; {{ }} ]; end\nsubgraph \\" | } #quot; \x00 \ud800 </svg></style>'
)


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


@pytest.fixture
def hostile(registry: Registry) -> Graph:
    """A graph whose name and words are `HOSTILE`, as far as YAML can hold them."""
    words = HOSTILE.replace("\x00", "").replace("\ud800", "")
    return load(TEXT.replace("name: sums", f"name: {json.dumps(words)}\ndoc: {json.dumps(words)}"), registry=registry)


@pytest.fixture
def hostile_marks() -> dict[str, Mark]:
    return {"g": Mark("failed", HOSTILE, 0.5, HOSTILE), "gate": Mark("skipped", HOSTILE), "x": Mark("", HOSTILE)}
