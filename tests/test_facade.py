"""`graphface.load` and the graph that it returns."""

from pathlib import Path

import pytest

from graphface import DocumentError, Evaluator, MemoryTier, Registry, UsageError, load
from graphface.facade import shared_evaluator

TEXT = "graphface: 1\nname: sums\ninputs: {x: {type: float, default: 2}}\nnodes: {a: {use: toy.add, in: {a: x}}}\n"


class TestLoad:
    def test_choices(self, registry: Registry) -> None:
        """`set` and `replace` act as on the command line."""
        loaded = load(TEXT, registry=registry, set={"a.times": 3.0}, replace={"a": "toy.subtract"})
        assert loaded.steps[0].operator.name == "toy.subtract"

    def test_plugin(self, registry: Registry, tmp_path: Path) -> None:
        """Plug-ins of one load do not stay in the registry."""
        (tmp_path / "plug.py").write_text(
            "from graphface import node\n@node('mine.one')\ndef one() -> float:\n    return 1.0\n"
        )
        text = "graphface: 1\nnodes: {o: {use: mine.one}}\n"
        assert load(text, registry=registry, plugins=[tmp_path / "plug.py"]).run(["o"])["o"] == 1
        with pytest.raises(DocumentError):
            load(text, registry=registry)


class TestGraph:
    def test_run(self, registry: Registry) -> None:
        """On the evaluator that all graphs share, or on one that is given."""
        loaded = load(TEXT, registry=registry)
        assert loaded.run(["a"], x=3.0)["a"] == 3
        assert shared_evaluator() is shared_evaluator()

    def test_request(self, registry: Registry) -> None:
        """What `run` asks of the shared evaluator can be asked of any."""
        loaded = load(TEXT, registry=registry)
        assert Evaluator().run(loaded.request({"x": 4.0}, ["a"]))["a"] == 4

    def test_shows_itself(self, registry: Registry, tmp_path: Path) -> None:
        """In a notebook as a drawing, which `draw` writes to a file."""
        loaded = load(TEXT, registry=registry)
        assert 'data-node="a"' in loaded._repr_html_()
        loaded.draw(tmp_path / "g.html")
        assert 'data-node="a"' in (tmp_path / "g.html").read_text()


class TestResult:
    def test_report(self, registry: Registry, tmp_path: Path) -> None:
        """A result writes its run as a page, also for nodes whose values only the evaluator has."""
        from graphface.report.page.read import read_report

        evaluator = Evaluator(memory=MemoryTier())
        result = load(TEXT, registry=registry).run(["a"], evaluator=evaluator)
        result.report(tmp_path / "run.html", size=64)
        assert [entry["name"] for entry in read_report(tmp_path / "run.html")["nodes"]] == ["x", "a"]

    def test_report_refused(self, registry: Registry, tmp_path: Path) -> None:
        """A page has the suffix of one."""
        with pytest.raises(UsageError, match=r"name it \.html"):
            load(TEXT, registry=registry).run(["a"]).report(tmp_path / "run.png")
