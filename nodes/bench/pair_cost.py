"""What a transfer between two photos costs once each of them is represented."""

from __future__ import annotations

from graphface import Graph
from graphface.nodes.bench.metered import MeteredEvaluator


def joint_nodes(graph: Graph) -> frozenset[str]:
    """The nodes that need both the input `photo` and the input `reference`."""
    from networkx import descendants

    drawn = graph.networkx()
    return frozenset(descendants(drawn, "photo") & descendants(drawn, "reference"))


def transfer_ms(evaluator: MeteredEvaluator, graph: Graph, output: str = "image") -> float:
    """CPU milliseconds of the joint nodes behind an output of the last run."""
    joint = joint_nodes(graph)
    alone = [evaluator.key(graph, step.name) for step in graph.steps if step.name not in joint]
    return evaluator.cpu_ms(evaluator.key(graph, output), given=alone)
