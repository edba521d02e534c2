"""`graphface plan`: every node, what would become of it, and why."""

from collections.abc import Callable
from pathlib import Path


class TestPlan:
    def test_table(self, graphface: Callable[..., object], graph: Path, plugin: list[str]) -> None:
        """Every node is told with what would become of it and why."""
        said = graphface("plan", graph, *plugin)
        assert said.code == 0
        lines = {line.split()[0]: line for line in said.out.splitlines() if line.strip()}
        assert " run " in lines["s"]
        assert "not needed for scaled" in lines["unused"]

    def test_output(self, graphface: Callable[..., object], graph: Path, plugin: list[str]) -> None:
        """`-o` asks for something else; a file behind it does not matter."""
        said = graphface("plan", graph, *plugin, "-o", "unused=x.png")
        lines = {line.split()[0]: line for line in said.out.splitlines() if line.strip()}
        assert " run " in lines["unused"]
        assert "skipped" in lines["s"]

    def test_brackets_in_a_reason(self, graphface: Callable[..., object], tmp_path: Path) -> None:
        """A rule's reason is shown as it is, brackets and all."""
        plugin = tmp_path / "plug.py"
        plugin.write_text(
            "from graphface import Lazy, node\n"
            "def rule():\n    return {'extra': 'the range is [/lo, hi] of [red]'}\n"
            "@node('mine.gate', needs=rule)\n"
            "def gate(a: float, extra: Lazy[float]) -> float:\n    '''Lies in [low, high].'''\n    return a\n"
        )
        path = tmp_path / "g.yaml"
        path.write_text(
            "graphface: 1\ninputs: {x: {type: float, default: 1}}\nnodes:\n  n: {use: mine.gate, in: {a: x}}\n"
            "  g: {use: mine.gate, in: {a: x, extra: n}}\noutputs: {y: g}\n"
        )
        said = graphface("plan", path, "--plugin", plugin)
        assert said.code == 0
        assert "the range is [/lo, hi] of [red]" in said.out
        assert "Lies in [low, high]." in graphface("nodes", "--plugin", plugin).out
