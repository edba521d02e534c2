"""Running variants on one cache: what is shared is computed once, and the accounts say so."""

from __future__ import annotations

import pytest
from graph_texts import CHAIN

from graphface.ablation import ablate


class TestAblate:
    def test_shared_nodes_run_once(self, registry, ran):
        """What stands before the swap is computed for the first variant only."""
        done = ablate(CHAIN, ["last=add,subtract"], [{"x": 2.0}], loading={"registry": registry})
        assert [cell.value for cell in done.cells] == [5.0, 1.0]
        assert ran.count("start") == ran.count("middle") == 1
        assert [(cell.shared, cell.nodes) for cell in done.cells] == [(0, 3), (2, 3)]

    def test_time_alone_counts_what_others_computed(self, registry):
        """A variant that found its nodes computed is charged for them all the same; what it spent is less."""
        first, second = ablate(CHAIN, ["last=add,subtract"], [{"x": 2.0}], loading={"registry": registry}).cells
        assert first.alone == first.spent
        assert second.alone > second.spent

    @pytest.mark.parametrize("swap", ["last=add,subtract", "start.plus=1,2"])
    def test_time_of_the_swapped_nodes(self, registry, swap):
        """Charged apart, whichever way they were swapped."""
        done = ablate(CHAIN, [swap], [{"x": 2.0}], loading={"registry": registry})
        assert all(0 < cell.swapped < cell.alone for cell in done.cells)

    def test_says_what_sharing_saved(self, registry):
        """In nodes and in seconds."""
        done = ablate(CHAIN, ["last=add,subtract"], [{"x": 2.0}], loading={"registry": registry})
        assert done.sharing.startswith("2 of 6 node results were shared")

    def test_every_case_has_every_variant(self, registry):
        """Cases times variants."""
        done = ablate(CHAIN, ["start.plus=0,1,2"], [{"x": 1.0}, {"x": 5.0}], loading={"registry": registry})
        assert [cell.value for cell in done.of_case(1)] == [10.0, 11.0, 12.0]
