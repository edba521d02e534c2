"""What nodes were made of is remembered between runs, and never in the way."""

from pathlib import Path

import pytest
from history_lab import NODES, Lab, graph_of

from graphface.cache.disk import DiskTier
from graphface.cache.folder import MARK
from graphface.report.history import History


@pytest.fixture(params=["memory", "disk"])
def lab(request: pytest.FixtureRequest, tmp_path: Path) -> Lab:
    return Lab(tmp_path / "cache", disk=request.param == "disk")


@pytest.fixture
def disk_lab(tmp_path: Path) -> Lab:
    return Lab(tmp_path / "cache")


class TestHistory:
    def test_between_processes(self, disk_lab: Lab) -> None:
        """What one process remembers another knows."""
        disk_lab.run(graph_of(), x=1.0)
        later = Lab(disk_lab.folder)
        assert later.before(graph_of(set={"left.plus": 5}), x=1.0)["left"].reason.kind == "parameter"

    @pytest.mark.parametrize("text", ["", "{", "[]", '{"left": {"key": 1}}', "\udcff"])
    def test_unreadable(self, disk_lab: Lab, text: str) -> None:
        """A damaged history is none."""
        disk_lab.run(graph_of(), x=1.0)
        (file,) = (disk_lab.folder / "history").iterdir()
        file.write_text(text, encoding="utf-8", errors="surrogateescape")
        assert History.beside(disk_lab.folder).last("lab") == {}

    def test_nothing_stored(self, tmp_path: Path) -> None:
        """A run that stores nothing leaves no folder that the cache would take for somebody else's."""
        lab = Lab(tmp_path / "cache", budget=10)
        lab.run(graph_of(), x=1.0)
        assert not (tmp_path / "cache" / MARK).exists()
        assert DiskTier(tmp_path / "cache", 1 << 20).stats().entries == 0

    def test_names(self, disk_lab: Lab) -> None:
        """Graphs of other names never share a history, whatever characters are in them and however long they are."""
        for name in ("a b", "a_b", "../../up", "x" * 5000):
            disk_lab.run(graph_of(NODES.replace("name: lab", f"name: '{name}'")), x=1.0)
        assert len(list((disk_lab.folder / "history").iterdir())) == 4

    def test_unwritable(self, tmp_path: Path) -> None:
        """A history that cannot be written stops nothing."""
        lab = Lab(tmp_path / "cache")
        lab.run(graph_of("graphface: 1\nnodes: {n: {use: toy.number}}\n"), ["n"])
        for file in (tmp_path / "cache" / "history").iterdir():
            file.unlink()
        (tmp_path / "cache" / "history").rmdir()
        (tmp_path / "cache" / "history").write_text("a file where the folder should be")
        assert lab.run(graph_of(), x=1.0)["join"].fate == "ran"
