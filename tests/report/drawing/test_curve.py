"""A wire as one line."""

from graphface.report.drawing.curve import path


def test_path() -> None:
    """Level pieces joined by curves that leave and arrive level."""
    assert path([(0, 10, 5), (30, 40, 25)]) == "M0 5H10C20 5 20 25 30 25H40"


def test_nothing() -> None:
    assert path([]) == ""


def test_turn() -> None:
    """Where a wire turns round it swings out to the right first."""
    _, _, curve = path([(0, 10, 5), (10, 0, 25)]).partition("C")
    assert float(curve.split()[0]) > 10
