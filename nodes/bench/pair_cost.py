"""What a transfer between two photos costs once each of them is represented."""

from __future__ import annotations

from graphface import Graph
from graphface.nodes.bench.metered import MeteredEvaluator


def transfer_ms(evaluator: MeteredEvaluator, graph: Graph) -> float:
    """CPU milliseconds of the last run's `image`: of the nodes that need both `photo` and `reference`."""
    from networkx import descendants

    drawn = graph.networkx()
    joint = descendants(drawn, "photo") & descendants(drawn, "reference")
    alone = [evaluator.key(step.name) for step in graph.steps if step.name not in joint]
    return evaluator.cpu_ms(evaluator.key("image"), given=alone)
