"""Overlays: partial nodes addressed by a path, laid over the nodes that files declare.

Variants, profiles, `with` of a node that uses a graph file, `--replace` and `--set` all become the same thing, so one
order, `Rank`, decides between them; `graphface.document.compose` carries each to the file that declares its node.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import TypeVar

from graphface.document.document import Document, NodeEntry

T = TypeVar("T")


class Rank(IntEnum):
    """Who wins, weakest first."""

    WITH = 0
    VARIANT = 1
    PROFILE = 2
    REPLACE = 3
    SET = 4


@dataclass(frozen=True)
class Overlay:
    """A partial node, and the path that leads to the node it is for from the file where the overlay stands now."""

    rank: Rank
    path: tuple[str, ...]
    entry: NodeEntry


def chosen_overlays(document: Document, variants: Sequence[str], profiles: Sequence[str]) -> list[Overlay]:
    """The variants and profiles asked for that this file declares, each kind in the order asked for."""
    overlays = []
    for rank, declared, chosen in (
        (Rank.VARIANT, document.variants, variants),
        (Rank.PROFILE, document.profiles, profiles),
    ):
        for name in chosen:
            for path, entry in declared.get(name, {}).items():
                steps = tuple(path.split("/"))
                overlays.append(Overlay(rank, steps, own_part(entry)))
                overlays += inner_parts(rank, steps, entry)
    return overlays


def own_part(entry: NodeEntry) -> NodeEntry:
    """An entry without its settings of nodes further inside ("inner/node.parameter")."""
    own = copy.copy(entry)
    own.settings = {key: setting for key, setting in entry.settings.items() if "." not in key}
    return own


def inner_parts(rank: Rank, path: tuple[str, ...], entry: NodeEntry) -> list[Overlay]:
    """The settings that `own_part` leaves out, as overlays of the nodes that they are for."""
    overlays = []
    for key, setting in entry.settings.items():
        inner, dot, parameter = key.rpartition(".")
        if dot:
            body = NodeEntry(inner, setting.place or entry.place, settings={parameter: setting})
            overlays.append(Overlay(rank, (*path, *inner.split("/")), body))
    return overlays


def copied(entry: NodeEntry) -> NodeEntry:
    """A copy to lay others over: the document stays as its file says."""
    node = copy.copy(entry)
    node.wires, node.settings = dict(entry.wires), dict(entry.settings)
    node.carried = set(entry.carried)
    return node


def lay_over(node: NodeEntry, overlay: NodeEntry) -> None:
    """Lay a partial node over a node; one removed before comes back only where the overlay says what it is.

    What the overlay states comes last among the node's wires and settings: of an old and a new name of the same port or
    parameter the last one applies (`graphface.document.present_names`).
    """
    if overlay.removed:
        node.removed = True
        return
    if overlay.use is not None:
        node.removed = False
        if node.use is not None and overlay.use.value != node.use.value:
            node.carried |= {*node.wires, *node.settings}
        node.use = overlay.use
    node.wires = _last(node.wires, overlay.wires)
    node.settings = _last(node.settings, overlay.settings)
    node.carried -= {*overlay.wires, *overlay.settings}


def _last(below: dict[str, T], above: dict[str, T]) -> dict[str, T]:
    """Both, those of `above` winning and standing at the end."""
    return {name: value for name, value in below.items() if name not in above} | above
