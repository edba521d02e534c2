"""The disk tier never serves a wrong value, never deletes what is not its own, and never raises for a full disk.

`GRAPHFACE_KILLS=200 pytest tests/cache/test_disk.py -k kill` runs the long version of the kill test.
"""

import errno
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from graphface import UsageError
from graphface.cache import folder as folder_module
from graphface.cache.disk import DiskTier
from graphface.cache.folder import MARK
from graphface.cache.memory import MISSING
from graphface.nodes.types import Image
from graphface.values import whole_file

sys.path.insert(0, os.path.dirname(__file__))
import writer

KILLS = int(os.environ.get("GRAPHFACE_KILLS", "20"))
KEY = bytes(range(16))
OTHER = bytes(reversed(range(16)))
ARRAY = np.arange(300, dtype=np.float32).reshape(10, 10, 3)
MIB = 1 << 20


@pytest.fixture
def reports() -> list[str]:
    return []


@pytest.fixture
def tier(tmp_path, reports) -> DiskTier:
    return DiskTier(tmp_path / "cache", 100 * MIB, report=reports.append)


def entry_of(tier: DiskTier, key: bytes = KEY) -> Path:
    return tier.folder / key.hex()[:2] / f"{key.hex()}.safetensors"


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


class TestFolder:
    def test_another_process_may_be_marking_it(self, tmp_path, monkeypatch):
        """A folder that becomes ours between two looks at it is ours: draft of the mark, mark, then entries."""
        (tmp_path / f"{MARK}.123.456").write_text("Sig")
        DiskTier(tmp_path, MIB)
        listed = Path.iterdir

        def marked_meanwhile(folder):
            monkeypatch.setattr(Path, "iterdir", listed)
            DiskTier(tmp_path, MIB).put(KEY, ARRAY, cost_seconds=0)
            return listed(folder)

        (tmp_path / f"{MARK}.123.456").unlink()
        monkeypatch.setattr(Path, "iterdir", marked_meanwhile)
        assert DiskTier(tmp_path, MIB).contains(KEY)

    def test_refuses_a_folder_that_is_not_ours(self, tmp_path):
        """A folder with files and no mark is not taken over."""
        (tmp_path / "thesis.tex").write_text("years of work")
        with pytest.raises(UsageError, match="not a cache"):
            DiskTier(tmp_path, MIB)

    def test_refuses_a_folder_that_may_not_be_looked_into(self, tmp_path, monkeypatch):
        """That the operating system denies it is said, before anything runs."""

        def denied(folder, **_):
            raise PermissionError(errno.EACCES, "Permission denied")

        monkeypatch.setattr(Path, "exists", denied)
        with pytest.raises(UsageError, match="Permission denied"):
            DiskTier(tmp_path / "locked", MIB)

    def test_clear_refuses_without_mark(self, tier):
        """Without its mark a folder is not cleared."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        (tier.folder / MARK).unlink()
        with pytest.raises(UsageError, match="nothing was deleted"):
            tier.clear()
        assert entry_of(tier).exists()

    def test_clear_keeps_what_is_not_ours(self, tier):
        """Files with other names stay, whatever shard they lie in; `verify` lists them."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        notes = [tier.folder / "notes.txt", entry_of(tier).parent / "notes.txt"]
        for file in notes:
            file.write_text("mine")
        assert tier.verify().foreign == [notes[1]]
        assert tier.clear() > 0
        assert all(file.exists() for file in notes)
        assert not entry_of(tier).exists()

    def test_does_not_follow_links(self, tier, tmp_path):
        """Neither a linked entry nor a linked shard leads out of the folder."""
        elsewhere = tmp_path / "elsewhere"
        elsewhere.mkdir()
        tier.put(KEY, ARRAY, cost_seconds=0)
        target = elsewhere / entry_of(tier).name
        entry_of(tier).rename(target)
        entry_of(tier).symlink_to(target)
        assert tier.get(KEY, np.ndarray) is MISSING
        entry_of(tier).unlink()
        entry_of(tier).parent.rmdir()
        entry_of(tier).parent.symlink_to(elsewhere)
        assert tier.get(KEY, np.ndarray) is MISSING
        assert not tier.put(KEY, ARRAY, cost_seconds=0)
        tier.clear()
        assert target.exists()

    @pytest.mark.parametrize("code", [errno.ENOSPC, errno.EROFS, errno.EACCES, errno.EDQUOT])
    def test_unwritable(self, tier, reports, monkeypatch, code):
        """A full or read-only disk stores nothing, says so, and leaves nothing half written."""
        tier.put(OTHER, ARRAY, cost_seconds=0)

        def fail(*_: object) -> int:
            raise OSError(code, os.strerror(code))

        monkeypatch.setattr(whole_file, "_write_all", fail)
        assert not tier.put(KEY, ARRAY, cost_seconds=0)
        assert os.strerror(code) in reports[0]
        assert tier.verify().unfinished == []
        assert tier.get(OTHER, np.ndarray) is not MISSING

    def test_strays(self, tier, monkeypatch):
        """An old unfinished write is cleaned up; a young one belongs to somebody."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        stray = entry_of(tier).parent / f".{KEY.hex()}.123.4.tmp"
        stray.write_bytes(b"half")
        tier.verify(drop=True)
        assert stray.exists()
        monkeypatch.setattr(folder_module, "STRAY_AFTER_S", -1)
        tier.verify(drop=True)
        assert not stray.exists()


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
