"""Strips: every row is worked on once, whatever the shape, and what goes wrong in one is raised."""

from __future__ import annotations

import multiprocessing
import os

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.strips import by_strips, in_parallel


class TestByStrips:
    @given(height=st.integers(0, 400), width=st.integers(0, 3000), channels=st.sampled_from([(), (3,)]))
    def test_every_row_once(self, height, width, channels):
        """No row is left out and none is done twice."""
        times = np.zeros(height, np.int32)

        def work(rows):
            times[rows] += 1

        by_strips(work, (height, width, *channels))
        assert (times == 1).all()

    def test_a_large_picture_has_several_strips(self):
        """Whatever a strip needs beside it stays small."""
        strips = []
        by_strips(strips.append, (2000, 2000, 3))
        assert len(strips) > 10

    def test_an_error_is_raised(self):
        """A failure in one strip is not lost in its thread."""

        def work(rows):
            if rows.start > 0:
                raise ValueError("here")

        with pytest.raises(ValueError, match="here"):
            by_strips(work, (1000, 1000, 3))


class TestInParallel:
    @given(count=st.integers(0, 40))
    def test_each_item_once(self, count):
        """None is left out and none is taken by two threads."""
        taken = []
        in_parallel(taken.append, range(count))
        assert sorted(taken) == list(range(count))

    def test_work_may_share_its_own_work(self):
        """To any depth: the calling thread works too, so no two threads wait for each other."""
        done = []

        def work(depth):
            if depth:
                in_parallel(work, [depth - 1] * 3)
            else:
                done.append(1)

        work(5)
        assert len(done) == 3**5

    def test_after_a_failure_it_still_works(self):
        """A failing call takes nothing of the next one with it."""

        def fail(item):
            raise ValueError(item)

        for _ in range(20):
            with pytest.raises(ValueError, match=r"\d"):
                in_parallel(fail, range(50))
            assert _count(50) == 50

    @pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
    def test_survives_a_fork(self):
        """A child of a process that has used its threads has none of them, and starts its own."""
        in_parallel(lambda item: None, range(50))
        with multiprocessing.get_context("fork").Pool(1) as pool:
            assert pool.apply_async(_count, (50,)).get(timeout=60) == 50


def _count(items):
    seen = []
    in_parallel(seen.append, range(items))
    return len(seen)
