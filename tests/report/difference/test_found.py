"""What a comparison found, told as a whole."""

from __future__ import annotations

from collections.abc import Callable

from graphface.report.difference.compare import Comparison
from graphface.report.difference.found import Differences
from graphface.report.difference.node import NodeDifference
from graphface.report.difference.tolerance import Tolerance

Compared = Callable[..., Comparison]


def test_told(compared: Compared) -> None:
    """The first node in full, a row for each, then how many."""
    found = compared(set={"s.by": 4}).differences()
    assert found.lines[:2] == ["first difference: s (toy.scale)", "    parameter by changed from 3.0 to 4.0"]
    assert [row[0] for row in found.rows] == ["s", "t", "m", "n"]
    assert found.summary == "4 of 6 nodes differ; 2 have the same key: nothing to compare"


def test_within_the_tolerance(compared: Compared) -> None:
    """What the tolerance let through is counted, and is no difference."""
    found = compared(set={"n.plus": 1e-3}).differences(Tolerance(0.5))
    assert found.summary.startswith("no node of 6 differs; 1 differ within the tolerance of 0.5 of the range")
    assert (found.lines, bool(found)) == ([], False)


def test_notes() -> None:
    """What fails on both sides and what could not be compared is told."""
    found = Differences(("A", "B"), [], failed_alike=[("f", "it broke")], not_compared=[("t", "no value")])
    assert found.notes == ["f: fails on both sides: it broke", "t: not compared: no value"]


def test_first_is_one_that_both_have() -> None:
    """A node of one side only is not the first difference, unless there is no other."""
    alone = NodeDifference("a", ("", "toy.add"), "only here")
    both = NodeDifference("b", ("toy.add", "toy.add"), "failed")
    assert Differences(("A", "B"), [alone, both]).first is both
    assert Differences(("A", "B"), [alone]).first is alone


def test_in_a_notebook(compared: Compared) -> None:
    """A table in which names are text."""
    hostile = NodeDifference("<script>", ("", "x"), "only here", words="<b>")
    shown = Differences(("A", "B"), [hostile])._repr_html_()
    assert "<script>" not in shown
    assert "&lt;script&gt;" in shown
    assert "<table>" not in compared().differences()._repr_html_()
