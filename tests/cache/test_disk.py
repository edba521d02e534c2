"""The disk tier never serves a wrong value, never deletes what is not its own, and never raises for a full disk.

`GRAPHFACE_KILLS=200 pytest tests/cache/test_disk.py -k kill` runs the long version of the kill test.
"""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from disk_entries import ARRAY, KEY, MIB, OTHER, entry_of

from graphface.cache.disk import DiskTier
from graphface.cache.memory import MISSING
from graphface.nodes.types import Image

sys.path.insert(0, os.path.dirname(__file__))

import writer

KILLS = int(os.environ.get("GRAPHFACE_KILLS", "20"))


class TestGetPut:
    def test_round_trip(self, tier):
        """A stored value comes back bit for bit, read-only."""
        image = Image(ARRAY)
        assert tier.put(KEY, image, cost_seconds=0.5)
        back = tier.get(KEY, Image)
        np.testing.assert_array_equal(back.pixels, ARRAY)
        assert back.file == image.file
        assert not back.pixels.flags.writeable

    def test_the_base_is_read_only_too(self, tier):
        """A decoded array cannot be made writable again."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        with pytest.raises(ValueError, match="WRITEABLE"):
            tier.get(KEY, np.ndarray).flags.writeable = True

    def test_missing(self, tier):
        """A key that was never stored is MISSING, and nothing is made on disk for asking."""
        assert tier.get(KEY, np.ndarray) is MISSING
        assert not tier.folder.exists()

    def test_none_is_a_value(self, tier):
        """None is not MISSING."""
        tier.put(KEY, None, cost_seconds=0)
        assert tier.get(KEY, int | None) is None

    def test_meta(self, tier):
        """What `explain` needs is read without reading the value."""
        tier.put(KEY, ARRAY, cost_seconds=0.25, meta={"operator": "sh.fit"})
        assert tier.meta(KEY)["operator"] == "sh.fit"
        assert tier.cost(KEY) == 0.25
        assert tier.meta(OTHER) is None
        assert tier.cost(OTHER) == 0

    def test_contains(self, tier):
        """`contains` says whether there is an entry."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        assert (tier.contains(KEY), tier.contains(OTHER)) == (True, False)

    def test_another_tier_reads_it(self, tier):
        """A second process finds what the first stored."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        np.testing.assert_array_equal(DiskTier(tier.folder, MIB).get(KEY, np.ndarray), ARRAY)

    def test_is_a_safetensors_file(self, tier):
        """The safetensors package reads the arrays of an entry."""
        from safetensors.numpy import load_file

        tier.put(KEY, {"a": ARRAY, "b": np.ones(3, bool), "c": np.zeros((0, 2), np.int64)}, cost_seconds=0)
        loaded = load_file(entry_of(tier))
        np.testing.assert_array_equal(loaded["0"], ARRAY)
        assert sorted((v.dtype.str, v.shape) for v in loaded.values()) == [
            ("<f4", (10, 10, 3)),
            ("<i8", (0, 2)),
            ("|b1", (3,)),
        ]

    def test_what_cannot_be_stored(self, tier, reports):
        """A value without arrays-and-JSON form is not stored, and that is said."""
        assert not tier.put(KEY, object(), cost_seconds=0)
        assert "object is not cached on disk" in reports[0]

    def test_what_could_not_be_read_back(self, tier, reports):
        """With the annotation in hand, `put` refuses what `get` would refuse."""
        assert not tier.put(KEY, ARRAY, cost_seconds=0, annotation=Image)
        assert len(reports) == 1


class TestProcesses:
    def test_kill(self, tmp_path):
        """Killed at any moment, a writer leaves entries that are right, and a cache that goes on working."""
        folder, chance = tmp_path / "cache", random.Random(7)
        reports: list[str] = []
        for round_ in range(KILLS):
            process = _writer(folder, seed=round_, budget=5 * MIB)
            assert process.stdout is not None
            process.stdout.readline()
            time.sleep(chance.random() * 0.05)
            process.send_signal(signal.SIGKILL)
            process.wait()
            assert "wrong value" not in process.stderr.read()
            _check_all(DiskTier(folder, 5 * MIB, report=reports.append))
        assert reports == []

    def test_eight_at_once(self, tmp_path):
        """Eight processes that store, read and evict in one folder see right values only."""
        folder = tmp_path / "cache"
        processes = [_writer(folder, seed, 2 * MIB, rounds=150) for seed in range(8)]
        outputs = [process.communicate() for process in processes]
        assert [process.returncode for process in processes] == [0] * 8, outputs
        assert [out for out, _ in outputs] == ["ready\n"] * 8
        assert _check_all(DiskTier(folder, 2 * MIB)) > 0
        assert DiskTier(folder, 2 * MIB).verify().damaged == []


def _writer(folder: Path, seed: int, budget: int, rounds: int = -1) -> "subprocess.Popen[str]":
    command = [sys.executable, writer.__file__, str(folder), str(seed), str(budget), str(rounds)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def _check_all(tier: DiskTier) -> int:
    """Compare every entry with what it must hold; how many there were."""
    found = [(n, tier.get(writer.key(n), np.ndarray)) for n in range(writer.KEYS)]
    present = [(n, value) for n, value in found if value is not MISSING]
    for number, value in present:
        np.testing.assert_array_equal(value, writer.value(number))
    return len(present)
