"""The effective document is a graph file that says the same as everything it was made from."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from graphface import Graph, Registry, load

INNER = """\
graphface: 1
name: inner
inputs:
  a: float
  b: {type: float, default: 10, doc: "added: to #a"}
nodes:
  plus: {use: toy.add, in: {a: a, b: b}, with: {plus: 1}}
  grid: {use: toy.grid}
  pair: {use: toy.pair, in: {grid: grid}}
outputs: {sum: plus, low: pair.low}
profiles:
  fine: {grid: {size: 6}}
"""

OUTER = """\
# a comment that nobody else reads
graphface: 1
extends: base.yaml
nodes:
  first: {use: inner.yaml, in: {a: x}, with: {plus.plus: 2}}  # and another
  second: {use: inner.yaml, in: {a: first.sum, b: x}}
  all: {use: toy.total, in: {values: [first.sum, second.sum, x]}}
  mean: {use: toy.mean, in: {grid: first/pair.low}}
  gone: null
outputs:
  total: all
  mean: mean
variants:
  bigger: {first: {with: {plus.plus: 5}}}
profiles:
  fine: {second/grid: {size: 7}}
"""

BASE = """\
graphface: 1
inputs: {x: float}
nodes:
  gone: {use: toy.fail, in: {a: x}}
  kept: {use: toy.add, in: {a: x}, with: {plus: 3}}
outputs: {kept: kept}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in (("inner", INNER), ("outer", OUTER), ("base", BASE)):
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    return tmp_path


def again(graph: Graph, *, origins: bool = True) -> Graph:
    return load(graph.effective(origins=origins), registry=graph.registry)


def place(name: str, text: str, fragment: str) -> str:
    """Where a fragment stands in a file, as errors and origins say it."""
    before = text[: text.index(fragment)].split("\n")
    return f"{name}.yaml:{len(before)}:{len(before[-1]) + 1}"


def keys(graph: Graph, **inputs: Any) -> dict[str, bytes]:
    """The key of every node by its name."""
    asked = graph.request(inputs)
    return {step.name: asked.key(step.slot) for step in graph.steps}


def text_of(nodes: str, inputs: str = "") -> str:
    return f"graphface: 1\n{f'inputs: {inputs}' if inputs else ''}\nnodes: {nodes}\n"


CHOICES: dict[str, dict[str, Any]] = {
    "plain": {},
    "variant": {"variants": ["bigger"]},
    "profile": {"profiles": ["fine"]},
    "set": {"set": {"first/plus.plus": 9, "kept.plus": 16}},
    "replace": {"replace": {"second/plus": "toy.subtract"}},
    "all": {
        "variants": ["bigger"],
        "profiles": ["fine"],
        "set": {"first/plus.plus": -1.5},
        "replace": {"kept": "toy.subtract"},
    },
}


