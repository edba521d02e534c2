"""Imports run downwards only and in no circle, and the drawing in .github shows what is."""

import ast

import layers
import networkx as nx
import pytest


@pytest.fixture(scope="module")
def imports() -> nx.DiGraph:
    return layers.import_graph()


class TestImports:
    @pytest.mark.parametrize("container", ["graphface", "graphface.nodes"])
    def test_downwards(self, imports: nx.DiGraph, container: str) -> None:
        """No module imports from a layer above its own; the engine, below graphface.nodes, never imports it."""
        assert layers.upward_imports(imports, container) == []

    def test_no_circle(self, imports: nx.DiGraph) -> None:
        """No modules import each other in a circle, not for types only and not inside functions either."""
        assert layers.circles(imports) == []

    @pytest.mark.parametrize("container", ["graphface", "graphface.nodes"])
    def test_every_module_has_a_layer(self, imports: nx.DiGraph, container: str) -> None:
        named = {name for layer in layers.layers(container) for name in layer}
        present = {
            module.removeprefix(f"{container}.").partition(".")[0]
            for module in imports
            if module.startswith(f"{container}.")
        }
        assert present - named == set()


class TestFindings:
    """What is wrong is found: on a small graph."""

    def test_upward(self) -> None:
        graph = nx.DiGraph([("graphface.values.codec", "graphface.node"), ("graphface.node", "graphface.values.codec")])
        assert layers.upward_imports(graph, "graphface") == ["graphface.values.codec -> graphface.node"]
        assert layers.circles(graph) == [["graphface.node", "graphface.values.codec"]]

    def test_import_of_nodes(self) -> None:
        graph = nx.DiGraph([("graphface.registry", "graphface.nodes.types")])
        assert layers.upward_imports(graph, "graphface") == ["graphface.registry -> graphface.nodes.types"]

    def test_inside_functions_and_for_types(self) -> None:
        text = "if TYPE_CHECKING:\n    from a import b\ndef f():\n    from . import c\n    import d.e"
        assert list(layers.imported_names(ast.parse(text), "p.q")) == ["a.b", "p.q.c", "d.e"]


def test_drawing() -> None:
    """The committed drawing is the one that the code gives."""
    committed = layers.DRAWING.read_text(encoding="utf-8")
    assert committed == layers.drawing(), "run `python tests/layers.py` and commit .github/layers.svg"
