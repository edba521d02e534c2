"""The order of items in columns, with few crossings."""

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from graphface.report.drawing.columns import Joint, inversions, ordered


def crossing(columns: list[list[int]], joints: list[Joint]) -> int:
    place = {item: number for column in columns for number, item in enumerate(column)}
    ends = [(place[j.source] + j.leaves, place[j.target] + j.enters) for j in joints]
    return sum((a - c) * (b - d) < 0 for (a, b), (c, d) in combinations(ends, 2))


class TestOrdered:
    def test_untangled(self) -> None:
        """Two links that cross, crossed back."""
        joints = [Joint(0, 3, 0.5, 0.5), Joint(1, 2, 0.5, 0.5)]
        found = ordered([[0, 1], [2, 3]], joints, 4)
        assert crossing(found, joints) == 0

    def test_ports(self) -> None:
        """Where links enter one item counts: what enters below is put below."""
        joints = [Joint(0, 2, 0.5, 0.9), Joint(1, 2, 0.5, 0.1)]
        assert ordered([[0, 1], [2]], joints, 3)[0] == [1, 0]

    @given(st.lists(st.tuples(st.integers(0, 5), st.integers(6, 11)), max_size=20))
    def test_no_worse(self, ends: list[tuple[int, int]]) -> None:
        """Never more crossings than in the order given, and every item once."""
        columns = [list(range(6)), list(range(6, 12))]
        joints = [Joint(a, b, 0.5, 0.5) for a, b in dict.fromkeys(ends)]
        found = ordered(columns, joints, 12)
        assert [sorted(column) for column in found] == columns
        assert crossing(found, joints) <= crossing(columns, joints)


class TestInversions:
    @given(st.lists(st.integers(0, 9)))
    def test_counted(self, values: list[float]) -> None:
        """As many as pairs in falling order."""
        assert inversions(values) == sum(a > b for a, b in combinations(values, 2))
