"""What a user sets once: flag, environment, configuration file, default, in this order; a mistake names its source."""

from pathlib import Path

import pytest

from graphface import MemoryTier, UsageError, settings
from graphface.fallback import GraphfaceWarning
from graphface.settings import DEFAULTS, cache_size, memory_budget, parse_size


@pytest.fixture
def config(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's configuration file, in a folder of the test; no variable is set."""
    path = tmp_path / "config.toml"
    monkeypatch.setattr(settings, "config_path", lambda: path)
    monkeypatch.delenv("GRAPHFACE_MEMORY", raising=False)
    monkeypatch.delenv("GRAPHFACE_CACHE_SIZE", raising=False)
    return path


class TestSizes:
    @pytest.mark.parametrize(
        ("text", "size"),
        [
            ("0", 0),
            ("1000000", 10**6),
            ("12 B", 12),
            ("2G", 2 * 10**9),
            ("500M", 500 * 10**6),
            ("500 mb", 500 * 10**6),
            ("1.5k", 1500),
            ("2GiB", 2 << 30),
            ("1 TiB", 1 << 40),
        ],
    )
    def test_read(self, text: str, size: int) -> None:
        """A number of bytes, or with a unit: powers of 1000, with an i of 1024."""
        assert parse_size(text) == size

    @pytest.mark.parametrize("text", ["", "G", "-1G", "2X", "2 G B", "1e9", "nan", "2ib"])
    def test_refused(self, text: str) -> None:
        """Anything else is no size."""
        with pytest.raises(ValueError, match="expected a size such as 2G"):
            parse_size(text)


class TestOrder:
    def test_default(self, config: Path) -> None:
        """Where nothing is set, the defaults."""
        assert (memory_budget(), cache_size()) == (2 << 30, 10 * 10**9)

    def test_config(self, config: Path) -> None:
        """The configuration file wins over the default; it may write a number."""
        config.write_text('memory = "3G"\ncache-size = 5000\n')
        assert (memory_budget(), cache_size()) == (3 * 10**9, 5000)

    def test_environment(self, config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """The environment wins over the configuration file."""
        config.write_text('memory = "3G"\n')
        monkeypatch.setenv("GRAPHFACE_MEMORY", "4G")
        monkeypatch.setenv("GRAPHFACE_CACHE_SIZE", "1M")
        assert (memory_budget(), cache_size()) == (4 * 10**9, 10**6)

    def test_flag(self, config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A flag wins over everything."""
        monkeypatch.setenv("GRAPHFACE_MEMORY", "4G")
        assert memory_budget("5G") == 5 * 10**9

    def test_memory_tier(self, config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A memory tier that is given no budget has the user's."""
        monkeypatch.setenv("GRAPHFACE_MEMORY", "4G")
        assert MemoryTier().budget == 4 * 10**9
        assert MemoryTier(1000).budget == 1000


class TestNoHome:
    """Who has no folder of settings, or may not look into it, has the defaults."""

    def test_is_no_folder(self, config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A home that is a file."""
        monkeypatch.setattr("graphface.settings.config_path", lambda: Path("/dev/null/config.toml"))
        assert memory_budget() == DEFAULTS["memory"]

    def test_denied(self, config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """One of somebody else, with a warning."""

        def denied(path: Path, **_: object) -> str:
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(Path, "read_text", denied)
        with pytest.warns(GraphfaceWarning, match="may not be read"):
            assert memory_budget() == DEFAULTS["memory"]


class TestMistakes:
    def test_flag(self, config: Path) -> None:
        """A wrong size names the flag,"""
        with pytest.raises(UsageError, match=r"^--cache-size: expected a size .* got 'much'"):
            cache_size("much")

    def test_environment(self, config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """the variable,"""
        monkeypatch.setenv("GRAPHFACE_MEMORY", "much")
        with pytest.raises(UsageError, match=r"^GRAPHFACE_MEMORY: expected a size"):
            memory_budget()

    def test_config(self, config: Path) -> None:
        """or the file and the setting in it."""
        config.write_text('memory = "much"\n')
        with pytest.raises(UsageError) as caught:
            memory_budget()
        assert str(caught.value).startswith(f"{config}: memory: expected a size")

    def test_not_toml(self, config: Path) -> None:
        """A file that is not TOML is named with line and column."""
        config.write_text("memory: 4G\n")
        with pytest.raises(UsageError, match=r"config\.toml: .*line 1"):
            memory_budget()

    def test_unknown(self, config: Path) -> None:
        """An unknown setting is told the nearest."""
        config.write_text('memry = "4G"\n')
        with pytest.raises(UsageError, match=r"no setting 'memry' .*did you mean 'memory'"):
            memory_budget()