class TestRoundTrip:
    @pytest.mark.parametrize("choices", CHOICES.values(), ids=CHOICES)
    @pytest.mark.parametrize("origins", [True, False])
    def test_same_keys(self, folder: Path, registry: Registry, choices: dict[str, Any], origins: bool) -> None:
        """Loaded again, every node has the key it had."""
        graph = load(folder / "outer.yaml", registry=registry, **choices)
        assert keys(again(graph, origins=origins), x=2.0) == keys(graph, x=2.0)

    @pytest.mark.parametrize("choices", CHOICES.values(), ids=CHOICES)
    def test_same_results(self, folder: Path, registry: Registry, choices: dict[str, Any]) -> None:
        """Loaded again, every output has the value it had."""
        graph = load(folder / "outer.yaml", registry=registry, **choices)
        assert dict(again(graph).run(x=2.0)) == dict(graph.run(x=2.0))

    @pytest.mark.parametrize("choices", CHOICES.values(), ids=CHOICES)
    def test_fixed_point(self, folder: Path, registry: Registry, choices: dict[str, Any]) -> None:
        """The effective document of an effective document is itself."""
        graph = load(folder / "outer.yaml", registry=registry, **choices)
        assert again(graph).effective(origins=False) == graph.effective(origins=False)

    def test_removed(self, folder: Path, registry: Registry) -> None:
        """A node that was removed is not in it."""
        assert "gone" not in load(folder / "outer.yaml", registry=registry).effective()

    def test_needs_no_other_file(self, folder: Path, registry: Registry) -> None:
        """It is whole: no file it was made from is needed to load it."""
        graph = load(folder / "outer.yaml", registry=registry)
        text = graph.effective()
        for file in folder.iterdir():
            file.unlink()
        assert load(text, registry=registry).outputs.keys() == graph.outputs.keys()

    def test_comments_have_no_part(self, folder: Path, registry: Registry) -> None:
        """Comments of the files it was made from change nothing, origins apart."""
        graph = load(folder / "outer.yaml", registry=registry)
        before = graph.effective(origins=False)
        (folder / "outer.yaml").write_text(OUTER.replace("# a comment", "# weights: [1,\n#"), encoding="utf-8")
        assert load(folder / "outer.yaml", registry=registry).effective(origins=False) == before

    def test_empty(self, registry: Registry) -> None:
        """A graph without nodes is one all the same."""
        assert again(load("graphface: 1\nname: nothing\n", registry=registry)).name == "nothing"

    def test_input_as_output(self, registry: Registry) -> None:
        """An output may be an input passed on."""
        graph = load("graphface: 1\ninputs: {x: float}\noutputs: {y: x}\n", registry=registry)
        assert again(graph).run(x=4.0)["y"] == 4.0

    def test_shipped(self) -> None:
        """The shipped graphs survive it, nested graphs and files given by default included."""
        pytest.importorskip("graphface.nodes")
        graph = load("relight")
        assert keys(again(graph)) == keys(graph)


class TestWires:
    @pytest.mark.parametrize("values", ["[]", "[x]", "[x, y, x]"])
    def test_lists(self, registry: Registry, values: str) -> None:
        """A list of wires stays one, of no or one wire too."""
        graph = load(
            text_of(f"{{t: {{use: toy.total, in: {{values: {values}}}}}}}", "{x: float, y: float}"), registry=registry
        )
        assert keys(again(graph), x=1.0, y=2.0) == keys(graph, x=1.0, y=2.0)

    def test_unplugged(self, registry: Registry) -> None:
        """A port that an overlay unplugged stays so."""
        graph = load(text_of("{g: {use: toy.grid}, n: {use: toy.takes_none, in: {grid: null}}}"), registry=registry)
        assert again(graph).run(["n"])["n"] == -1

    @pytest.mark.parametrize("name", ["null", "true", "Null", "FALSE", "on", "y"])
    def test_words_of_yaml(self, registry: Registry, name: str) -> None:
        """A node may be called what YAML takes for something else."""
        graph = load(
            text_of(f"{{'{name}': {{use: toy.number}}, n: {{use: toy.same, in: {{value: '{name}'}}}}}}"),
            registry=registry,
        )
        assert again(graph).run(["n"])["n"] == 1

    def test_fields(self, folder: Path, registry: Registry) -> None:
        """A wire to a field inside a nested graph keeps both."""
        assert "in: {grid: first/pair.low}" in load(folder / "outer.yaml", registry=registry).effective()


