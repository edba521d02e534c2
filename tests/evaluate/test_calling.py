"""A failing operator is explained with its own line of code."""

import os.path
import sys
from pathlib import Path

import pytest
import toys

from graphface import Evaluator, NodeError, Registry, RunFailed, load
from graphface.evaluate.calling import reason_of

BROKEN = '''
import json
from graphface import node

@node("mine.reads")
def reads(a: float) -> float:
    """Fails in a library."""
    return helper(a)

def helper(a: float) -> float:
    return json.loads("{")  # the mistake

@node("mine.wrong")
def wrong(a: float) -> float:
    return "text"

@node("mine.strict")
def strict(a: float, b: float) -> float:
    return a
'''


def failure(registry: Registry, operator: str) -> tuple[NodeError, RunFailed]:
    text = f"graphface: 1\ninputs: {{x: float}}\nnodes: {{n: {{use: {operator}, in: {{a: x}}}}}}\noutputs: {{y: n}}\n"
    with pytest.raises(RunFailed) as caught:
        load(text, registry=registry).run(x=1.0)
    (error,) = caught.value.failures
    return error, caught.value


class TestLine:
    @pytest.fixture
    def plugged(self, registry: Registry, tmp_path: Path) -> Registry:
        path = tmp_path / "broken.py"
        path.write_text(BROKEN)
        registry.add_file(path)
        return registry

    def test_plugin_file(self, plugged: Registry, tmp_path: Path) -> None:
        """The deepest line of the operator's file is told, not that of the library which it called."""
        error, _ = failure(plugged, "mine.reads")
        assert error.code is not None
        assert (error.code.file, error.code.line, error.code.function) == (str(tmp_path / "broken.py"), 11, "helper")
        assert error.code.text == 'return json.loads("{")  # the mistake'
        assert f"{tmp_path / 'broken.py'}:11, in helper\n        return json" in str(error)

    def test_wrong_output(self, plugged: Registry) -> None:
        """An output of the wrong type is told where the operator is declared."""
        error, _ = failure(plugged, "mine.wrong")
        assert error.code is not None
        assert (error.code.line, error.code.text) == (13, '@node("mine.wrong")')

    def test_installed(self, registry: Registry) -> None:
        """So is the line of an operator that is installed."""
        error, _ = failure(registry, "toy.fail")
        assert error.code is not None
        assert os.path.samefile(error.code.file, toys.__file__)
        assert error.code.text == "raise ValueError(message)"

    def test_package(self, registry: Registry, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """In a package, a module beside the operator's counts as its own."""
        package = tmp_path / "minepack"
        package.mkdir()
        (package / "__init__.py").write_text("")
        (package / "deep.py").write_text("def divide(a):\n    return a / 0\n")
        (package / "ops.py").write_text(
            "from graphface import node\nfrom minepack.deep import divide\n"
            "@node('mine.divide')\ndef op(a: float) -> float:\n    return divide(a)\n"
        )
        monkeypatch.syspath_prepend(tmp_path)
        import minepack.ops  # type: ignore[import-not-found]

        registry.add(minepack.ops.op)
        error, _ = failure(registry, "mine.divide")
        assert error.code is not None
        assert (error.code.file, error.code.text) == (str(package / "deep.py"), "return a / 0")
        for name in ("minepack", "minepack.ops", "minepack.deep"):
            del sys.modules[name]


class TestCause:
    def test_original(self, registry: Registry) -> None:
        """The original exception is the cause of the node's failure, and of the run's."""
        error, run = failure(registry, "toy.fail")
        assert type(error.__cause__) is ValueError
        assert run.__cause__ is error.__cause__


class TestOutOfMemory:
    def test_looking_at_a_result(self, registry: Registry, monkeypatch: pytest.MonkeyPatch) -> None:
        """It can happen while a result is looked at too: the node is named, and the user told what to do."""

        def full(*_: object) -> None:
            raise MemoryError("Unable to allocate 3 GiB")

        monkeypatch.setattr("graphface.evaluate.calling.first_non_finite", full)
        graph = load("graphface: 1\nnodes: {big: {use: toy.grid}}\noutputs: {y: big}\n", registry=registry)
        with pytest.raises(RunFailed, match=r"node 'big'.*out of memory \(Unable .*GiB\); a smaller picture"):
            graph.run(evaluator=Evaluator())

    @pytest.mark.parametrize("error", [MemoryError(), ValueError("(-4:Insufficient memory) Failed to allocate")])
    def test_reason(self, error: Exception) -> None:
        """OpenCV's is one as well."""
        assert reason_of(error).startswith("out of memory")
