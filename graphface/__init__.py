"""graphface: a node-based dataflow engine; the face operators are its first plug-in.

    import graphface

    relight = graphface.load("relight")
    result = relight.run(photo="portrait.jpg")
    result["image"]

Names are imported when first used: `import graphface` and `graphface --help` pay for no array library. `node` alone is
imported at once, since the module of the same name would otherwise take its place in the package.
"""

import importlib
import os.path
from typing import TYPE_CHECKING, Any

from graphface.node import Cosmetic, Figure, Formerly, Needs, node

if TYPE_CHECKING:
    from graphface.assets.asset import Asset
    from graphface.cache.memory import MemoryTier
    from graphface.debug.breakpoint import Breakpoint
    from graphface.document.typed_yaml import read_yaml, validated
    from graphface.errors import (
        DeclarationError,
        DocumentError,
        GraphfaceError,
        InputError,
        NodeError,
        RunError,
        RunFailed,
        UnreadableFile,
        UnwritableFile,
        UsageError,
    )
    from graphface.evaluate.evaluator import Evaluator
    from graphface.evaluate.observe import Observer, StopRun
    from graphface.facade import Graph, Result, load
    from graphface.fallback import GraphfaceWarning, warn
    from graphface.packs import Pack
    from graphface.registry import Registry
    from graphface.values.files import Files
    from graphface.values.parts import register_parts
    from graphface.values.picture import Picture, View
    from graphface.values.port_types import ArrayType, Lazy

__version__ = "0.1.0"

# Installed, nodes/ and graphs/ lie in this package; in a checkout they stand beside it. Whoever starts Python in the
# root of a checkout gets the package from there, and should get those with it.
_checkout = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
if not os.path.isdir(os.path.join(__path__[0], "nodes")) and os.path.isdir(os.path.join(_checkout, "nodes")):
    __path__.append(_checkout)

_HOMES = {
    "ArrayType": "values.port_types",
    "Asset": "assets.asset",
    "Breakpoint": "debug.breakpoint",
    "DeclarationError": "errors",
    "DocumentError": "errors",
    "Evaluator": "evaluate.evaluator",
    "Files": "values.files",
    "Graph": "facade",
    "GraphfaceError": "errors",
    "GraphfaceWarning": "fallback",
    "InputError": "errors",
    "Lazy": "values.port_types",
    "MemoryTier": "cache.memory",
    "NodeError": "errors",
    "Observer": "evaluate.observe",
    "Pack": "packs",
    "Picture": "values.picture",
    "Registry": "registry",
    "Result": "facade",
    "RunError": "errors",
    "RunFailed": "errors",
    "StopRun": "evaluate.observe",
    "UnreadableFile": "errors",
    "UnwritableFile": "errors",
    "UsageError": "errors",
    "View": "values.picture",
    "load": "facade",
    "read_yaml": "document.typed_yaml",
    "register_parts": "values.parts",
    "validated": "document.typed_yaml",
    "warn": "fallback",
}

__all__ = [
    "ArrayType",
    "Asset",
    "Breakpoint",
    "Cosmetic",
    "DeclarationError",
    "DocumentError",
    "Evaluator",
    "Figure",
    "Files",
    "Formerly",
    "Graph",
    "GraphfaceError",
    "GraphfaceWarning",
    "InputError",
    "Lazy",
    "MemoryTier",
    "Needs",
    "NodeError",
    "Observer",
    "Pack",
    "Picture",
    "Registry",
    "Result",
    "RunError",
    "RunFailed",
    "StopRun",
    "UnreadableFile",
    "UnwritableFile",
    "UsageError",
    "View",
    "load",
    "node",
    "read_yaml",
    "register_parts",
    "validated",
    "warn",
]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        value = getattr(importlib.import_module(f"graphface.{_HOMES[name]}"), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module 'graphface' has no attribute {name!r}")
