"""A cache deletes nothing that is not its own."""

import errno
import os
from pathlib import Path

import numpy as np
import pytest
from disk_entries import ARRAY, KEY, MIB, OTHER, entry_of

from graphface import UsageError
from graphface.cache import folder as folder_module
from graphface.cache.disk import DiskTier
from graphface.cache.folder import MARK
from graphface.cache.memory import MISSING
from graphface.values import whole_file


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

    @pytest.mark.parametrize("text", ["", "Signature: 8a477f", "\0" * 100])
    def test_a_mark_cut_short(self, tier, text):
        """A mark that a full disk or a power cut left empty is made again; what was stored is there."""
        tier.put(KEY, ARRAY, cost_seconds=0)
        whole = (tier.folder / MARK).read_text()
        (tier.folder / "history").mkdir()
        (tier.folder / MARK).write_text(text)
        again = DiskTier(tier.folder, MIB)
        assert again.contains(KEY)
        assert again.put(OTHER, ARRAY, cost_seconds=0)
        assert (tier.folder / MARK).read_text() == whole

    @pytest.mark.parametrize("text", ["", "Signature: 8a477f597d28d172789f06886806bc55\n# Somebody else's.\n"])
    def test_refuses_what_others_mark(self, tmp_path, text):
        """A mark that says nothing beside files that are not ours does not make them ours; nor does another's."""
        (tmp_path / MARK).write_text(text)
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
