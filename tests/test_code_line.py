"""The line that the author of an operator wants to see first is in a file of his own."""

import importlib
from pathlib import Path
from types import ModuleType

import pytest

from graphface.code_line import declaration_line, line_of_import, own_line

TEXT = """import statistics


def fail(values):
    return helper(values)


def helper(values):
    return statistics.mean(values)  # of nothing
"""


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> ModuleType:
    (tmp_path / "somebody_failing.py").write_text(TEXT)
    monkeypatch.syspath_prepend(tmp_path)
    return importlib.import_module("somebody_failing")


class TestOwnLine:
    def test_deepest_of_the_own_file(self, module: ModuleType) -> None:
        """Neither the caller's line nor that of the library in which the error arose."""
        with pytest.raises(Exception, match="mean requires") as caught:
            module.fail([])
        found = own_line(caught.value, module.fail)
        assert found is not None
        assert (found.line, found.function, found.text) == (9, "helper", "return statistics.mean(values)  # of nothing")
        assert str(found) == f"{found.file}:9, in helper\n    {found.text}"

    def test_error_from_elsewhere(self, module: ModuleType) -> None:
        """None where the traceback does not touch his files."""
        with pytest.raises(ZeroDivisionError) as caught:
            _ = 1 / 0
        assert own_line(caught.value, module.fail) is None


class TestImport:
    def test_line(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """The line that failed, through the machinery of imports; also of a file that is no Python."""
        (tmp_path / "somebody_importing.py").write_text("\nimport not_there_at_all\n")
        (tmp_path / "somebody_misspelling.py").write_text("x = 1\ndef (:\n")
        monkeypatch.syspath_prepend(tmp_path)
        for name, line in (("somebody_importing", 2), ("somebody_misspelling", 2)):
            with pytest.raises((ImportError, SyntaxError)) as caught:
                importlib.import_module(name)
            found = line_of_import(caught.value)
            assert found is not None
            assert (Path(found.file).name, found.line) == (f"{name}.py", line)


def test_declaration(module: ModuleType) -> None:
    """Where a function is defined; a function of C is nowhere."""
    found = declaration_line(module.helper)
    assert found is not None
    assert (found.line, found.text) == (8, "def helper(values):")
    assert declaration_line(len) is None
