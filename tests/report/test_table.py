"""A graph as an HTML table, for a notebook."""

from graphface import Registry, load

TEXT = """graphface: 1
name: a<b
inputs: {x: float}
nodes: {n: {use: toy.add, in: {a: x}}, t: {use: toy.total, in: {values: [n, x]}}}
outputs: {y: t}
"""


def test_rows(registry: Registry) -> None:
    """A row for each input and node, with what is plugged in; names are escaped."""
    shown = load(TEXT, registry=registry)._repr_html_()
    assert shown.count("<tr>") == 3
    assert "<caption>a&lt;b: y</caption>" in shown
    assert "values = n, x" in shown
