"""All that look inside values see the same parts, and a class of somebody's own adds its rule beside itself."""

import copy
import json
from collections import OrderedDict
from dataclasses import dataclass, field
from enum import Enum, StrEnum
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray
from pydantic import BaseModel

from graphface import Evaluator, Pack, Registry, load, node, register_parts
from graphface.cache.disk import DiskTier
from graphface.testing import check_node
from graphface.values.codec import CodecError, decode, encode
from graphface.values.digest import digest_value
from graphface.values.frozen import arrays_in, describe, first_non_finite, freeze, with_arrays
from graphface.values.parts import DATACLASS, KEYED, MODEL, NAMED_TUPLE, NUMBERED, rule_of
from graphface.values.port_types import ANY
from graphface.values.writing import write_output

Floats = NDArray[np.float64]


class Kind(Enum):
    KEY = 1


class Pair(NamedTuple):
    one: Floats
    kind: Kind | None = None


class Model(BaseModel, arbitrary_types_allowed=True, extra="allow"):
    held: Floats
    path: Path | None = None


class Spline:
    """A class that is no dataclass, as a third party's may be: what it is made of stands below."""

    def __init__(self, knots: Floats, pair: Pair | None = None) -> None:
        self.knots, self.pair, self.cached = knots, pair, object()


@register_parts(Spline)
def spline_parts(spline: Spline) -> dict[str, Any]:
    return {"knots": spline.knots, "pair": spline.pair}


class Ring:
    """One that its constructor cannot build again."""

    def __init__(self) -> None:
        self.links: list[Spline] = []

    @staticmethod
    def of(links: list[Spline]) -> "Ring":
        made = Ring()
        made.links = links
        return made


@register_parts(Ring, build=Ring.of)
def ring_parts(ring: Ring) -> dict[str, Any]:
    return {"links": ring.links}


@dataclass(frozen=True)
class Tree:
    """Something of every kind, to any depth."""

    leaf: Floats | Pair | Model | Spline | Ring | Kind | Path | int | float | str | None
    branches: "list[Tree]" = field(default_factory=list)
    named: "dict[str, Tree]" = field(default_factory=dict)
    both: "tuple[Tree, ...]" = ()


arrays = hnp.arrays(np.float64, hnp.array_shapes(min_dims=0, min_side=0, max_side=3))
plain = st.none() | st.integers() | st.floats() | st.text() | st.sampled_from([Kind.KEY, Path("a/b")])
pairs = st.builds(Pair, arrays, st.sampled_from([None, Kind.KEY]))
models = st.builds(Model, held=arrays, more=st.lists(arrays, max_size=2))
splines = st.builds(Spline, arrays, pairs)
leaves = plain | arrays | pairs | models | splines | st.builds(Ring.of, st.lists(splines, max_size=2))
trees = st.recursive(
    st.builds(Tree, leaves),
    lambda inner: st.builds(
        Tree,
        leaves,
        st.lists(inner, max_size=2),
        st.dictionaries(st.text(max_size=2), inner, max_size=2),
        st.tuples(inner, inner),
    ),
    max_leaves=6,
)


def ids(value: Any) -> list[int]:
    return [id(array) for _, array in arrays_in(value)]


class TestAgreement:
    @given(trees)
    def test_arrays(self, tree: Tree) -> None:
        """The arrays that are found are those frozen, those stored, those checked and those replaced."""
        found = ids(tree)
        checked: dict[int, Any] = {}
        seen: list[int] = []

        def keep(array: np.ndarray) -> np.ndarray:
            seen.append(id(array))
            return array

        assert with_arrays(tree, keep) is tree
        assert seen == found
        assert len(encode(tree)[0]) == len(set(found))
        bad = first_non_finite(tree, checked)
        assert bad is not None or set(checked) == {id(a) for _, a in arrays_in(tree) if a.size}
        assert {id(buffer) for buffer in freeze(tree)} == set(found)
        assert not any(array.flags.writeable for _, array in arrays_in(tree))

    @given(trees)
    def test_stored(self, tree: Tree) -> None:
        """What is stored comes back: the same digest, the same description, read-only."""
        tensors, structure = encode([tree])
        back = decode(tensors, json.loads(json.dumps(structure)), list[Tree])
        assert digest_value(back) == digest_value([tree])
        assert describe(back) == describe([tree])
        assert not any(array.flags.writeable for _, array in arrays_in(back))

    @given(trees)
    def test_copies(self, tree: Tree) -> None:
        """A copy has the same digest and shares no array."""
        copied = with_arrays(tree, np.copy)
        assert digest_value(copied) == digest_value(copy.deepcopy(tree)) == digest_value(tree)
        assert set(ids(copied)).isdisjoint(ids(tree))


class Lamp(Spline):
    """A class below one with a rule."""


@dataclass
class Longer(Spline):
    """A dataclass below one with a rule: it has parts of its own."""

    more: Floats


class Mode(StrEnum):
    SOFT = "soft"


