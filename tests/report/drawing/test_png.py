"""A graph as pixels."""

from base64 import b64encode
from io import BytesIO

import numpy as np
from PIL import Image

from graphface import Graph
from graphface.report.drawing.figure import figure
from graphface.report.drawing.layout import layout
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.png import draw_png


def test_size(graph: Graph) -> None:
    """Two pixels for each of the layout's, and something on them."""
    drawn = figure(graph)
    placed = layout(drawn.boxes, drawn.wires)
    picture = Image.open(BytesIO(draw_png(graph)))
    assert picture.size == (2 * placed.width, 2 * placed.height)
    assert len(np.unique(np.asarray(picture).reshape(-1, 3), axis=0)) > 20


def test_marks_and_thumbnails(graph: Graph) -> None:
    """A thumbnail is in the picture."""
    red = BytesIO()
    Image.new("RGB", (40, 30), (255, 0, 0)).save(red, "PNG")
    uri = f"data:image/png;base64,{b64encode(red.getvalue()).decode()}"
    marks = {"g": Mark("ran", heat=0.5, label="12 ms"), "p": Mark("skipped", "why"), "gate": Mark("failed", "it broke")}
    pixels = np.asarray(Image.open(BytesIO(draw_png(graph, marks=marks, thumbnails={"g": uri}))))
    assert (pixels == (255, 0, 0)).all(axis=2).sum() > 1000


def test_hostile(hostile: Graph, hostile_marks: dict[str, Mark]) -> None:
    """Any text can be drawn."""
    assert draw_png(hostile, marks=hostile_marks).startswith(b"\x89PNG")