class TestInputs:
    @pytest.mark.parametrize("declared", ["Array", "list[float | None] | None", "Grid | float", "Any"])
    def test_types_as_written(self, registry: Registry, declared: str) -> None:
        """A type goes by the name that graph files know, not by that of its class."""
        graph = load(text_of("{n: {use: toy.same, in: {value: x}}}", f"{{x: '{declared}'}}"), registry=registry)
        assert again(graph).inputs["x"].type == graph.inputs["x"].type

    @pytest.mark.parametrize("default", ["null", "1.5", "-.inf", "'1'", "[1, two, null]", "{a: {b: [~]}}", "'#x: {'"])
    def test_defaults(self, registry: Registry, default: str) -> None:
        """A default keeps its value and type; one of null is a default."""
        graph = load(text_of("{}", f"{{x: {{type: Any, default: {default}}}}}"), registry=registry)
        (entry,) = again(graph).inputs.values()
        assert entry.default is not None
        assert graph.inputs["x"].default is not None
        assert entry.default.value == graph.inputs["x"].default.value

    def test_doc(self, folder: Path, registry: Registry) -> None:
        """What an input is for is kept."""
        assert again(load(folder / "inner.yaml", registry=registry)).inputs["b"].doc == "added: to #a"

    def test_open_inner_input(self, folder: Path, registry: Registry) -> None:
        """An inner graph's input that nobody plugged keeps its default, by its path."""
        graph = again(load(folder / "outer.yaml", registry=registry))
        assert list(graph.inputs) == ["x", "first/b"]


class TestOrigins:
    def test_file(self, folder: Path, registry: Registry) -> None:
        """A value from a file says file, line and column."""
        shown = load(folder / "outer.yaml", registry=registry).effective()
        assert f"plus: 3  # {place('base', BASE, 'plus: 3')}" in shown
        assert f"plus: 2  # {place('outer', OUTER, 'plus.plus: 2')}" in shown

    def test_overlay(self, folder: Path, registry: Registry) -> None:
        """A value from a variant or profile says where that stands."""
        shown = load(folder / "outer.yaml", registry=registry, variants=["bigger"], profiles=["fine"]).effective()
        assert f"plus: 5  # {place('outer', OUTER, 'plus.plus: 5')}" in shown
        assert f"size: 6  # {place('inner', INNER, 'size: 6')}" in shown
        assert f"size: 7  # {place('outer', OUTER, 'size: 7')}" in shown

    def test_flags(self, folder: Path, registry: Registry) -> None:
        """A value from a flag says which."""
        graph = load(folder / "outer.yaml", registry=registry, set={"kept.plus": 8}, replace={"mean": "toy.takes_none"})
        shown = graph.effective()
        assert "plus: 8  # --set" in shown
        assert "use: toy.takes_none  # --replace" in shown

    def test_odd_file_name(self, tmp_path: Path, registry: Registry) -> None:
        """A file name that holds a line break cannot break the text."""
        path = tmp_path / "a\nnodes: #.yaml"
        path.write_text(text_of("{n: {use: toy.number, with: {value: 2}}}"), encoding="utf-8")
        assert again(load(path, registry=registry)).run(["n"])["n"] == 2


JSON_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=20), inner, max_size=4),
    max_leaves=12,
)


class TestValues:
    @given(JSON_VALUES)
    @settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
    def test_any_value(self, registry: Registry, value: Any) -> None:
        """Whatever a parameter is set to comes back: texts with line breaks and signs, infinities, nested values."""
        graph = load(text_of("{n: {use: toy.options}}"), registry=registry, set={"n.anything": value})
        (step,) = again(graph).steps
        assert repr(step.parameters["anything"]) == repr(value)

    @given(st.text())
    @settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
    def test_doc(self, registry: Registry, doc: str) -> None:
        """A doc of any characters comes back."""
        graph = load(json.loads(json.dumps({"graphface": 1, "doc": doc})), registry=registry)
        assert again(graph).composition.doc == graph.composition.doc

    @pytest.mark.parametrize(
        ("given_value", "back"),
        [(np.float32(2.5), 2.5), (np.arange(2), [0, 1]), ((1, 2), [1, 2]), (Path("a/b"), "a/b")],
    )
    def test_nearest(self, registry: Registry, given_value: Any, back: Any) -> None:
        """What YAML cannot say is written as the nearest value that it can."""
        graph = load(text_of("{n: {use: toy.options}}"), registry=registry, set={"n.anything": given_value})
        assert again(graph).steps[0].parameters["anything"] == back
