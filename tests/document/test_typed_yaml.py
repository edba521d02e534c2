"""YAML files and mappings as pydantic models: what a pack needs for file types of its own."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import BaseModel, ConfigDict

from graphface import DocumentError, UnreadableFile, read_yaml, validated
from graphface.document.located import parse
from graphface.document.typed_yaml import MAX_BYTES
from graphface.place import Source


class Palette(BaseModel):
    model_config = ConfigDict(extra="forbid")

    name: str
    colors: list[tuple[int, int, int]] = []


def refusal(path: Path) -> str:
    with pytest.raises(DocumentError) as caught:
        read_yaml(path, Palette)
    return str(caught.value)


class TestReadYaml:
    def test_content(self, tmp_path: Path) -> None:
        """A file is read as the model, by YAML 1.2."""
        (tmp_path / "p.yaml").write_text("name: on\ncolors: [[1, 2, 3]]\n")
        assert read_yaml(tmp_path / "p.yaml", Palette) == Palette(name="on", colors=[(1, 2, 3)])
        assert read_yaml(str(tmp_path / "p.yaml"), Palette).name == "on"

    def test_all_mistakes(self, tmp_path: Path) -> None:
        """Twice the same key, an unknown one, a wrong value: all at once, as compilers write them."""
        path = tmp_path / "p.yaml"
        path.write_text("name: a\nname: b\ncolours: []\ncolors: [[1, 2, x]]\n")
        assert refusal(path) == (
            f"{path}:2:1: 'name' stands twice; the first is at line 1\n    name: b\n    ^\n"
            f"{path}:3:1: Palette has no entry 'colours' (it has name, colors); did you mean 'colors'?\n"
            "    colours: []\n    ^\n"
            f"{path}:4:17: colors[0][2]: input should be a whole number, got 'x'\n"
            "    colors: [[1, 2, x]]\n                    ^"
        )

    def test_empty(self, tmp_path: Path) -> None:
        """An empty file lacks everything."""
        (tmp_path / "p.yaml").write_text("")
        assert refusal(tmp_path / "p.yaml").endswith(
            "p.yaml:1:1: Palette: input should be a mapping with name, colors, got nothing"
        )

    def test_not_yaml(self, tmp_path: Path) -> None:
        """A syntax error is one mistake."""
        (tmp_path / "p.yaml").write_text("name: [1\n")
        assert "p.yaml:2:1: not YAML" in refusal(tmp_path / "p.yaml")

    def test_unreadable(self, tmp_path: Path) -> None:
        """What is no text, too much text, or not there is refused as a file."""
        (tmp_path / "a").write_bytes(b"\xff")
        (tmp_path / "b").write_bytes(b"#" * (MAX_BYTES + 1))
        for name in ("a", "b", "c"):
            with pytest.raises(UnreadableFile, match=name):
                read_yaml(tmp_path / name, Palette)


class TestValidated:
    def test_mapping(self) -> None:
        """A mapping becomes the model, and a model stays as it is."""
        palette = validated({"name": "a", "colors": [[1, 2, 3]]}, Palette)
        assert palette.colors == [(1, 2, 3)]
        assert validated(palette, Palette) is palette

    @pytest.mark.parametrize("value", [3, None, "name", [1], {"name": 3}, {}])
    def test_refused(self, value: object) -> None:
        """Anything else is told what is wrong, by the keys that lead there."""
        with pytest.raises(DocumentError) as caught:
            validated(value, Palette)
        assert [problem.place for problem in caught.value.problems] == [None]

    def test_part_of_a_file(self) -> None:
        """A mapping that knows its places shows them."""
        tree, _ = parse(Source("g.yaml", "inside: {name: 3}"))
        with pytest.raises(DocumentError, match=r"g\.yaml:1:16: name"):
            validated(tree["inside"], Palette)
