"""One frame laid out."""

from graphface.report.drawing.level import PADDING, Passage, arrange
from graphface.report.drawing.nesting import BORDER


def test_in_a_row() -> None:
    """What feeds stands left of what it feeds, with the room for the title above."""
    level = arrange([(100, 40), (50, 40)], [Passage(0, 0, 1, 20, 20)], 30)
    (x0, y0), (x1, _) = level.places
    assert x0 == PADDING
    assert x1 > x0 + 100
    assert y0 == 30


def test_borders() -> None:
    """Wires come in at the left border and leave at the right one, each bundle at one height."""
    passages = [Passage(0, BORDER, 0, 0, 10), Passage(1, 0, BORDER, 10, 0), Passage(2, BORDER, BORDER, 0, 0)]
    level = arrange([(60, 20)], passages, 0)
    assert set(level.entries) == {0, 2}
    assert set(level.exits) == {1, 2}
    assert level.lanes[0][0][0] == 0
    assert level.lanes[1][-1][1] == level.width


def test_around_what_is_between() -> None:
    """A wire that skips a column passes it in a lane above or below its box."""
    passages = [Passage(0, 0, 1, 10, 10), Passage(1, 1, 2, 10, 10), Passage(0, 0, 2, 10, 15)]
    level = arrange([(50, 20)] * 3, passages, 0)
    top = level.places[1][1]
    _, lane, _ = level.lanes[2]
    assert not top <= lane[2] <= top + 20


def test_back() -> None:
    """A wire against the direction leaves to the right, runs back beside the boxes and comes in from the left."""
    level = arrange([(50, 20)] * 2, [Passage(0, 0, 1, 10, 10), Passage(1, 1, 0, 10, 10)], 0)
    assert level.back == [False, True]
    first, *between, last = level.lanes[1]
    assert first[0] <= first[1]
    assert all(x0 > x1 for x0, x1, _ in between)
    assert last[0] <= last[1]
