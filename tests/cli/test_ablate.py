"""`graphface ablate` writes a table, a sheet and a page, and answers mistakes in a sentence."""

import csv
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., object]


@pytest.fixture
def ablate(graphface: Callable[..., object], graph: Path, plugin: list[str], tmp_path: Path) -> Run:
    return lambda *arguments: graphface("ablate", graph, *plugin, "-o", tmp_path / "out", *arguments)


class TestWriting:
    def test_everything_is_written(self, ablate: Run, tmp_path: Path) -> None:
        """A line for each value of a parameter, in a table, a sheet and a page."""
        said = ablate("--swap", "s.by=1,2,3")
        assert said.code == 0
        assert "node results were shared between variants" in said.out
        with (tmp_path / "out" / "table.csv").open(encoding="utf-8") as file:
            assert [row["variant"] for row in csv.DictReader(file)] == ["s.by=1", "s.by=2", "s.by=3"]
        assert {p.name for p in (tmp_path / "out").iterdir()} == {"table.csv", "table.md", "sheet.png", "index.html"}

    def test_profiles_can_be_swapped(self, ablate: Run) -> None:
        """What accuracy costs in time, profile by profile."""
        assert "profile=draft" in ablate("--swap", "profile=draft").out

    def test_several_cases(self, ablate: Run, tmp_path: Path) -> None:
        """An input given twice makes two cases, and the table the mean of them."""
        assert ablate("--swap", "unused.plus=1,2", "--output", "unused", "-i", "x=1", "-i", "x=5").code == 0
        with (tmp_path / "out" / "table.csv").open(encoding="utf-8") as file:
            assert [row["shared nodes"] for row in csv.DictReader(file)] == ["0 of 2", "0 of 2"]


class TestMistakes:
    @pytest.mark.parametrize(
        ("arguments", "said"),
        [
            (["--swap", "t.by=1"], "no node 't'"),
            (["--swap", "s=toy.mean"], "cannot take the place"),
            (["--swap", "s.by=1", "--crop", "1,2"], "expected X,Y,WIDTH,HEIGHT"),
            (["--swap", "s.by=1", "--truth", "nowhere"], "cannot be read from a file"),
            (["--swap", "s.by=1", "-i", "x=1", "-i", "x=2", "-i", "y=1", "-i", "y=2", "-i", "y=3"], "unequally often"),
        ],
    )
    def test_are_answered_in_a_sentence(self, ablate: Run, arguments: list[str], said: str) -> None:
        """Exit code 2 and what was expected."""
        answer = ablate(*arguments)
        assert answer.code == 2
        assert said in answer.err
