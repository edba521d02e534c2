"""Ablation: swap parts of a graph, run what the swaps ask for, and say what each variant gives and what it costs.

    result = ablate("relight", ["intrinsic=intensity,retinex", "detail=additive,none"], [{"photo": "a.jpg"}])

`swaps` makes variants of a graph, `running` runs them on one cache and keeps the times, `sheet`, `table` and `page`
show the answer. Nothing here knows what the graph is about: pictures come from the types, figures from the `metrics.*`
operators of whatever packs are installed.
"""

from graphface.ablation.running import Ablation, Cell, ablate
from graphface.ablation.swaps import Swap, Variant, variants

__all__ = ["Ablation", "Cell", "Swap", "Variant", "ablate", "variants"]
