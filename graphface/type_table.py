"""What packs, plug-in files and notebooks say about types, one thing a type: its files, its picture."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Generic, TypeVar

from graphface.packs import Pack
from graphface.values.port_types import ArrayType, Atom, lineage, port_type

T = TypeVar("T")


class TypeTable(Generic[T]):
    """Finds what is said about a type, importing no more than its own pack's module.

    Args:
        packs: installed packs.
        named: from a pack to its table, from names in `Pack.types` to "module:attribute": the thing itself, or a table
            from types to such things.
        attribute: what "module:attribute" names, None where there is no such thing.
    """

    def __init__(
        self, packs: Sequence[Pack], named: Callable[[Pack], Mapping[str, str]], attribute: Callable[[str], Any]
    ) -> None:
        self._packs = packs
        self._named = named
        self._attribute = attribute
        self._added: dict[Atom, T] = {}
        self._found: dict[Atom, tuple[Atom, T] | None] = {}

    def add(self, kind: Any, thing: T) -> None:
        """Say something about a class or an array type; it counts before what packs say."""
        self._added |= dict.fromkeys(port_type(kind).alternatives, thing)
        self._found.clear()

    def add_all(self, other: TypeTable[T]) -> None:
        """Take over what was added to another table."""
        self._added |= other._added
        self._found.clear()

    def nearest(self, kind: Atom) -> tuple[Atom, T] | None:
        """What is said about a type, or about its nearest base class or parent, with the type that it was said of."""
        if kind not in self._found:
            own = ((base, self._own(base)) for base in lineage(kind))
            self._found[kind] = next(((base, thing) for base, thing in own if thing is not None), None)
        return self._found[kind]

    def all(self) -> Iterator[T]:
        """Everything that is said about any type."""
        yield from self._added.values()
        for pack in self._packs:
            for name in self._named(pack):
                thing = self._of_pack(pack, name)
                if thing is not None:
                    yield thing

    def _own(self, atom: Atom) -> T | None:
        """What is said about just this type. Only a type of the same name is imported to see whether it is this one."""
        if atom in self._added:
            return self._added[atom]
        own_name = atom.name if isinstance(atom, ArrayType) else getattr(atom, "__name__", "")
        for pack in self._packs:
            for name in self._named(pack):
                where = pack.types.get(name, "")
                kind = self._attribute(where) if own_name in (name, where.partition(":")[2]) else None
                if kind is not None and atom in port_type(kind).alternatives:
                    return self._of_pack(pack, name)
        return None

    def _of_pack(self, pack: Pack, name: str) -> T | None:
        """What a pack says about one of its types, alone or in a table of several types."""
        found = self._attribute(self._named(pack)[name])
        return found.get(self._attribute(pack.types[name])) if isinstance(found, Mapping) else found