class TestRules:
    @pytest.mark.parametrize(
        ("kind", "rule"),
        [
            (Tree, DATACLASS),
            (type("Below", (Tree,), {}), DATACLASS),
            (Longer, DATACLASS),
            (Pair, NAMED_TUPLE),
            (type("Below", (Pair,), {}), NAMED_TUPLE),
            (Model, MODEL),
            (list, NUMBERED),
            (type("Below", (tuple,), {}), NUMBERED),
            (frozenset, NUMBERED),
            (OrderedDict, KEYED),
            (MappingProxyType, KEYED),
            (Lamp, rule_of(Spline)),
            (Mode, None),
            (np.ndarray, None),
            (object, None),
            (type, None),
        ],
    )
    def test_nearest(self, kind: type, rule: Any) -> None:
        """A type has the rule of its nearest base that has one."""
        assert rule_of(kind) is rule

    def test_registered_late(self) -> None:
        """A rule holds from when it is registered, also for types that were asked for before."""

        class Late:
            array = np.zeros(2)

        assert ids(Late()) == []
        register_parts(Late)(lambda late: {"array": late.array})
        assert ids(Late()) == [id(Late.array)]

    def test_model_keeps_what_is_set(self) -> None:
        """A model is like another also in which of its fields were set."""
        other = with_arrays(Model(held=np.zeros(2), more=1), np.copy)
        assert other.model_fields_set == {"held", "more"}
        assert other.model_extra == {"more": 1}

    def test_private_attributes(self) -> None:
        """A model that holds what no field tells cannot be stored, and the error says where it is."""
        secret = type("Secret", (Model,), {"__annotations__": {"_hidden": int}, "_hidden": 3})
        with pytest.raises(CodecError, match=r"^\[0\]: Secret has private"):
            encode([secret(held=np.zeros(1))])


@node("parts.stretched")
def stretched(spline: Spline, *, by: float = 2.0) -> Spline:
    return Spline(spline.knots * by, spline.pair)


@node("parts.drawn")
def drawn(*, size: int = 4, spoilt: bool = False) -> Spline:
    return Spline(np.full(size, np.nan if spoilt else 1.0), Pair(np.ones(2), Kind.KEY))


class TestThirdParty:
    """A class with a rule works wherever a dataclass does."""

    @pytest.fixture
    def registry(self) -> Registry:
        registry = Registry([Pack("mine", {}, types={"Spline": f"{__name__}:Spline"})])
        registry.add(stretched)
        registry.add(drawn)
        return registry

    def graph(self, registry: Registry, **settings: Any) -> Any:
        nodes = {"d": {"use": "parts.drawn", "with": settings}, "s": {"use": "parts.stretched", "in": {"spline": "d"}}}
        return load({"graphface": 1, "nodes": nodes, "outputs": {"y": "s"}}, registry=registry)

    def test_disk_tier(self, registry: Registry, tmp_path: Path) -> None:
        """Its values are stored, and built again as the annotations of its constructor say."""
        graph = self.graph(registry)
        first = graph.run(evaluator=Evaluator(disk=DiskTier(tmp_path, 1 << 20)))
        again = graph.run(evaluator=Evaluator(disk=DiskTier(tmp_path, 1 << 20)))
        assert [record.state for record in again.records] == ["disk"]
        assert digest_value(again["y"]) == digest_value(first["y"])
        assert again["y"].pair.kind is Kind.KEY

    def test_frozen(self, registry: Registry) -> None:
        """They leave a node read-only."""
        with pytest.raises(ValueError, match="read-only"):
            self.graph(registry).run()["y"].knots[0] = 1

    def test_guard(self, registry: Registry) -> None:
        """NaN in them is found, and placed."""
        with pytest.raises(Exception, match=r"output \.knots has 4 non-finite of 4 values"):
            self.graph(registry, spoilt=True).run()

    def test_input(self, registry: Registry) -> None:
        """Given to a graph they count by content, and stay the caller's."""
        nodes = {"s": {"use": "parts.stretched", "in": {"spline": "x"}}}
        graph = load(
            {"graphface": 1, "inputs": {"x": "Spline"}, "nodes": nodes, "outputs": {"y": "s"}}, registry=registry
        )
        mine = Spline(np.ones(3))
        assert graph.run(x=mine)["y"].knots.tolist() == [2, 2, 2]
        mine.knots[0] = 5
        assert graph.run(x=mine)["y"].knots.tolist() == [10, 2, 2]

    def test_written(self, tmp_path: Path) -> None:
        """.npz holds its arrays."""
        write_output([Spline(np.zeros(2), Pair(np.ones(3)))], ANY, tmp_path / "a.npz", Registry().files)
        with np.load(tmp_path / "a.npz") as stored:
            assert set(stored) == {"[0].knots", "[0].pair.one"}

    def test_described(self) -> None:
        assert describe(Spline(np.zeros(2))) == "Spline(knots=float64[2] 0..0, pair=None)"

    def test_checked(self) -> None:
        """`check_node` copies and spoils them."""
        check_node(stretched, Spline(np.ones(3), Pair(np.ones(2))))

    def test_other_parts(self) -> None:
        """A stored value with other parts than the class takes now is refused."""
        tensors, structure = encode(Spline(np.zeros(2)))
        structure["fields"]["more"] = 1
        with pytest.raises(CodecError, match="more"):
            decode(tensors, structure, Spline)
