"""The columns of items."""

from graphface.report.drawing.ranks import backward, ranks


class TestBackward:
    def test_circle(self) -> None:
        """One arrow of a circle goes back, and none where there is no circle."""
        assert backward(3, [(0, 1), (1, 2), (2, 0)]) == {(2, 0)}
        assert backward(3, [(0, 1), (0, 2), (1, 2)]) == set()

    def test_itself(self) -> None:
        """An arrow from an item to itself closes a circle."""
        assert backward(1, [(0, 0)]) == {(0, 0)}


class TestRanks:
    def test_longest_path(self) -> None:
        """Every item stands behind all that feed it."""
        assert ranks(4, [(0, 1), (1, 2), (0, 2), (2, 3)]) == [0, 1, 2, 3]

    def test_beside_what_it_feeds(self) -> None:
        """An item that nothing feeds stands beside the first that it feeds."""
        assert ranks(4, [(0, 1), (1, 2), (3, 2)]) == [0, 1, 2, 1]

    def test_alone(self) -> None:
        assert ranks(2, []) == [0, 0]
