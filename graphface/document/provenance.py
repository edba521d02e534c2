"""Results that carry the graph they came from: the effective document, kept inside the file.

Which files can hold words is known to the value types (`to_file(..., text=)` and `text_in_file`), not to the engine.
"""

from __future__ import annotations

from pathlib import Path

from graphface.errors import UnreadableFile
from graphface.registry import Registry

KEY = "graphface"


def read_provenance(path: Path, registry: Registry) -> str:
    """The effective document inside a result, as YAML.

    Raises:
        UnreadableFile: the file holds none, or cannot be read.
    """
    why = ""
    for kind in registry.type_classes():
        reader = getattr(kind, "text_in_file", None)
        if reader is None:
            continue
        try:
            text = reader(path).get(KEY)
        except UnreadableFile as error:
            why = f" ({error.reason})"
            continue
        if text:
            return str(text)
    raise UnreadableFile(path, f"is neither a graph file (.yaml, .yml) nor a result that carries its graph{why}")
