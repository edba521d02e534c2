"""pdb inside a function: what it gave or raised is told, and nothing escapes."""

import io
import sys

import pytest

from graphface.debug.stepping import step_through


def divide(a: float, b: float) -> float:
    quotient = a / b
    return quotient


@pytest.mark.parametrize(
    ("commands", "b", "said"),
    [
        ("n\np quotient * 100\nc\n", 4, ["75.0", "it gave 0.75"]),
        ("c\np b + 7\nq\n", 0, ["it raised ZeroDivisionError: division by zero", "7"]),
        ("c\n", 0, ["it raised"]),
        ("q\n", 4, ["divide()"]),
        ("", 4, ["divide()"]),
    ],
)
def test_scripted(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], commands: str, b: float, said: list[str]
) -> None:
    """Commands come from standard input; its end leaves pdb."""
    monkeypatch.setattr(sys, "stdin", io.StringIO(commands))
    step_through(divide, {"a": 3, "b": b})
    out = capsys.readouterr().out
    assert all(words in out for words in said)


@pytest.mark.parametrize("commands", ["c\n", "q\n", "n\nn\nc\n"])
def test_other_tracers(monkeypatch: pytest.MonkeyPatch, commands: str) -> None:
    """Whoever traces the process, another debugger or coverage, goes on afterwards."""
    monkeypatch.setattr(sys, "stdin", io.StringIO(commands))

    def tracer(*event: object) -> None:
        return None

    before = sys.gettrace()
    sys.settrace(tracer)
    try:
        step_through(divide, {"a": 3, "b": 4})
        after = sys.gettrace()
    finally:
        sys.settrace(before)
    assert after is tracer
