"""A graph as an HTML table, for a notebook: inputs, every node with its operator and what is plugged into it."""

from __future__ import annotations

from html import escape

from graphface.graph.wired import WiredGraph


def graph_table(graph: WiredGraph) -> str:
    """The rows of inputs and nodes under a caption that names the outputs."""
    rows = [
        f"<tr><td><b>{escape(i.name)}</b></td><td>input: {escape(str(i.type))}</td><td></td></tr>"
        for i in graph.inputs.values()
    ]
    for step in graph.steps:
        wires = [
            f"{a.port} = {', '.join('.'.join((graph.names[r.slot], *r.fields)) for r in a.refs)}"
            for a in step.arguments
        ]
        cells = (f"<b>{escape(step.name)}</b>", escape(step.operator.name), escape("; ".join(wires)))
        rows.append(f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>")
    title = f"{escape(graph.name)}: {escape(', '.join(graph.outputs))}"
    return f"<table><caption>{title}</caption>{''.join(rows)}</table>"
