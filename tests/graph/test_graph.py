"""A loaded graph: where it may come from, what can be asked of it, and how it looks from outside."""

from pathlib import Path

import numpy as np
import pytest

from graphface import DocumentError, Graph, Registry, UsageError, load
from graphface.errors import InputError

TEXT = """graphface: 1
name: sums
inputs: {x: {type: float, default: 2}, g: Grid}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 1}}
  p: {use: toy.pair, in: {grid: g}}
  m: {use: toy.mean, in: {grid: p.low}}
outputs: {y: a, low: p.low}
"""


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


class TestSources:
    def test_file(self, registry: Registry, tmp_path: Path) -> None:
        """From a file, by path or text of the path."""
        (tmp_path / "g.yaml").write_text(TEXT)
        for source in (tmp_path / "g.yaml", str(tmp_path / "g.yaml")):
            assert load(source, registry=registry).run(["y"])["y"] == 3

    def test_mapping(self, registry: Registry) -> None:
        """From a mapping of the same form; a text in it never becomes a number."""
        settings = {"must": 1, "mode": "1e0"}
        nodes = {
            "x": {"use": "toy.ranged", "in": {"a": "n"}, "with": settings},
            "n": {"use": "toy.number", "with": {"value": 1e-7}},
        }
        tree = {"graphface": 1, "nodes": nodes}
        loaded = load(tree, registry=registry)
        assert {s.name: s.parameters.get("mode") for s in loaded.steps} == {"n": None, "x": "1e0"}
        assert loaded.run(["n"])["n"] == 1e-7

    def test_mapping_of_objects(self, registry: Registry) -> None:
        """A mapping with values that a file could not hold is refused."""
        with pytest.raises(UsageError, match="plain values"):
            load(
                {"graphface": 1, "nodes": {"x": {"use": "toy.number", "with": {"value": object()}}}}, registry=registry
            )

    def test_name_from_the_file(self, registry: Registry, tmp_path: Path) -> None:
        """A graph without a name is called like its file."""
        (tmp_path / "mine.yaml").write_text(TEXT.replace("name: sums\n", ""))
        assert load(tmp_path / "mine.yaml", registry=registry).name == "mine"

    def test_plugin(self, registry: Registry, tmp_path: Path) -> None:
        """Plug-ins of one load do not stay in the registry."""
        (tmp_path / "plug.py").write_text(
            "from graphface import node\n@node('mine.one')\ndef one() -> float:\n    return 1.0\n"
        )
        text = "graphface: 1\nnodes: {o: {use: mine.one}}\n"
        assert load(text, registry=registry, plugins=[tmp_path / "plug.py"]).run(["o"])["o"] == 1
        with pytest.raises(DocumentError):
            load(text, registry=registry)

    def test_cannot_import_code(self, registry: Registry, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A graph file cannot execute code: no name in it is ever imported."""
        (tmp_path / "evil.py").write_text("raise SystemExit('executed')\n")
        monkeypatch.syspath_prepend(str(tmp_path))
        for use in ("evil.run", "evil", "evil:run", "evil.py", "./evil.py"):
            with pytest.raises(DocumentError):
                load(f"graphface: 1\nnodes:\n  x: {{use: '{use}'}}\n", registry=registry)


class TestRequests:
    def test_all_outputs(self, graph: Graph) -> None:
        """By default all declared outputs are computed."""
        assert set(graph.run(g=np.ones((2, 2)))) == {"y", "low"}

    def test_any_node(self, graph: Graph) -> None:
        """Any node, field or input can be asked for."""
        result = graph.run(["m", "p.high", "x"], g=np.ones((2, 2)))
        assert result["m"] == 1
        assert result["p.high"].max() == 2
        assert result["x"] == 2

    @pytest.mark.parametrize("name", ["mm", "p.hihg", "m.low", "", ".", "y.low"])
    def test_unknown(self, graph: Graph, name: str) -> None:
        """What the graph does not have is refused by name."""
        with pytest.raises(InputError) as caught:
            graph.targets([name])
        assert caught.value.name == name

    def test_missing(self, graph: Graph) -> None:
        """Inputs that a request needs and nobody gave are known before running."""
        assert graph.missing({}, graph.targets(["m"]).values()) == ["g"]
        assert graph.missing({}, graph.targets(["y"]).values()) == []

    def test_type(self, graph: Graph) -> None:
        """The type behind a target is known before running."""
        assert str(graph.type_of(graph.targets(["p.high"])["p.high"])) == "Grid | None"


class TestOutside:
    def test_repr(self, graph: Graph) -> None:
        """A graph prints as its name, size and outputs."""
        assert repr(graph) == "Graph('sums', 3 nodes, outputs: y, low)"

    def test_networkx(self, graph: Graph) -> None:
        """As a networkx graph its edges carry the ports."""
        drawn = graph.networkx()
        assert set(drawn.nodes) == {"x", "g", "a", "p", "m"}
        assert drawn.edges["p", "m"]["port"] == "grid"
        assert drawn.nodes["a"]["operator"] == "toy.add"

    def test_behind(self, graph: Graph) -> None:
        """What may be needed is known without running, in an order that runs."""
        slots = graph.behind(graph.targets(["m"]).values())
        names = [*graph.input_names, *(step.name for step in graph.steps)]
        assert [names[slot] for slot in slots] == ["g", "p", "m"]

    def test_thousand_nodes(self, registry: Registry) -> None:
        """A large graph loads and runs whole."""
        nodes = ["  n0: {use: toy.number}"]
        nodes += [f"  n{i}: {{use: toy.add, in: {{a: n{i - 1}, b: n{i // 2}}}}}" for i in range(1, 60)]
        nodes += [f"  m{i}: {{use: toy.add, in: {{a: n{i % 60}}}, with: {{plus: {i}}}}}" for i in range(1000)]
        loaded = load("graphface: 1\nnodes:\n" + "\n".join(nodes) + "\n", registry=registry)
        asked = [f"m{i}" for i in range(1000)]
        assert loaded.run(asked)["m0"] == 1
