"""The outputs of a run side by side, for a notebook."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from html import escape
from io import BytesIO
from typing import Any

from graphface.graph.request import Request
from graphface.pictures import draw
from graphface.report.above import above
from graphface.values.picture import View

SIZE = 320
"""Pixels of a picture's longer side."""


def outputs_html(outputs: Mapping[str, Any], request: Request) -> str:
    """A figure for each output: its picture, its name and what the colors mean."""
    return f'<div style="display:flex;flex-wrap:wrap;gap:12px">{"".join(_figures(outputs, request))}</div>'


def _figures(outputs: Mapping[str, Any], request: Request) -> list[str]:
    from PIL import Image

    shown = []
    for name, value in outputs.items():
        ref = request.targets[name]
        view = View(SIZE, above(request, ref.slot, lambda slot: _given(request, slot)))
        picture = draw(value, request.graph.type_of(ref), request.graph.registry, view)
        stream = BytesIO()
        Image.fromarray(picture.pixels).save(stream, "WEBP", quality=90)
        source = f"data:image/webp;base64,{base64.b64encode(stream.getvalue()).decode('ascii')}"
        note = f"<br><small>{escape(picture.note)}</small>" if picture.note else ""
        shown.append(
            f'<figure style="margin:0;max-width:{SIZE}px"><img alt="" src="{source}">'
            f"<figcaption><b>{escape(name)}</b>{note}</figcaption></figure>"
        )
    return shown


def _given(request: Request, slot: int) -> Any:
    """The value of a graph input that the run has loaded: what most outputs are drawn on."""
    bound = request.bound[slot] if slot < len(request.bound) else None
    return bound.value if bound is not None else None
