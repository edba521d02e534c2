"""`graphface new`: a commented graph to start from."""

from collections.abc import Callable
from pathlib import Path

from graphface import load


class TestNew:
    def test_loads(self, graphface: Callable[..., object], tmp_path: Path) -> None:
        """What is written is a graph of the file's name."""
        said = graphface("new", tmp_path / "mine.yaml")
        assert said.code == 0
        assert "graphface run" in said.out
        loaded = load(tmp_path / "mine.yaml")
        assert (loaded.name, list(loaded.outputs)) == ("mine", ["image"])

    def test_never_overwrites(self, graphface: Callable[..., object], tmp_path: Path) -> None:
        """A file that is there stays as it is."""
        (tmp_path / "mine.yaml").write_text("mine")
        assert graphface("new", tmp_path / "mine.yaml").code == 2
        assert (tmp_path / "mine.yaml").read_text() == "mine"

    def test_suffix(self, graphface: Callable[..., object], tmp_path: Path) -> None:
        """Another suffix is refused."""
        said = graphface("new", tmp_path / "mine.txt")
        assert said.code == 2
        assert ".yaml" in said.err
        assert not (tmp_path / "mine.txt").exists()
