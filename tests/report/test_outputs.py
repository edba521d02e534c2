"""A result in a notebook: its outputs side by side."""

from toys import toy_registry

from graphface import load

TEXT = """\
graphface: 1
nodes: {grid: {use: toy.grid, with: {size: 8}}, mean: {use: toy.mean, in: {grid: grid}}}
outputs: {picture: grid, "average": mean}
"""


def test_outputs() -> None:
    """Each output has its picture and its name."""
    html = load(TEXT, registry=toy_registry()).run()._repr_html_()
    assert html.count("<img") == html.count("data:image/webp;base64,") == 2
    assert "<b>picture</b>" in html
    assert "<b>average</b>" in html
