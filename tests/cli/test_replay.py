"""`graphface replay` says whether a node still fails, in its exit code too."""

from collections.abc import Callable
from pathlib import Path

import pytest
import toys

Command = Callable[..., object]


@pytest.fixture
def saved(graphface: Command, graph: Path, plugin: list[str], tmp_path: Path) -> Path:
    said = graphface("run", graph, *plugin, "-o", f"bad={tmp_path / 'o.npz'}", "--save-failure", tmp_path / "f.zip")
    assert said.code == 1
    assert f"graphface replay {tmp_path / 'f.zip'}" in said.err
    return tmp_path / "f.zip"


class TestSaveFailure:
    def test_nothing_failed(self, graphface: Command, graph: Path, plugin: list[str], tmp_path: Path) -> None:
        """A run that works leaves no file."""
        run = ("run", graph, *plugin, "-o", tmp_path / "o.npy", "--save-failure", tmp_path / "f.zip")
        assert graphface(*run).code == 0
        assert not (tmp_path / "f.zip").exists()

    @pytest.mark.parametrize("name", ["f.tar", "g.yaml/f.zip"])
    def test_refused(self, graphface: Command, graph: Path, plugin: list[str], tmp_path: Path, name: str) -> None:
        """A place that cannot be written to is refused before anything runs."""
        assert graphface("run", graph, *plugin, "-o", tmp_path / "o.npy", "--save-failure", tmp_path / name).code == 2


class TestReplay:
    def test_alike(self, graphface: Command, saved: Path, plugin: list[str]) -> None:
        """The same code fails the same way: exit code 1, with the line that did."""
        said = graphface("replay", saved, *plugin)
        assert said.code == 1
        for words in ("a: 2", "then: ValueError: it broke", "code: the same", "fails the same way", "raise ValueError"):
            assert words in said.out

    def test_otherwise(self, graphface: Command, saved: Path, plugin: list[str]) -> None:
        """With another parameter it may fail otherwise."""
        said = graphface("replay", saved, *plugin, "--set", "message=other")
        assert (said.code, "fails otherwise: ValueError: other" in said.out) == (1, True)

    def test_works(self, graphface: Command, saved: Path, tmp_path: Path) -> None:
        """Mended code works: exit code 0, its value in words, and told to be another."""
        mended = tmp_path / "toys.py"
        mended.write_text(Path(toys.__file__).read_text().replace("raise ValueError(message)", "return a"))
        said = graphface("replay", saved, "--plugin", mended)
        assert (said.code, "works and gives 2" in said.out) == (0, True)
        assert "code: not the same as then" in said.out

    def test_pdb(self, graphface: Command, saved: Path, plugin: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
        """`--pdb` stands in the function with its arguments."""
        import io
        import sys

        monkeypatch.setattr(sys, "stdin", io.StringIO("p a * 21\nc\nq\n"))
        said = graphface("replay", saved, *plugin, "--pdb")
        assert "42" in said.out
        assert said.code == 1

    def test_refused(self, graphface: Command, saved: Path, plugin: list[str], tmp_path: Path) -> None:
        """Exit code 2 where the file is none, the operator is missing or a parameter is unknown."""
        assert graphface("replay", tmp_path / "no.zip", *plugin).code == 2
        assert graphface("replay", saved).code == 2
        assert graphface("replay", saved, *plugin, "--set", "no=1").code == 2
        assert graphface("replay", saved, *plugin, "-o", saved / "a.npz").code == 2
