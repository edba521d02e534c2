"""A node that differs, in words and as a row of a table."""

from __future__ import annotations

import math
from collections.abc import Sequence

from graphface.report.difference.node import NodeDifference
from graphface.report.difference.values import PartDifference

HEADER = ("node", "part", ">greatest", ">of range", ">mean", ">PSNR dB", ">differing", "cause")


def short(value: float) -> str:
    """Three digits, as people say a number."""
    if value != 0 and not 1e-4 <= abs(value) < 1e6:
        return f"{value:.2e}"
    return f"{float(f'{value:.3g}'):.10g}"


def percent(share: float) -> str:
    """A share between 0 and 1; what is not all is never called 100 %, and what is not nothing never 0 %."""
    if 0 < share < 0.0001:
        return "<0.01%"
    if share < 0.01:
        return f"{share:.2%}"
    return f"{math.floor(share * 100) if share < 1 else 100}%"


def measured(part: PartDifference) -> str:
    """How far a part is apart, and where."""
    if part.words:
        return part.words
    phrases = []
    if part.non_finite:
        phrases.append(f"{part.non_finite} values are not finite on one side only")
    if part.greatest > 0:
        noise = f", PSNR {part.psnr:.1f} dB" if part.psnr is not None else ""
        phrases.append(
            f"by up to {short(part.greatest)} of a range of {short(part.span)} (mean {short(part.mean)}{noise})"
        )
    if part.box is not None:
        left, top, width, height = part.box
        everywhere = (height, width) == part.shape[:2]
        where = "" if everywhere else f", within x {left}..{left + width - 1}, y {top}..{top + height - 1}"
        phrases.append(f"{percent(part.share)} of pixels{where}")
    elif len(part.position) > 0:
        phrases.append(f"{percent(part.share)} of values")
    return "; ".join(phrases)


def place(part: PartDifference) -> str:
    """Where the greatest difference is."""
    if part.box is not None:
        row, column, *channel = part.position
        return f"x {column}, y {row}" + (f", channel {channel[0]}" if channel else "")
    return f"[{', '.join(str(i) for i in part.position)}]" if part.position else ""


def cause(node: NodeDifference) -> str:
    """What was changed at the node itself; else what it inherits."""
    if node.words:
        return node.words
    if node.caused:
        return "; ".join(str(reason) for reason in node.caused)
    above = [reason.node for reason in node.reasons]
    return f"inherited from {', '.join(dict.fromkeys(above))}" if above else ""


def title(node: NodeDifference) -> str:
    """A node with its operator, or with both."""
    there, here = node.operators
    both = " -> ".join(dict.fromkeys(o for o in (there, here) if o))
    return f"{node.name} ({both})" if both else node.name


def in_full(node: NodeDifference) -> list[str]:
    """A node in lines: what was changed there, by how much it differs and where."""
    lines = [title(node)]
    if cause(node):
        lines.append(f"    {cause(node)}")
    for part in node.parts[:4]:
        where = f"; greatest at {place(part)}" if place(part) else ""
        lines.append(f"    {part.path + ': ' if part.path else ''}{measured(part)}{where}")
    if len(node.parts) > 4:
        lines.append(f"    and {len(node.parts) - 4} more parts")
    return lines


def row(node: NodeDifference) -> Sequence[str]:
    """A line of a table under `HEADER`: the part of the node that differs most."""
    if not node.parts:
        kinds = {"failed": "failed", "only here": "new", "only there": "gone"}
        return (node.name, kinds.get(node.kind, ""), "", "", "", "", "", cause(node))
    part = node.parts[0]
    if part.words:
        return (node.name, f"{part.path}: {part.words}".removeprefix(": "), "", "", "", "", "", cause(node))
    noise = f"{part.psnr:.1f}" if part.psnr is not None else ""
    odd = f" + {part.non_finite} NaN" if part.non_finite else ""
    figures = (short(part.greatest) + odd, percent(part.greatest / part.span), short(part.mean), noise)
    return (node.name, part.path, *figures, percent(part.share), cause(node))
