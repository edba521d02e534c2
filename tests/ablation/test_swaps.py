"""From the words of `--swap` to the variants of a graph."""

from __future__ import annotations

import pytest

from graphface import UsageError, load
from graphface.ablation.swaps import read_swaps, variants

GRAPH = {
    "graphface": 1,
    "name": "sum",
    "inputs": {"x": "float"},
    "nodes": {
        "first": {"use": "toy.add", "in": {"a": "x"}, "with": {"plus": 1.0}},
        "second": {"use": "toy.add", "in": {"a": "first", "b": "x"}},
    },
    "outputs": {"y": "second"},
    "variants": {"loud": {"first": {"with": {"plus": 100.0}}}},
}


@pytest.fixture
def graph(registry):
    return load(GRAPH, registry=registry)


class TestReadSwaps:
    def test_operators_with_or_without_their_family(self, graph):
        """A method's own name is enough."""
        (swap,) = read_swaps(["second=add,toy.subtract"], graph)
        assert (swap.kind, swap.subject, swap.values) == ("operator", "second", ("toy.add", "toy.subtract"))

    def test_parameters_have_the_type_that_yaml_gives(self, graph):
        """Numbers are numbers."""
        (swap,) = read_swaps(["first.plus=1,2.5"], graph)
        assert swap.values == (1, 2.5)

    @pytest.mark.parametrize(
        ("text", "said"),
        [
            ("first", "expected NODE"),
            ("first=", "expected NODE"),
            ("frst=add", "did you mean 'first'"),
            ("first=grid", "cannot take the place of toy.add"),
            ("first.plsu=1", "did you mean 'plus'"),
        ],
    )
    def test_mistakes_name_what_was_meant(self, graph, text, said):
        """Every mistake is a usage error that helps."""
        with pytest.raises(UsageError, match=said):
            read_swaps([text], graph)


class TestVariants:
    def test_product(self, graph):
        """Every combination, the first one of first values."""
        made = variants(read_swaps(["first=add,subtract", "first.plus=1,2,3"], graph))
        assert len(made) == 6
        assert made[0].name == "toy.add · first.plus=1"

    def test_one_at_a_time(self, graph):
        """The first combination, and one deviation from it each."""
        made = variants(read_swaps(["second=add,subtract", "first.plus=1,2,3"], graph), one_at_a_time=True)
        assert [v.name.count("toy.add") for v in made] == [1, 0, 1, 1]

    def test_repeated_values_make_one_variant(self, graph):
        """Asking twice for the same is asking once."""
        assert len(variants(read_swaps(["first.plus=1,1"], graph))) == 1

    def test_without_swaps_there_is_the_graph_itself(self):
        """Nothing swapped leaves one variant."""
        assert [v.name for v in variants([])] == ["as it is"]

    def test_declared_variants_can_be_swapped(self, graph):
        """Overlays that the graph declares are values too."""
        (made,) = variants(read_swaps(["variant=loud"], graph))
        assert made.variants == ("loud",)


class TestAll:
    def test_of_a_family(self, graph):
        """The node's own operator first, then all that fit; each once."""
        (swap,) = read_swaps(["second=all"], graph)
        assert swap.values[0] == "toy.add"
        assert {"toy.subtract", "toy.fail"} < set(swap.values)
        assert "toy.grid" not in swap.values
        assert read_swaps(["second=subtract,all"], graph)[0].values[0] == "toy.subtract"

    def test_of_variants_and_profiles(self, graph):
        """None of them, then each that is declared."""
        made = variants(read_swaps(["variant=all"], graph))
        assert [(v.name, v.variants) for v in made] == [("variant=none", ()), ("variant=loud", ("loud",))]
        assert [v.profiles for v in variants(read_swaps(["profile=all"], graph))] == [()]

    def test_none_can_be_declared(self, registry):
        """A variant of that name is that variant."""
        declared = load({**GRAPH, "variants": {"none": {"first": {"with": {"plus": 0}}}}}, registry=registry)
        assert [v.variants for v in variants(read_swaps(["variant=none"], declared))] == [("none",)]

    def test_of_choices(self, registry):
        """The choices of a parameter, and both of a flag; numbers have to be named."""
        nodes = {"n": {"use": "toy.nested"}, "p": {"use": "toy.pair", "in": {"grid": "g"}}, "g": {"use": "toy.grid"}}
        chosen = load({"graphface": 1, "nodes": nodes, "outputs": {"y": "n", "z": "p"}}, registry=registry)
        assert read_swaps(["n.mode=all"], chosen)[0].values == ("hard", "soft")
        assert read_swaps(["p.both=all"], chosen)[0].values == (False, True)
        with pytest.raises(UsageError, match="name its values"):
            read_swaps(["g.size=all"], chosen)
