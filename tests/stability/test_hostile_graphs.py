"""A graph file executes nothing and reads nothing beyond its folder; a name from a template stays in its folder."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface import DocumentError, Graph, Registry, UnreadableFile, UsageError, load
from graphface.cli.output_names import output_files
from graphface.nodes.io.image_write import write_image
from graphface.nodes.types import Image

HARMLESS = "graphface: 1\nname: secret\ninputs: {x: float}\nnodes: {n: {use: toy.add, in: {a: x}}}\noutputs: {n: n}\n"


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """A folder for graphs, and beside it what they must not reach: secret.yaml, secret.png and a plug-in."""
    home = tmp_path / "home"
    (home / "sub").mkdir(parents=True)
    (tmp_path / "secret.yaml").write_text(HARMLESS)
    (tmp_path / "plugin.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'w').close()\n")
    (home / "plugin.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'w').close()\n")
    write_image(Image(np.zeros((4, 4, 3), np.float32)), tmp_path / "secret.png")
    return home


@pytest.fixture
def refused(house: Path, registry: Registry) -> Callable[[str], list[str]]:
    """Loads a graph text from the folder; the messages of its problems."""

    def read(text: str) -> list[str]:
        (house / "graph.yaml").write_text(text)
        with pytest.raises(DocumentError) as caught:
            load(house / "graph.yaml", registry=registry)
        assert not (house.parent / "ran").exists()
        return [problem.message for problem in caught.value.problems]

    return read


OUTSIDE = [
    "../secret.yaml",
    "sub/../../secret.yaml",
    "ABSOLUTE/secret.yaml",
    "./.././secret.yaml",
    "link.yaml",
    "folder/secret.yaml",
]


class TestGraphFiles:
    @pytest.mark.parametrize("name", OUTSIDE)
    @pytest.mark.parametrize("form", ["nodes: {{n: {{use: {}, in: {{x: x}}}}}}", "extends: {}"])
    def test_outside(self, house: Path, refused: Any, name: str, form: str) -> None:
        """Neither `use` nor `extends` reaches out of the folder: by dots, by an absolute path, or through a link."""
        (house / "link.yaml").symlink_to(house.parent / "secret.yaml")
        (house / "folder").symlink_to(house.parent, target_is_directory=True)
        named = name.replace("ABSOLUTE", str(house.parent))
        said = refused(f"graphface: 1\ninputs: {{x: float}}\n{form.format(json.dumps(named))}\n")
        assert said[0] == f"{named!r} lies outside the folder of the graph"

    def test_below_a_used_graph(self, house: Path, refused: Any) -> None:
        """A used graph in a sub-folder cannot reach out either."""
        (house / "sub" / "inner.yaml").write_text("graphface: 1\nextends: ../../secret.yaml\n")
        assert "'../../secret.yaml' lies outside the folder of the graph" in refused(
            "graphface: 1\ninputs: {x: float}\nnodes: {n: {use: sub/inner.yaml, in: {x: x}}}\n"
        )

    def test_inside(self, house: Path, registry: Registry) -> None:
        """A sub-folder, and a link that stays inside, are fine."""
        (house / "sub" / "inner.yaml").write_text(HARMLESS)
        (house / "link.yaml").symlink_to(house / "sub" / "inner.yaml")
        text = "graphface: 1\ninputs: {x: float}\nnodes:\n"
        text += "".join(
            f"  {n}: {{use: {f}, in: {{x: x}}}}\n" for n, f in (("a", "sub/inner.yaml"), ("b", "link.yaml"))
        )
        (house / "graph.yaml").write_text(text)
        assert load(house / "graph.yaml", registry=registry).run(["a.n"], x=2.0)["a.n"] == 2

    @pytest.mark.parametrize(
        "name", ["/dev/zero", "/dev/stdin", "/proc/self/mem", "sub", "fifo.yaml", "a\\0.yaml", "~/x.yaml"]
    )
    def test_special_files(self, house: Path, refused: Any, name: str) -> None:
        """Devices, folders and pipes are not opened: nothing waits for them."""
        os.mkfifo(house / "fifo.yaml")
        assert refused(f'graphface: 1\nnodes: {{n: {{use: "{name}"}}}}\nextends: "{name}"\n')


class TestCode:
    @pytest.mark.parametrize(
        "use",
        [
            "plugin.py",
            "plugin",
            "plugin:open",
            "os.system",
            "builtins.eval",
            "toys:called",
            "__import__",
            "toy.__class__",
        ],
    )
    def test_use(self, refused: Any, use: str) -> None:
        """`use` names registered operators and graph files; no module, no attribute, no file of Python."""
        assert refused(f"graphface: 1\nnodes: {{n: {{use: '{use}'}}}}\n")[0].startswith(f"unknown operator {use!r}")

    @pytest.mark.parametrize(
        "tag",
        ["!!python/object/apply:os.system [id]", "!!python/name:os.system ''", "!include plugin.py", "!!binary aGk="],
    )
    def test_tags(self, refused: Any, tag: str) -> None:
        """No YAML tag means anything."""
        assert "tags" in refused(f"graphface: 1\nname: {tag}\n")[0]

    @pytest.mark.parametrize("declared", ["os:system", "__builtins__", "toys", "list[os]", "'Path'.x"])
    def test_types(self, refused: Any, declared: str) -> None:
        """A type is a registered name."""
        assert refused(f'graphface: 1\ninputs: {{x: "{declared}"}}\n')

    @pytest.mark.parametrize("reference", ["n.__class__", "n.__class__.__init__.__globals__", "n.pixels", "x.real"])
    def test_references(self, refused: Any, reference: str) -> None:
        """A reference takes declared outputs of a node, not attributes of Python objects."""
        text = "graphface: 1\ninputs: {x: float}\nnodes: {n: {use: toy.add, in: {a: x}}}\n"
        assert refused(f"{text}outputs: {{o: {reference}}}\n")

    def test_parameters(self, registry: Registry) -> None:
        """Texts in parameters are texts: nothing is expanded, formatted or evaluated."""
        text = "{x} $HOME ${HOME} %(x)s `id` __import__('os')"
        graph = load(
            {"graphface": 1, "nodes": {"n": {"use": "toy.options", "with": {"anything": text}}}}, registry=registry
        )
        assert graph.steps[0].parameters["anything"] == text


class TestDefaults:
    def bind(self, house: Path, default: str, declared: str = "Image") -> Graph:
        quoted = json.dumps(default)
        (house / "graph.yaml").write_text(f"graphface: 1\ninputs: {{photo: {{type: {declared}, default: {quoted}}}}}\n")
        graph = load(house / "graph.yaml")
        graph.bind({})
        return graph

    @pytest.mark.parametrize(
        "name", ["../secret.png", "ABSOLUTE/secret.png", "link.png", "folder/secret.png", "/dev/zero", "."]
    )
    def test_outside(self, house: Path, name: str) -> None:
        """A default file lies below the folder of the graph, or among the shipped ones."""
        (house / "link.png").symlink_to(house.parent / "secret.png")
        (house / "folder").symlink_to(house.parent, target_is_directory=True)
        with pytest.raises(UnreadableFile, match="no such file beside the graph"):
            self.bind(house, name.replace("ABSOLUTE", str(house.parent)))

    def test_inside(self, house: Path) -> None:
        """One that does is read."""
        (house / "sub" / "photo.png").write_bytes((house.parent / "secret.png").read_bytes())
        graph = self.bind(house, "sub/photo.png")
        assert graph.bind({})["photo"].value.height == 4

    def test_path_type(self, house: Path) -> None:
        """A text is no `Path`: a graph cannot hand an operator a path of its choice as a default."""
        with pytest.raises(UsageError, match="expected Path"):
            self.bind(house, "/etc/passwd", declared="Path")

    def test_constant_of_a_used_graph(self, house: Path) -> None:
        """A file set for an input of a used graph is held to the same."""
        (house / "inner.yaml").write_text("graphface: 1\ninputs: {photo: Image}\noutputs: {o: photo}\n")
        text = "graphface: 1\nnodes: {n: {use: inner.yaml, with: {photo: ../secret.png}}}\noutputs: {o: n}\n"
        (house / "graph.yaml").write_text(text)
        with pytest.raises(UnreadableFile, match="no such file beside the graph"):
            load(house / "graph.yaml").bind({})

    def test_named_by_the_user(self, house: Path) -> None:
        """What the user names may lie anywhere."""
        (house / "graph.yaml").write_text("graphface: 1\ninputs: {photo: Image}\n")
        graph = load(house / "graph.yaml")
        assert graph.bind({"photo": str(house.parent / "secret.png")})["photo"].value.height == 4


class TestOutputNames:
    GRAPH = "graphface: 1\ninputs: {x: str}\nnodes: {n: {use: toy.number}}\noutputs: {n: n}\n"

    @pytest.mark.parametrize(
        "value",
        [
            "../../etc/passwd",
            "/etc/passwd",
            "..",
            ".",
            "a/../..",
            "..\\..\\x",
            "C:\\x",
            "a\0b",
            "~",
            "{x}",
            ".hidden",
            "a\nb",
            "",
            "-rf",
        ],
    )
    def test_stays_in_its_folder(self, registry: Registry, tmp_path: Path, value: str) -> None:
        """Whatever is given for an input, what it puts into a file name is one plain part of it."""
        graph = load(self.GRAPH, registry=registry)
        (path,) = output_files(graph, [f"{tmp_path}/out/{{x}}.png"], {"x": value}).values()
        assert path.parent == tmp_path / "out"
        assert path.name.endswith(".png")
        assert not path.name.startswith("..")

    @given(st.text(max_size=40))
    def test_any_text(self, value: str) -> None:
        """The same for any text."""
        from toys import toy_registry

        graph = load(self.GRAPH, registry=toy_registry())
        (path,) = output_files(graph, ["out/{x}.png"], {"x": value}).values()
        assert path.parent == Path("out")
        assert path.resolve().parent == Path("out").resolve()
        assert "\0" not in str(path)

    def test_no_attributes(self, registry: Registry) -> None:
        """A template knows names of inputs and nothing else."""
        graph = load(self.GRAPH, registry=registry)
        for template in ("{x.__class__}.png", "{0}.png", "{x!r}.png", "{}.png", "{y}.png"):
            with pytest.raises(UsageError, match="no input"):
                output_files(graph, [template], {"x": "a"})
