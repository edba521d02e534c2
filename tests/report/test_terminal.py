"""What the command line shows: tables on standard output, warnings on standard error."""

import pytest

from graphface import Registry
from graphface.record import Record
from graphface.report.terminal import print_operator, print_operators, print_table, print_times, print_warnings


def ran(name: str, seconds: float) -> Record:
    return Record(name=name, operator="toy.add", key=name, state="ran", seconds=seconds)


class TestTables:
    def test_times(self, capsys: pytest.CaptureFixture[str]) -> None:
        """Slowest first, over several runs the sum, and a line with the total."""
        print_times([ran("quick", 0.01), ran("slow", 0.02), ran("slow", 0.02)])
        lines = [line.split() for line in capsys.readouterr().out.splitlines()]
        assert lines[1] == ["slow", "toy.add", "2", "40.0", "80%"]
        assert lines[2] == ["quick", "toy.add", "1", "10.0", "20%"]
        assert lines[3] == ["sum", "50.0"]

    def test_operators(self, registry: Registry, capsys: pytest.CaptureFixture[str]) -> None:
        """A line for each: its ports, its output, its first sentence."""
        print_operators([registry.operator("toy.pair")])
        assert {"toy.pair", "grid"} <= set(capsys.readouterr().out.split())

    def test_limits(self, registry: Registry, capsys: pytest.CaptureFixture[str]) -> None:
        """The limits of parameters stand as they are written in mathematics."""
        print_operator(registry.operator("toy.ranged"), ["toy.other"])
        out = capsys.readouterr().out
        assert ">= 1, <= 8" in out
        assert "may be replaced by: toy.other" in out

    def test_alignment(self, capsys: pytest.CaptureFixture[str]) -> None:
        """A header that begins with ">" is set to the right."""
        print_table(["a", ">b"], [["x", "1"], ["y", "1000"]])
        assert capsys.readouterr().out.splitlines()[1].endswith("   1")


def test_warnings(capsys: pytest.CaptureFixture[str]) -> None:
    """Each once, on standard error, brackets and all."""
    print_warnings(["a [/b]", "c", "a [/b]"])
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "warning: a [/b]\nwarning: c\n")
