"""Lanes of long wires on one height."""

from graphface.report.drawing.bends import Chain, unbend


def test_one_bend() -> None:
    """Stairs become one level piece that goes on from the source."""
    tops = [0.0, 10.0, 20.0, 30.0]
    chain = Chain([1, 2], (0, 5.0), (3, 0.0))
    unbend([chain], [[0], [1], [2], [3]], [20, 0, 0, 20], [[], [], [], []], tops)
    assert tops == [0, 5, 5, 30]


def test_keeps_away() -> None:
    """A box below keeps its distance: the lane passes above it, in the piece that reaches the target."""
    tops = [40.0, 30.0, 50.0, 0.0]
    chain = Chain([1], (0, 5.0), (3, 0.0))
    unbend([chain], [[0], [1, 2], [3]], [20, 0, 20, 20], [[], [9], []], tops)
    assert tops[1] == 0
    assert tops[2] == 50


def test_no_room_to_go_on() -> None:
    """Between two boxes a lane stays between them."""
    tops = [100.0, 0.0, 40.0, 60.0, 200.0]
    unbend([Chain([2], (0, 0.0), (4, 0.0))], [[0], [1, 2, 3], [4]], [9, 20, 0, 20, 9], [[], [9, 9], []], tops)
    assert 29 <= tops[2] <= 51
