"""`graphface schema`: a JSON Schema for editors."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest


class TestSchema:
    def test_is_json(self, graphface: Callable[..., object]) -> None:
        """Without `-o` it is printed."""
        said = graphface("schema")
        assert said.code == 0
        assert json.loads(said.out)

    def test_file(self, graphface: Callable[..., object], plugin: list[str], tmp_path: Path) -> None:
        """With `-o` it is written; operators of plug-ins are in it."""
        assert graphface("schema", "-o", tmp_path / "s.json", *plugin).out == ""
        assert "toy.ranged" in (tmp_path / "s.json").read_text()

    def test_kinds(self, graphface: Callable[..., object]) -> None:
        """`--kind scene` is that of scene files; an unknown kind is a wrong request."""
        assert "directional" in graphface("schema", "--kind", "scene").out
        said = graphface("schema", "--kind", "scone")
        assert said.code == 2
        assert "scene" in said.err

    def test_folder_that_is_not_there(self, graphface: Callable[..., object], tmp_path: Path) -> None:
        """It is made."""
        assert graphface("schema", "-o", tmp_path / "none" / "s.json").code == 0
        assert (tmp_path / "none" / "s.json").is_file()


@pytest.mark.parametrize("kind", ["graph", "scene"])
def test_states_its_dialect(graphface: Callable[..., object], kind: str) -> None:
    """An editor knows by which draft to read it."""
    assert "json-schema.org" in json.loads(graphface("schema", "--kind", kind).out)["$schema"]
