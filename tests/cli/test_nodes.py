"""`graphface nodes`: the operators, and the reference of one."""

from collections.abc import Callable


class TestNodes:
    def test_reference(self, graphface: Callable[..., object], plugin: list[str]) -> None:
        """`nodes NAME` tells ports, parameters with their limits, and what may replace it."""
        said = graphface("nodes", "toy.ranged", *plugin)
        assert said.code == 0
        for part in ("toy.ranged", "count", ">= 1", "<= 8", "required"):
            assert part in said.out

    def test_unknown(self, graphface: Callable[..., object], plugin: list[str]) -> None:
        """An unknown operator is told the nearest."""
        said = graphface("nodes", "toy.rnged", *plugin)
        assert said.code == 2
        assert "toy.ranged" in said.err

    def test_alternatives(self, graphface: Callable[..., object], plugin: list[str]) -> None:
        """What may take its place is told."""
        assert "toy.subtract" in graphface("nodes", "toy.add", *plugin).out
