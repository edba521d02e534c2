"""What a caller gives is known by content at once and loaded only when needed."""

import os
from pathlib import Path
from typing import Annotated

import numpy as np
import pytest
from pydantic import BaseModel, ConfigDict, Field
from toys import toy_registry

from graphface import DocumentError, Files, Graph, Pack, Registry, UnreadableFile, load, read_yaml, validated
from graphface.errors import InputError


class Note:
    """A type that is read from a file (see below), and accepts a list of words."""

    def __init__(self, text: str) -> None:
        self.text = text

    @classmethod
    def coerce(cls, value: object) -> "Note":
        if not isinstance(value, list):
            raise TypeError("a note is a list of words")
        return cls(" ".join(value))


def read_note(path: Path) -> Note:
    os.environ["GRAPHFACE_TEST_READS"] = str(int(os.environ.get("GRAPHFACE_TEST_READS", "0")) + 1)
    return Note(path.read_text())


@pytest.fixture
def registry() -> Registry:
    toys = toy_registry()
    registry = Registry([*toys._packs, Pack("notes", {}, types={"Note": f"{__name__}:Note"})])
    registry.add_files(Note, Files(read_note))
    return registry


@pytest.fixture(autouse=True)
def no_reads_yet(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GRAPHFACE_TEST_READS", "0")


def graph(registry: Registry, inputs: str, folder: Path | None = None) -> Graph:
    text = f"graphface: 1\ninputs: {{x: {inputs}}}\noutputs: {{y: x}}\n"
    if folder is None:
        return load(text, registry=registry)
    (folder / "g.yaml").write_text(text)
    return load(folder / "g.yaml", registry=registry)


class TestGiven:
    @pytest.mark.parametrize(
        ("declared", "given", "expected"),
        [
            ("float", "2.5", 2.5),
            ("int", "7", 7),
            ("bool", "true", True),
            ("str", "7", "7"),
            ("Path", "a/b", Path("a/b")),
        ],
    )
    def test_text(self, registry: Registry, declared: str, given: str, expected: object) -> None:
        """A text from the command line becomes what the input's type says."""
        assert graph(registry, declared).run(x=given)["y"] == expected

    @pytest.mark.parametrize(
        ("declared", "given"),
        [
            ("float", "red"),
            ("int", 2.5),
            ("bool", 1),
            ("int", True),
            ("str", 3),
            ("Grid", 3.0),
            ("Grid", np.zeros(3)),
            ("float", None),
        ],
    )
    def test_wrong_type(self, registry: Registry, declared: str, given: object) -> None:
        """A value of another type is refused by the input's name."""
        with pytest.raises(InputError) as caught:
            graph(registry, declared).run(x=given)
        assert caught.value.name == "x"

    def test_unknown(self, registry: Registry) -> None:
        """An input that the graph does not have is told the nearest."""
        with pytest.raises(InputError) as caught:
            load("graphface: 1\ninputs: {photo: float}\n", registry=registry).bind({"foto": 1})
        assert caught.value.nearest == ["photo"]

    def test_optional(self, registry: Registry) -> None:
        """An optional input that is not given is None."""
        assert graph(registry, "float | None").run()["y"] is None

    def test_undigestible(self, registry: Registry) -> None:
        """A value whose content cannot be read is refused by name."""
        with pytest.raises(InputError) as caught:
            graph(registry, "Any").bind({"x": object()})
        assert caught.value.name == "x"


class TestFiles:
    def test_read(self, registry: Registry, tmp_path: Path) -> None:
        """A type that can be read from a file takes its path."""
        (tmp_path / "n.txt").write_text("hello")
        assert graph(registry, "Note").run(x=tmp_path / "n.txt")["y"].text == "hello"

    def test_not_read_before_needed(self, registry: Registry, tmp_path: Path) -> None:
        """Binding hashes a file and does not decode it."""
        (tmp_path / "n.txt").write_text("hello")
        bound = graph(registry, "Note").bind({"x": str(tmp_path / "n.txt")})["x"]
        assert os.environ["GRAPHFACE_TEST_READS"] == "0"
        assert bound.value.text == bound.value.text == "hello"
        assert os.environ["GRAPHFACE_TEST_READS"] == "1"

    def test_digest_follows_content(self, registry: Registry, tmp_path: Path) -> None:
        """Its digest is that of its content, wherever it lies."""
        for name, text in (("a", "one"), ("b", "one"), ("c", "two")):
            (tmp_path / name).write_text(text)
        a, b, c = (graph(registry, "Note").bind({"x": tmp_path / n})["x"].digest for n in "abc")
        assert a == b != c

    def test_coerced(self, registry: Registry) -> None:
        """A value that the type accepts is converted."""
        assert graph(registry, "Note").run(x=["a", "b"])["y"].text == "a b"

    def test_not_coerced(self, registry: Registry) -> None:
        """One that it does not accept is refused by the input's name."""
        with pytest.raises(InputError) as caught:
            graph(registry, "Note").run(x=3)
        assert caught.value.name == "x"

    @pytest.mark.parametrize("name", ["none.txt", "", "x" * 5000])
    def test_unreadable(self, registry: Registry, tmp_path: Path, name: str) -> None:
        """A missing file, a folder, an impossible name: each is told."""
        with pytest.raises(UnreadableFile):
            graph(registry, "Note").bind({"x": str(tmp_path / name)})


class TestDefaults:
    def test_beside_the_graph(self, registry: Registry, tmp_path: Path) -> None:
        """A default file is looked for beside the graph."""
        (tmp_path / "n.txt").write_text("default")
        assert graph(registry, "{type: Note, default: n.txt}", tmp_path).run()["y"].text == "default"

    @pytest.mark.parametrize("name", ["../secret.txt", "/etc/hostname", '"a\\0b"', "x" * 5000])
    def test_outside(self, registry: Registry, tmp_path: Path, name: str) -> None:
        """A graph file cannot name a default outside its folder, nor an impossible one."""
        (tmp_path / "secret.txt").write_text("secret")
        (tmp_path / "graphs").mkdir()
        with pytest.raises(UnreadableFile):
            graph(registry, f"{{type: Note, default: {name}}}", tmp_path / "graphs").bind({})

    def test_of_an_inner_file(self, registry: Registry, tmp_path: Path) -> None:
        """The default of a used graph lies beside that graph's file."""
        (tmp_path / "sub").mkdir()
        (tmp_path / "sub" / "n.txt").write_text("inner")
        (tmp_path / "sub" / "g.yaml").write_text(
            "graphface: 1\ninputs: {x: {type: Note, default: n.txt}}\noutputs: {y: x}\n"
        )
        (tmp_path / "top.yaml").write_text("graphface: 1\nnodes: {s: {use: sub/g.yaml}}\noutputs: {y: s}\n")
        assert load(tmp_path / "top.yaml", registry=registry).run()["y"].text == "inner"


class Recipe(BaseModel):
    """A type that is a pydantic model."""

    model_config = ConfigDict(extra="forbid")

    steps: list[Annotated[int, Field(ge=0)]] = []

    @classmethod
    def coerce(cls, value: object) -> "Recipe":
        return validated(value, cls)


def read_recipe(path: Path) -> Recipe:
    os.environ["GRAPHFACE_TEST_READS"] = str(int(os.environ["GRAPHFACE_TEST_READS"]) + 1)
    return read_yaml(path, Recipe)


class TestModel:
    @pytest.fixture
    def recipes(self) -> Registry:
        registry = Registry([*toy_registry()._packs, Pack("recipes", {}, types={"Recipe": f"{__name__}:Recipe"})])
        registry.add_files(Recipe, Files(read_recipe))
        return registry

    def test_is_read_when_bound(self, recipes: Registry, tmp_path: Path) -> None:
        """A file is read once, when it is given: its mistakes are found before anything runs."""
        (tmp_path / "r.yaml").write_text("steps: [1, 2]\n")
        bound = graph(recipes, "Recipe").bind({"x": str(tmp_path / "r.yaml")})["x"]
        assert os.environ["GRAPHFACE_TEST_READS"] == "1"
        assert bound.value == Recipe(steps=[1, 2])
        assert os.environ["GRAPHFACE_TEST_READS"] == "1"
        (tmp_path / "r.yaml").write_text("steps: [1, -2]\nstep: 3\n")
        with pytest.raises(DocumentError) as caught:
            graph(recipes, "Recipe").bind({"x": str(tmp_path / "r.yaml")})
        assert len(caught.value.problems) == 2

    def test_mapping(self, recipes: Registry) -> None:
        """A mapping too, whose mistakes name the input."""
        assert graph(recipes, "Recipe").bind({"x": {"steps": [1]}})["x"].value == Recipe(steps=[1])
        with pytest.raises(InputError, match=r"'x': steps\[0\]: input should be greater"):
            graph(recipes, "Recipe").bind({"x": {"steps": [-1]}})

    def test_default(self, recipes: Registry, tmp_path: Path) -> None:
        """A default written into the graph file has places there, and the digest of the same mapping given."""
        held = graph(recipes, "{type: Recipe, default: {steps: [1]}}", tmp_path)
        assert held.bind({})["x"].value == Recipe(steps=[1])
        assert held.bind({})["x"].digest == held.bind({"x": {"steps": [1]}})["x"].digest
        with pytest.raises(DocumentError, match=r"g\.yaml:2:46: steps\[0\]"):
            graph(recipes, "{type: Recipe, default: {steps: [-1]}}", tmp_path).bind({})
