"""Results named after their sources do not overwrite each other."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphface import UsageError
from graphface.nodes.commands.distinct_names import check_distinct


class TestCheckDistinct:
    def test_two_of_a_name(self):
        """Both are named."""
        with pytest.raises(UsageError, match=r"a/me\.png and b/me\.jpg"):
            check_distinct([Path("a/me.png"), Path("b/me.jpg")])

    def test_others(self):
        """Any number, none too."""
        check_distinct([Path("a.png"), Path("b.png")])
        check_distinct([])
