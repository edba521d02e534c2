"""A graph from whatever somebody has at hand: a file, a shipped graph's name, a text, a mapping, a result."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from graphface.document.document import Document, parse_document, read_document
from graphface.document.effective import escaped
from graphface.document.graph_files import GRAPH_SUFFIXES, find_graph
from graphface.document.provenance import read_provenance
from graphface.errors import DocumentError, UsageError
from graphface.place import Source
from graphface.registry import Registry


def read_source(source: str | Path | Mapping[str, Any], shipped: Sequence[Path], registry: Registry) -> Document:
    """The document that a source holds; a text with a line break is YAML itself, any other names a file.

    Raises:
        DocumentError: it is not of the form of a graph file. UnreadableFile: there is no such file.
        UsageError: a mapping holds what YAML cannot say.
    """
    document, problems = _parsed(source, shipped, registry)
    if problems:
        raise DocumentError(problems)
    return document


def _parsed(
    source: str | Path | Mapping[str, Any], shipped: Sequence[Path], registry: Registry
) -> tuple[Document, list[Any]]:
    if isinstance(source, Mapping):
        return parse_document(Source("<mapping>", _as_text(source)))
    if isinstance(source, str) and "\n" in source:
        return parse_document(Source("<text>", source))
    path = find_graph(str(source), shipped)
    if path.suffix.lower() in GRAPH_SUFFIXES:
        return read_document(path)
    return parse_document(Source(f"{path} (its provenance)", read_provenance(path, registry)))


def _as_text(graph: Mapping[str, Any]) -> str:
    """A mapping as JSON, which is YAML too, and in which a text never looks like a number."""
    try:
        lines = json.dumps(dict(graph), indent=1, ensure_ascii=False).split("\n")
        return "\n".join(escaped(line) for line in lines)
    except (TypeError, ValueError, RecursionError) as error:
        raise UsageError(f"a graph given as a mapping holds plain values only: {error}") from None
