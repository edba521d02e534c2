"""graphface: a node-based dataflow engine; the face operators are its first plug-in.

    import graphface

    relight = graphface.load("relight.yaml")
    result = relight.run(photo="portrait.jpg", outputs=["image"])
    result["image"]
"""

from typing import TYPE_CHECKING, Any

from graphface.errors import GraphfaceError, RunError, UnreadableFile, UnwritableFile, UsageError
from graphface.node import Cosmetic, Needs, node
from graphface.registry import Pack
from graphface.values import ArrayType, Lazy
from graphface.warn import GraphfaceWarning, warn

if TYPE_CHECKING:
    from graphface.graph import Graph, load

__version__ = "0.1.0"

__all__ = [
    "ArrayType",
    "Cosmetic",
    "Graph",
    "GraphfaceError",
    "GraphfaceWarning",
    "Lazy",
    "Needs",
    "Pack",
    "RunError",
    "UnreadableFile",
    "UnwritableFile",
    "UsageError",
    "load",
    "node",
    "warn",
]


def __getattr__(name: str) -> Any:
    """`Graph` and `load` bring YAML and the evaluator: imported when first asked for."""
    if name in ("Graph", "load"):
        from graphface import graph

        return getattr(graph, name)
    raise AttributeError(f"module 'graphface' has no attribute {name!r}")
