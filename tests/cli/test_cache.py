"""`graphface cache`: what a cache holds, whether it is whole, and emptying it."""

from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture
def filled(graphface: Callable[..., object], graph: Path, plugin: list[str], tmp_path: Path) -> Path:
    """The cache of one run of two nodes."""
    folder = tmp_path / "cache"
    assert graphface("run", graph, *plugin, "--cache", folder, "-o", tmp_path / "s.npy").code == 0
    return folder


class TestCache:
    def test_stats(self, graphface: Callable[..., object], filled: Path) -> None:
        """Entries, bytes and the budget that is set."""
        said = graphface("cache", "stats", "--cache", filled, "--cache-size", "5MB")
        assert said.code == 0
        assert "2 entries" in said.out
        assert "of 5 MB" in said.out

    def test_verify(self, graphface: Callable[..., object], filled: Path) -> None:
        """A damaged entry is named, exit code 1; `--drop` deletes it, after which all is well."""
        assert "2 intact, 0 damaged" in graphface("cache", "verify", "--cache", filled).out
        entry = next(filled.glob("??/*"))
        entry.write_bytes(entry.read_bytes()[:-1])
        said = graphface("cache", "verify", "--cache", filled)
        assert said.code == 1
        assert f"damaged: {entry}" in said.out
        assert graphface("cache", "verify", "--cache", filled, "--drop").code == 0
        assert graphface("cache", "verify", "--cache", filled).code == 0

    def test_clear(self, graphface: Callable[..., object], filled: Path) -> None:
        """Everything goes."""
        assert "freed" in graphface("cache", "clear", "--cache", filled).out
        assert " 0 entries" in graphface("cache", "stats", "--cache", filled).out

    def test_which(self, graphface: Callable[..., object], monkeypatch: pytest.MonkeyPatch) -> None:
        """Without a folder the command asks for one."""
        monkeypatch.delenv("GRAPHFACE_CACHE", raising=False)
        said = graphface("cache", "stats")
        assert said.code == 2
        assert "--cache DIR" in said.err
