"""What goes when there is too much: age, dear entries counting as younger."""

import time

import numpy as np

from graphface.cache.disk import DiskTier
from graphface.cache.memory import MISSING

KEY = bytes(range(16))

OTHER = bytes(reversed(range(16)))

ARRAY = np.arange(300, dtype=np.float32).reshape(10, 10, 3)

MIB = 1 << 20


class TestBudget:
    def test_is_kept(self, tmp_path, reports):
        """However much is stored, the entries stay within the budget and the newest is there."""
        tier = DiskTier(tmp_path / "cache", 20_000, report=reports.append)
        for number in range(40):
            tier.put(bytes([number]) * 16, ARRAY, cost_seconds=0)
            assert tier.stats().bytes <= 20_000
            assert tier.contains(bytes([number]) * 16)
        assert tier.stats().evicted > 0
        assert reports == []

    def test_dear_entries_stay(self, tmp_path):
        """Of two entries of one size and age, the one that took longer to compute outlives the other."""
        tier = DiskTier(tmp_path / "cache", 10_000)
        tier.put(KEY, ARRAY, cost_seconds=30)
        for number in range(40):
            tier.put(bytes([100 + number]) * 16, ARRAY, cost_seconds=0.0)
        assert tier.contains(KEY)

    def test_used_entries_stay(self, tmp_path):
        """Reading an entry makes it the last to go among equals."""
        tier = DiskTier(tmp_path / "cache", 10_000)
        tier.put(KEY, ARRAY, cost_seconds=0)
        for number in range(20):
            tier.put(bytes([100 + number]) * 16, ARRAY, cost_seconds=0)
            time.sleep(0.002)
            assert tier.get(KEY, np.ndarray) is not MISSING

    def test_too_large(self, tmp_path, reports):
        """A value larger than the whole budget is not stored, and nothing is evicted for it."""
        tier = DiskTier(tmp_path / "cache", 4_000, report=reports.append)
        tier.put(OTHER, np.ones(10), cost_seconds=0)
        assert not tier.put(KEY, np.ones(10_000), cost_seconds=0)
        assert tier.contains(OTHER)
        assert "budget" in reports[0]
