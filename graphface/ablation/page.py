"""The HTML page: one file, one picture at a time, flipped between variants by key or by pointing at a name."""

from __future__ import annotations

import base64
import io
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from graphface.ablation.drawing import Picture, picture_of
from graphface.ablation.table import columns, rows, shown
from graphface.values.writing import beside

if TYPE_CHECKING:
    from graphface.ablation.running import Ablation

LARGEST = 1200
"""Pixels of the longer side of a picture in the page."""

_STYLE = """body{background:#181818;color:#ddd;font:14px system-ui,sans-serif;margin:1.5em;max-width:1400px}
table{border-collapse:collapse}td,th{padding:.25em .8em;text-align:right}td:first-child,th:first-child{text-align:left}
tr[data-v]{cursor:pointer}tr.on{background:#345}.stage{position:relative;margin:1em 0}.stage img{max-width:100%;
max-height:80vh;display:none}.stage img.on{display:block}h2{font-weight:500;margin:1.5em 0 .3em}
kbd{border:1px solid #666;border-radius:3px;padding:0 .3em}"""

_SCRIPT = """let now=0;const lines=[...document.querySelectorAll('tr[data-v]')];
function show(v){now=(v+lines.length)%lines.length;lines.forEach((l,i)=>l.classList.toggle('on',i===now));
document.querySelectorAll('.stage img').forEach(i=>i.classList.toggle('on',+i.dataset.v===now))}
lines.forEach((l,i)=>l.addEventListener('mouseenter',()=>show(i)));
document.addEventListener('keydown',e=>{if(e.key==='ArrowRight'||e.key===' '){show(now+1);e.preventDefault()}
if(e.key==='ArrowLeft')show(now-1);if(e.key>='1'&&e.key<='9'&&+e.key<=lines.length)show(+e.key-1)});show(0);"""


def write_page(ablation: Ablation, path: Path) -> None:
    """Write the page; pictures are inside it, so that it can be mailed.

    Raises:
        UnwritableFile: the folder cannot be written to.
    """
    with beside(path) as temporary:
        temporary.write_text(_html(ablation), encoding="utf-8")


def _html(ablation: Ablation) -> str:
    names = columns(ablation)
    head = "".join(f"<th>{escape(name)}</th>" for name in names)
    table = rows(ablation)
    truth = any(t is not None for t in ablation.truths)
    lines = [
        f'<tr data-v="{index}">{"".join(f"<td>{escape(shown(row.get(n, chr(32))))}</td>" for n in names)}</tr>'
        for index, row in enumerate(table)
    ]
    if truth:
        lines.append(f'<tr data-v="{len(table)}"><td>truth</td></tr>')
    stages = "".join(_stage(ablation, case) for case in range(len(ablation.cases)))
    title = escape(f"{ablation.graph.name}: {ablation.output}")
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title><style>{_STYLE}</style>'
        f"<h1>{title}</h1><p><kbd>←</kbd> <kbd>→</kbd> or <kbd>1</kbd>..<kbd>9</kbd> flip between variants; so does "
        f"pointing at a line. {escape(ablation.sharing)}.</p><table><tr>{head}</tr>{''.join(lines)}</table>{stages}"
        f"<script>{_SCRIPT}</script></html>\n"
    )


def _stage(ablation: Ablation, case: int) -> str:
    declared = ablation.graph.type_of(ablation.graph.targets([ablation.output])[ablation.output])
    values = [cell.value for cell in ablation.of_case(case)] + [ablation.truths[case]]
    images = []
    for index, value in enumerate(values):
        picture = None if value is None else picture_of(value, declared, ablation.graph.registry)
        if picture is not None:
            images.append(f'<img data-v="{index}" alt="" src="{_data(picture)}">')
    given = ", ".join(f"{name} = {Path(str(value)).name}" for name, value in ablation.cases[case].items())
    return f'<h2>{escape(given)}</h2><div class="stage">{"".join(images)}</div>'


def _data(picture: Picture) -> str:
    from PIL import Image as pillow

    image = pillow.fromarray(picture)
    image.thumbnail((LARGEST, LARGEST))
    held = io.BytesIO()
    image.save(held, "WEBP", quality=92)
    return "data:image/webp;base64," + base64.b64encode(held.getvalue()).decode("ascii")
