"""A damaged entry is found, told, and never served."""

import os

import numpy as np
import pytest
from disk_entries import ARRAY, KEY, OTHER, entry_of
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from graphface.cache.memory import MISSING


class TestDamage:
    def test_truncation(self, tier, reports):
        """Cut at every hundredth byte, an entry is dropped, reported, and can be stored again."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        whole = entry_of(tier).read_bytes()
        for length in range(0, len(whole), 100):
            entry_of(tier).write_bytes(whole[:length])
            assert tier.get(KEY, np.ndarray) is MISSING
            assert not entry_of(tier).exists()
        assert len(reports) == len(range(0, len(whole), 100))
        tier.put(KEY, ARRAY, cost_seconds=0)
        np.testing.assert_array_equal(tier.get(KEY, np.ndarray), ARRAY)

    @settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
    @given(
        flips=st.lists(
            st.tuples(st.integers(0, 10**6), st.integers(1, 255)), min_size=1, max_size=3, unique_by=lambda f: f[0]
        )
    )
    def test_flipped_bytes(self, tier, flips):
        """No flip of bytes anywhere, header included, gives a value."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        data = bytearray(entry_of(tier).read_bytes())
        for position, bits in {place % len(data): bits for place, bits in flips}.items():
            data[position] ^= bits
        entry_of(tier).write_bytes(data)
        assert tier.get(KEY, np.ndarray) is MISSING

    def test_every_byte_of_the_header(self, tier):
        """Each single byte of the header counts."""
        tier.put(KEY, np.float32([1, 2]), cost_seconds=0)
        whole = entry_of(tier).read_bytes()
        for position in range(len(whole)):
            data = bytearray(whole)
            data[position] ^= 1
            entry_of(tier).write_bytes(data)
            assert tier.get(KEY, np.ndarray) is MISSING

    @pytest.mark.parametrize("data", [b"", b"\x89PNG", b"{}" * 500, bytes(100), b"\xff" * 1000])
    def test_foreign_content(self, tier, data):
        """Something else under an entry's name is dropped."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        entry_of(tier).write_bytes(data)
        assert tier.get(KEY, np.ndarray) is MISSING

    def test_entry_under_another_key(self, tier, reports):
        """An intact entry that was copied to another key is not served for it."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        entry_of(tier, OTHER).parent.mkdir()
        entry_of(tier, OTHER).write_bytes(entry_of(tier).read_bytes())
        assert tier.get(OTHER, np.ndarray) is MISSING
        assert "another key" in reports[0]

    def test_hash_not_installed(self, tier, reports, monkeypatch):
        """An entry whose checksum cannot be computed here is left for those who can."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        monkeypatch.setattr("graphface.values.digest._xxh3", None)
        if b"xxh3" in entry_of(tier).read_bytes():
            assert tier.get(KEY, np.ndarray) is MISSING
            assert entry_of(tier).exists()

    def test_verify(self, tier):
        """`verify` finds the damaged entry and drops it when asked to."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        tier.put(OTHER, ARRAY, cost_seconds=0)
        with open(entry_of(tier), "r+b") as file:
            file.seek(-1, os.SEEK_END)
            file.write(b"\x7f")
        found = tier.verify()
        assert [path for path, _ in found.damaged] == [entry_of(tier)]
        assert found.intact == 1
        assert entry_of(tier).exists()
        tier.verify(drop=True)
        assert not entry_of(tier).exists()
