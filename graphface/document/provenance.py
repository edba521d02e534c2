"""Results that carry the graph they came from: the effective document, kept inside the file.

Which files can hold words is known to who reads and writes them (`graphface.values.files.Files`), not to the engine.
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
    for text_in in {files.text: None for files in registry.all_files() if files.text is not None}:
        try:
            text = text_in(path).get(KEY)
        except UnreadableFile as error:
            why = f" ({error.reason})"
            continue
        if text:
            return text
    raise UnreadableFile(path, f"is neither a graph file (.yaml, .yml) nor a result that carries its graph{why}")
