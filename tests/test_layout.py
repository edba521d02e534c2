"""The tests mirror the sources: whoever looks for the tests of a module finds them under its name.

A module with logic, `graphface/cache/disk.py` or `nodes/makeup/beard.py`, has its tests in a file of the same name in
the mirrored folder: `tests/cache/test_disk.py`, `tests/nodes/makeup/test_beard.py`.
"""

import ast
from pathlib import Path

import layers
import pytest

LOGIC = 10
"""Lines of code in a function or method from which on a module counts as one with logic; docstrings aside."""

TESTED_ELSEWHERE = {
    "graphface.evaluate.task": "tests/evaluate/test_run.py",  # a record with a constructor
}
"""Modules with logic whose tests have another name, and where these are. To be made shorter, never longer."""


def longest_function(path: Path) -> int:
    """Lines of the longest function or method of a file, its signature counted and its docstring not."""
    longest = 0
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            lines = (node.end_lineno or node.lineno) - node.lineno + 1
            text = node.body[0]
            if ast.get_docstring(node, clean=False) is not None:
                lines -= (text.end_lineno or text.lineno) - text.lineno + 1
            longest = max(longest, lines)
    return longest


def test_file(name: str) -> Path:
    """Where the tests of a module belong."""
    *folders, module = name.removeprefix("graphface.").split(".")
    return layers.ROOT.joinpath("tests", *folders, f"test_{module}.py")


test_file.__test__ = False  # type: ignore[attr-defined]


def with_logic() -> list[str]:
    files = {n: p for n, p in layers.source_files().items() if p.name != "__init__.py"}
    return [name for name, path in files.items() if longest_function(path) > LOGIC]


@pytest.mark.parametrize("name", with_logic())
def test_has_tests_of_its_name(name: str) -> None:
    expected = test_file(name).relative_to(layers.ROOT)
    found = (layers.ROOT / expected).is_file()
    if name in TESTED_ELSEWHERE:
        assert not found, f"{expected} is there: take {name} off the list of exceptions"
        assert (layers.ROOT / TESTED_ELSEWHERE[name]).exists()
    else:
        assert found, f"{name} has no {expected}"


def test_exceptions_exist() -> None:
    """No exception is for a module that is gone, or has no logic any more."""
    assert set(TESTED_ELSEWHERE) <= set(with_logic())
