"""Intrinsic methods on path-traced heads, whose albedo and lights are known.

Methods work on sRGB-encoded pictures, as in the shipped graphs; their maps are decoded before they are compared, since
for a power law the encoded albedo is the encoding of the albedo.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from graphface import Graph, load
from graphface.nodes.bench.heads import LIGHTS, Head, heads_of
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.color import decode_srgb
from graphface.nodes.metrics import lmse, si_mse

WHITE_LIGHTS = tuple(light for light in LIGHTS if light != "red_blue")
"""Under colored light the shading is not one number a pixel."""

_LEAST = 1e-3
"""Albedo below which a pixel says nothing of the shading."""

_NODE = "intrinsic"


@dataclass(frozen=True)
class IntrinsicFigure:
    """Errors over the face label (see `graphface.nodes.metrics`), and the method's CPU time on a 512 x 512 photo."""

    method: str
    head: str
    light: str
    albedo_si_mse: float
    albedo_lmse: float
    shading_si_mse: float
    shading_lmse: float
    milliseconds: float


def intrinsic_truth(
    data: Path, methods: Sequence[str], lights: Sequence[str] = WHITE_LIGHTS
) -> Iterator[IntrinsicFigure]:
    """represent.yaml with every method ("intrinsic.retinex") on every head and light.

    Raises:
        UnreadableFile: there are no heads at `data`/truth.
    """
    heads = heads_of(data)
    graphs = {method: load("represent", replace={_NODE: method}) for method in methods}
    for head in heads:
        for light in lights:
            yield from _compared(head, light, graphs)


def _compared(head: Head, light: str, graphs: Mapping[str, Graph]) -> Iterator[IntrinsicFigure]:
    evaluator = MeteredEvaluator()
    reflected = head.albedo.mean(axis=2)
    shading = decode_srgb(head.photo(light).pixels).mean(axis=2) / np.maximum(reflected, _LEAST)
    mask = head.face * (reflected > _LEAST)
    for method, graph in graphs.items():
        parts = graph.run(["unclipped", _NODE], evaluator=evaluator, photo=head.path(light))[_NODE]
        albedo, found = decode_srgb(parts.albedo), decode_srgb(parts.shading)
        yield IntrinsicFigure(
            method=method,
            head=head.name,
            light=light,
            albedo_si_mse=si_mse(albedo, head.albedo, mask),
            albedo_lmse=lmse(albedo, head.albedo, mask),
            shading_si_mse=si_mse(found, shading, mask),
            shading_lmse=lmse(found, shading, mask),
            milliseconds=evaluator.cpu_ms(evaluator.key(_NODE), [evaluator.key("unclipped")]),
        )
