"""The relief of the built-in model, learned from path-traced heads whose normals are known.

`graphface models relief learned.safetensors --data DATA` made the built-in model of the one that `graphface models
learn` had written. Six heads are few, so what counts is the accuracy on heads outside the training set, and on other
faces.
"""

from __future__ import annotations

from pathlib import Path
from statistics import fmean

from graphface import Evaluator, MemoryTier, Result
from graphface.nodes.bench.geometry_graphs import model_graph
from graphface.nodes.bench.heads import Head, heads_of
from graphface.nodes.learning.surface_relief import Difference, learned_relief, normal_difference, with_relief
from graphface.nodes.metrics import normal_angle
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.storage import refined

_LEVELS = 1


def relief_of_heads(coarse: MorphableModel, data: Path) -> tuple[MorphableModel, dict[str, float]]:
    """The model with the relief of the heads of `data`/truth.

    Returns:
        The coarse model, and the mean angle between its normals and the true ones, degrees: "before", "after", and
        "unseen" for each head by the relief of the others.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    heads = [_Fitted(head) for head in heads_of(data)]
    plain = refined(coarse, _LEVELS)
    faces = [head.difference(plain) for head in heads]
    better = _with_relief_of(coarse, faces)
    off = {
        "before": fmean(head.degrees_off(plain) for head in heads),
        "after": fmean(head.degrees_off(refined(better, _LEVELS)) for head in heads),
    }
    if len(heads) > 1:
        others = [_with_relief_of(coarse, faces[:k] + faces[k + 1 :]) for k in range(len(heads))]
        unseen = [head.degrees_off(refined(m, _LEVELS)) for head, m in zip(heads, others, strict=True)]
        off["unseen"] = fmean(unseen)
    return better, off


def _with_relief_of(coarse: MorphableModel, faces: list[Difference]) -> MorphableModel:
    return with_relief(coarse, learned_relief(coarse, _LEVELS, faces))


class _Fitted:
    """One head, and models fitted to its frontal photo by the shipped graph."""

    def __init__(self, head: Head) -> None:
        self._head = head
        self._graph = model_graph()
        self._evaluator = Evaluator(memory=MemoryTier())

    def difference(self, model: MorphableModel) -> Difference:
        found = self._fit(model)
        return normal_difference(found["mesh"], found["surface"], self._head.normals, self._head.face)

    def degrees_off(self, model: MorphableModel) -> float:
        return normal_angle(self._fit(model)["surface"].normals, self._head.normals, self._head.face)

    def _fit(self, model: MorphableModel) -> Result:
        asked = ["mesh", "surface"]
        return self._graph.run(asked, evaluator=self._evaluator, photo=self._head.path(), model=model)
