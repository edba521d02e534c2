"""`graphface explain`: why each node ran, from one command to the next."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from graphface.cli import main

PLUGIN = """\
from graphface import node

@node("mine.add")
def add(a: float, b: float = 0.0, *, plus: float = 0.0) -> float:
    return a + b + plus

@node("mine.fail")
def fail(a: float) -> float:
    raise ValueError("it [/] broke")
"""

MINE = """\
graphface: 1
name: mine
inputs: {x: float}
nodes:
  left: {use: mine.add, in: {a: x}}
  join: {use: mine.add, in: {a: left}}
  bad: {use: mine.fail, in: {a: left}}
outputs: {join: join}
"""


class TestCommand:
    @pytest.fixture
    def call(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
    ) -> Iterator[Any]:
        """`graphface explain` on the graph MINE: exit code, standard output and error."""
        (tmp_path / "mine.py").write_text(PLUGIN)
        (tmp_path / "mine.yaml").write_text(MINE)
        monkeypatch.chdir(tmp_path)

        def explain(*flags: str) -> tuple[int, str, str]:
            with pytest.raises(SystemExit) as left:
                main(["explain", "mine.yaml", "--plugin", "mine.py", "-i", "x=1", "--cache", "cache", *flags])
            said = capsys.readouterr()
            return int(left.value.code or 0), said.out, said.err

        return explain

    def test_json(self, call: Any) -> None:
        """--json prints one object a node; its reason stands there in words and in parts."""
        code, out, _ = call("--run", "--json")
        assert code == 0
        found = {entry["name"]: entry for entry in json.loads(out)}
        assert set(found["join"]) == {
            *("name", "operator", "fate", "reason", "because", "key", "milliseconds", "bytes", "warnings")
        }
        assert (found["join"]["fate"], found["join"]["reason"]) == ("ran", "first seen")
        assert (found["bad"]["fate"], found["bad"]["reason"]) == ("skipped", "not needed for join")

    def test_from_one_command_to_the_next(self, call: Any) -> None:
        """The next command knows what the last one ran."""
        call("--run")
        _, out, _ = call("--json", "--set", "left.plus=3")
        found = {entry["name"]: entry for entry in json.loads(out)}
        assert found["left"]["reason"] == "parameter plus changed from 0.0 to 3.0"
        assert found["join"]["reason"] == "left changed above it"

    def test_without_run(self, call: Any) -> None:
        """Without --run nothing is run, stored or remembered."""
        assert call()[0] == 0
        assert not Path("cache").exists()

    def test_table(self, call: Any) -> None:
        """The table has a line for each node."""
        _, out, _ = call("--run")
        assert [line.split()[0] for line in out.splitlines()] == ["node", "left", "join", "bad"]

    def test_failure(self, call: Any) -> None:
        """A failing node is in the table with its reason, brackets and all, and the exit code is 1."""
        code, out, err = call("--run", "-o", "bad")
        assert code == 1
        assert "ValueError: it [/] broke" in out
        assert err.startswith("error: ")
