"""A graph file of the wrong form is answered with every mistake and its place."""

import inspect
from pathlib import Path

import pytest

from graphface import Graph
from graphface.document.document import TAKEN, Document, parse_document, read_document
from graphface.errors import DocumentError, Problem, UnreadableFile
from graphface.place import Source


def read(text: str) -> tuple[Document, list[Problem]]:
    return parse_document(Source("graph.yaml", text))


def problems(text: str) -> list[tuple[int, int, str]]:
    """Line, column and message of each problem."""
    found = []
    for problem in read("graphface: 1\n" + text)[1]:
        assert problem.place is not None
        found.append((problem.place.line, problem.place.column, problem.message))
    return found


class TestReading:
    TEXT = """graphface: 1
name: g
doc: What it does.
extends: base.yaml
inputs:
  photo: Image
  scene: {type: Scene, default: a.yaml, doc: The light.}
nodes:
  x: {use: toy.add, in: {a: photo, b: [p, q.r], c: null}, with: {k: 1}, doc: Adds.}
  gone: null
outputs:
  image: x
variants:
  soft: {x: {use: toy.sub}, sub/y: null}
profiles:
  draft: {x: {k: 2}}
"""

    def test_everything(self) -> None:
        """Every section of a file is read."""
        document, found = read(self.TEXT)
        assert found == []
        assert (document.name, document.doc) == ("g", "What it does.")
        assert document.extends is not None
        assert document.extends.value == "base.yaml"
        assert document.inputs["photo"].type.value == "Image"
        assert document.inputs["scene"].default is not None
        assert document.inputs["scene"].default.value == "a.yaml"
        node = document.nodes["x"]
        assert node.use is not None
        assert node.use.value == "toy.add"
        assert {port: wire.names for port, wire in node.wires.items()} == {
            "a": ("photo",),
            "b": ("p", "q.r"),
            "c": None,
        }
        assert node.settings["k"].value == 1
        assert document.nodes["gone"].removed
        assert document.outputs["image"].value == "x"
        assert document.variants["soft"]["sub/y"].removed
        assert document.profiles["draft"]["x"].settings["k"].value == 2

    def test_places(self) -> None:
        """What was read knows where it stood."""
        document, _ = read(self.TEXT)
        node = document.nodes["x"]
        assert str(node.place) == "graph.yaml:9:3"
        assert node.use is not None
        assert str(node.use.place) == "graph.yaml:9:12"

    def test_byte_order_mark(self, tmp_path: Path) -> None:
        """A file may begin with a byte-order mark, as some editors write it."""
        path = tmp_path / "g.yaml"
        path.write_bytes(b"\xef\xbb\xbfgraphface: 1\nnodes: {}\n")
        assert read_document(path)[1] == []


class TestForm:
    @pytest.mark.parametrize("text", ["", "[]", "just words", "3"])
    def test_no_mapping(self, text: str) -> None:
        """A text that is no mapping is told how graph files begin."""
        _, (problem,) = read(text)
        assert "graphface: 1" in problem.message

    @pytest.mark.parametrize("version", ["2", "true", "'1'", "[1]", "null"])
    def test_version(self, version: str) -> None:
        """Another version of the format is refused at its place."""
        _, (problem,) = read(f"graphface: {version}\n")
        assert problem.place is not None
        assert problem.place.column == 12

    def test_misspelt_section(self) -> None:
        """An unknown section is told the nearest one."""
        _, (problem,) = read("graphface: 1\noutput: {}\n")
        assert problem.nearest == ("outputs",)
        assert problem.place is not None
        assert problem.place.line == 2

    def test_misspelt_node_entry(self) -> None:
        """So is an unknown entry of a node."""
        _, (problem,) = read("graphface: 1\nnodes:\n  x: {uses: a.b}\n")
        assert problem.nearest == ("use",)

    @pytest.mark.parametrize(
        "text",
        [
            "name: [a]",
            "extends: [a]",
            "inputs: [a]",
            "inputs: {a: 3}",
            "inputs: {a: {default: 3}}",
            "inputs: {a b: Image}",
            "nodes: x",
            "nodes: {x: 3}",
            "nodes: {x: {use: 3}}",
            "nodes: {x: {use: a.b, in: [a]}}",
            "nodes: {x: {use: a.b, in: {p: 3}}}",
            "nodes: {x: {use: a.b, in: {p: [a, 3]}}}",
            "nodes: {x: {use: a.b, in: {p: a..b}}}",
            "nodes: {x: {use: a.b, in: {p: ../x}}}",
            "nodes: {x: {use: a.b, with: 3}}",
            "nodes: {x y: {use: a.b}}",
            "outputs: {a: [x]}",
            "outputs: {a: 'x y'}",
            "variants: {v: 3}",
            "variants: {v: {x: 3}}",
            "profiles: {p: {x: null}}",
            "profiles: {p: [x]}",
        ],
    )
    def test_one_mistake(self, text: str) -> None:
        """Each mistake of form is one problem on its line."""
        found = problems(text)
        assert [line for line, _, _ in found] == [2]

    def test_all_at_once(self) -> None:
        """All mistakes are reported, in one go."""
        found = problems("nodes:\n  a: 3\n  b: {uses: x}\n  c: {use: [1]}\noutputs:\n  o: 5\n")
        assert sorted(line for line, _, _ in found) == [3, 4, 5, 7]

    @pytest.mark.parametrize("name", sorted(TAKEN))
    def test_input_that_could_not_be_given(self, name: str) -> None:
        """An input that `Graph.run` would take for an argument of its own is refused at its place."""
        ((line, column, message),) = problems(f"inputs:\n  a: float\n  {name}: float\n")
        assert (line, column) == (4, 3)
        assert repr(name) in message

    def test_every_taken_name_is_refused(self) -> None:
        """Those are all named arguments of `Graph.run`; any other name, `self` too, can be an input."""
        named = [
            p
            for p in inspect.signature(Graph.run).parameters.values()
            if p.kind in (p.KEYWORD_ONLY, p.POSITIONAL_OR_KEYWORD)
        ]
        assert {p.name for p in named} == TAKEN
        assert problems("inputs: {self: float, inputs: float}\n") == []

    def test_input_and_node_of_one_name(self) -> None:
        """One name cannot be an input and a node; the message tells the other line."""
        ((line, _, message),) = problems("inputs: {x: Image}\nnodes:\n  x: {use: a.b}\n")
        assert line == 4
        assert "line 2" in message


class TestUnreadable:
    def test_missing(self, tmp_path: Path) -> None:
        """A missing file is named."""
        with pytest.raises(UnreadableFile) as caught:
            read_document(tmp_path / "none.yaml")
        assert caught.value.path.name == "none.yaml"

    def test_folder(self, tmp_path: Path) -> None:
        """A folder is no graph file."""
        with pytest.raises(UnreadableFile):
            read_document(tmp_path)

    def test_not_utf8(self, tmp_path: Path) -> None:
        """The byte that is no UTF-8 is told."""
        path = tmp_path / "g.yaml"
        path.write_bytes(b"graphface: 1\nname: \xff\n")
        with pytest.raises(UnreadableFile, match="byte 19 is 0xff"):
            read_document(path)

    def test_binary(self, tmp_path: Path) -> None:
        """A file with NULs is an error like any other."""
        path = tmp_path / "g.yaml"
        path.write_bytes(bytes(100))
        with pytest.raises(DocumentError):
            read_document(path)
