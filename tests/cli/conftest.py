"""The command line called in this process, and as a process of its own."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
import toys

from graphface.cli import main


@dataclass
class Said:
    """What a command answered."""

    code: int
    out: str
    err: str


Command = Callable[..., Said]
PLUGIN = toys.__file__

GRAPH = """graphface: 1
name: toys
inputs: {x: {type: float, default: 2}}
nodes:
  g: {use: toy.grid}
  s: {use: toy.scale, in: {grid: g}, with: {by: 3}}
  unused: {use: toy.add, in: {a: x}}
  bad: {use: toy.fail, in: {a: x}}
  nan: {use: toy.poison, in: {grid: g}}
outputs: {scaled: s}
profiles: {draft: {g: {size: 2}}}
"""


@pytest.fixture
def graphface(capsys: pytest.CaptureFixture[str]) -> Command:
    """Runs `graphface ...` and tells exit code and output; a traceback fails the test."""

    def command(*arguments: object) -> Said:
        with pytest.raises(SystemExit) as left:
            main([str(a) for a in arguments])
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return Said(int(left.value.code or 0), out, err)

    return command


@pytest.fixture
def process() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs Python with a program text in a process of its own."""
    return lambda text: subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=60)


@pytest.fixture
def graph(tmp_path: Path) -> Path:
    path = tmp_path / "g.yaml"
    path.write_text(GRAPH)
    return path


@pytest.fixture
def plugin() -> list[str]:
    return ["--plugin", PLUGIN]
