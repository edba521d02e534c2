"""Files are written whole or not at all, and read without following links."""

import os
from pathlib import Path

import pytest

from graphface.values import whole_file


class TestWrite:
    def test_round_trip(self, tmp_path: Path) -> None:
        """Buffers of any number and size come back as one; the date is the one given."""
        path = tmp_path / "f"
        whole_file.write(str(path), str(tmp_path / "f.new"), [b"one", memoryview(bytes(3 << 20)), b""], 1000.0)
        data, descriptor = whole_file.read(str(path))
        os.close(descriptor)
        assert data.tobytes() == b"one" + bytes(3 << 20)
        assert path.stat().st_mtime == 1000
        assert list(tmp_path.iterdir()) == [path]

    def test_failure_leaves_nothing(self, tmp_path: Path) -> None:
        """What was there stays; nothing unfinished is left."""
        (tmp_path / "f").write_bytes(b"before")

        def broken():
            yield b"half"
            raise OSError("full")

        with pytest.raises(OSError, match="full"):
            whole_file.write(str(tmp_path / "f"), str(tmp_path / "f.new"), broken(), 0.0)
        assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == {"f": b"before"}

    def test_never_over_an_unfinished_one(self, tmp_path: Path) -> None:
        """Another process's unfinished file is not written to."""
        (tmp_path / "f.new").write_bytes(b"theirs")
        with pytest.raises(FileExistsError):
            whole_file.write(str(tmp_path / "f"), str(tmp_path / "f.new"), [b"mine"], 0.0)


class TestLinks:
    @pytest.mark.skipif(not hasattr(os, "O_NOFOLLOW"), reason="needs O_NOFOLLOW")
    def test_refused(self, tmp_path: Path) -> None:
        """Neither a linked file nor one in a linked folder is read."""
        (tmp_path / "real").mkdir()
        (tmp_path / "real" / "f").write_bytes(b"x")
        (tmp_path / "link").symlink_to(tmp_path / "real")
        (tmp_path / "g").symlink_to(tmp_path / "real" / "f")
        for path in (tmp_path / "link" / "f", tmp_path / "g"):
            with pytest.raises(OSError, match=r"symbolic link"):
                whole_file.read(str(path))


def test_delete(tmp_path: Path) -> None:
    """Says how much was freed; 0 where there was nothing."""
    (tmp_path / "f").write_bytes(b"four")
    assert (whole_file.delete(str(tmp_path / "f")), whole_file.delete(str(tmp_path / "f"))) == (4, 0)
