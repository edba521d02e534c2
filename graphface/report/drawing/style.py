"""The style sheet inside a drawing. Every rule is below `.graphface-drawing`: a page may hold the drawing and more."""

from __future__ import annotations

from collections.abc import Iterable

from graphface.report.drawing.figure import PORT_SIZE, TEXT_SIZE, TITLE_SIZE
from graphface.report.drawing.palette import COLORS, Theme, family_color, family_tint

_SHAPES = f"""
D text {{ font: {TEXT_SIZE}px system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; stroke: none; }}
D .name {{ font-size: {TITLE_SIZE}px; font-weight: 600; }}
D .frame .name {{ font-size: 12px; }}
D .port, D .reason, D .count {{ font-size: {PORT_SIZE}px; }}
D .output {{ font-weight: 600; }}
D .out {{ text-anchor: end; }}
D .wire {{ fill: none; stroke-width: 1.4; }}
D .wire.lazy {{ stroke-dasharray: 5 3; }}
D .dimmed .edge {{ stroke-dasharray: 4 3; }}
D .dimmed .name, D .dimmed .operator, D .dimmed .port, D .dimmed .band, D .dimmed .stripe, D .dimmed .dot,
D .dimmed .output {{ opacity: .45; }}
D .wire.dimmed {{ opacity: .35; }}
D .result .edge {{ stroke-width: 2; }}
D .failed .edge {{ stroke-width: 3; }}
D .node:focus {{ outline: none; }}
D .node:focus .edge, D .node:hover .edge {{ stroke-width: 2.5; }}
D .wire:hover {{ stroke-width: 3; }}
D .frame:not(.folded) .count {{ display: none; }}
"""


def style(hues: Iterable[int]) -> str:
    """The rules for the families of these hues, light and dark."""
    known = sorted(hues)
    dark = f"@media (prefers-color-scheme: dark) {{{_colors('dark', known)}}}"
    return (
        (_SHAPES + _colors("light", known) + dark)
        .replace("D .", ".graphface-drawing .")
        .replace("D text", ".graphface-drawing text")
    )


def _colors(theme: Theme, hues: Iterable[int]) -> str:
    c = COLORS[theme]
    stripes = (f"D .hue-{h} .stripe {{ fill: {family_color(h, theme)}; }}\n" for h in hues)
    bands = (f"D .hue-{h} .band {{ fill: {family_tint(h, theme)}; }}\n" for h in hues)
    families = "".join((*stripes, *bands))
    return f"""
D .paper {{ fill: {c.paper}; }}
D .box {{ fill: {c.box}; }}
D .edge {{ fill: none; stroke: {c.edge}; }}
D .node text, D .frame text {{ fill: {c.ink}; }}
D .node .operator, D .node .port, D .node .reason, D .frame .count {{ fill: {c.muted}; }}
D .frame rect {{ fill: {c.frame}; stroke: {c.frame_edge}; }}
D .folded rect {{ fill: {c.given}; }}
D .wire {{ stroke: {c.wire}; }}
D .dot {{ fill: {c.wire}; stroke: {c.box}; }}
D .dot.free {{ fill: {c.box}; stroke: {c.wire}; }}
D .input .box, D .input .band {{ fill: {c.given}; }}
D .input .stripe {{ fill: {c.muted}; }}
D .result .edge, D .node:focus .edge, D .node:hover .edge, D .wire:hover {{ stroke: {c.accent}; }}
D .node .output {{ fill: {c.accent}; }}
D .failed .edge {{ stroke: {c.failed}; }}
D .node.failed .reason {{ fill: {c.failed}; }}
D .cold {{ fill: {c.edge}; }}
{families}"""
