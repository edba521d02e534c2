"""`extends`: a graph file laid over the one that it starts from."""

from __future__ import annotations

import copy
from pathlib import Path

from graphface.document.document import Document, NodeEntry
from graphface.document.graph_files import GraphFiles
from graphface.document.overlays import copied, lay_over
from graphface.document.references import MAX_NESTING
from graphface.errors import Problem


def with_bases(
    document: Document, files: GraphFiles, problems: list[Problem], chain: tuple[Path, ...] = ()
) -> Document:
    """A document laid over the one that it extends, and that over its own base.

    Args:
        problems: gets a base that cannot be found, or that leads back to itself.
        chain: the files on the way here.
    """
    if document.extends is None:
        return document
    base = files.load(document.extends.value, document, document.extends.place)
    if base is None:
        return document
    assert base.path is not None
    if base.path in chain or len(chain) >= MAX_NESTING:
        problems.append(Problem(f"{document.extends.value!r} extends itself", document.extends.place))
        return document
    base = with_bases(base, files, problems, (*chain, base.path))
    merged = copy.copy(document)
    merged.doc = document.doc or base.doc
    merged.inputs = base.inputs | document.inputs
    merged.outputs = base.outputs | document.outputs
    merged.nodes = _laid_over(base.nodes, document.nodes)
    merged.variants = base.variants | document.variants
    merged.profiles = base.profiles | document.profiles
    return merged


def _laid_over(base: dict[str, NodeEntry], own: dict[str, NodeEntry]) -> dict[str, NodeEntry]:
    merged = {name: copied(entry) for name, entry in base.items()}
    for name, entry in own.items():
        if name not in merged:
            merged[name] = entry
            continue
        lay_over(merged[name], entry)
        if entry.use is not None:
            merged[name].place = entry.place
    return merged
