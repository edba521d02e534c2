"""Where the light of a path-traced head is found to come from, beside where it comes from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from graphface import Graph, load
from graphface.nodes.bench.heads import LIGHTS, Head, heads_of, true_direction
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.metrics import light_angle
from graphface.nodes.types import FloatArray

DIRECTED_LIGHTS = tuple(light for light in LIGHTS if light not in ("frontal", "ambient", "red_blue"))
"""Those that come from one side."""

_WITH_NORMALS = {
    "graphface": 1,
    "extends": "represent.yaml",
    "inputs": {"normals": "Normals"},
    "nodes": {"light": {"in": {"normals": "normals"}}},
}
"""represent.yaml with the normals that the light is fitted on as an input."""

_FOUND = "light.direction"


@dataclass(frozen=True)
class LightFigure:
    """Degrees between the direction of the light found and the true one, by the mesh's and by the true normals.

    CPU `milliseconds` of the fit on the mesh's normals.
    """

    order: int
    robust: str
    head: str
    light: str
    mesh_degrees: float
    true_degrees: float
    milliseconds: float


def light_truth(
    data: Path, orders: Sequence[int] = (1, 2, 3), robust: Sequence[str] = ("none", "huber", "trimmed")
) -> Iterator[LightFigure]:
    """`sh.fit` of represent.yaml, of every order and robustness, on every head under lights that come from one side.

    The true direction is that of the summed irradiance vectors of the area lights.

    Raises:
        UnreadableFile: there are no heads at `data`/truth.
    """
    heads = heads_of(data)
    graphs = {
        (order, how): [load(g, set={"light.order": order, "light.robust": how}) for g in ("represent", _WITH_NORMALS)]
        for order in orders
        for how in robust
    }
    for head in heads:
        for light in DIRECTED_LIGHTS:
            evaluator = MeteredEvaluator()
            for (order, how), (graph, exact) in graphs.items():
                found, spent = _fitted(graph, head, light, evaluator)
                best = exact.run([_FOUND], evaluator=evaluator, photo=head.path(light), normals=head.normals)[_FOUND]
                towards = true_direction(head.lights[light])
                yield LightFigure(
                    order=order,
                    robust=how,
                    head=head.name,
                    light=light,
                    mesh_degrees=light_angle(found, towards),
                    true_degrees=light_angle(best, towards),
                    milliseconds=spent,
                )


def _fitted(graph: Graph, head: Head, light: str, evaluator: MeteredEvaluator) -> tuple[FloatArray, float]:
    """The direction of the light, and the CPU milliseconds of its fit."""
    given = ("intrinsic", "fitted_surface", "light_mask")
    found = graph.run([*given, _FOUND], evaluator=evaluator, photo=head.path(light))[_FOUND]
    return found, evaluator.cpu_ms(evaluator.key(_FOUND), [evaluator.key(node) for node in given])
