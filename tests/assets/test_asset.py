"""Assets: found by content, fetched once through pip, never used when their bytes are others."""

import hashlib
import importlib
import subprocess
import sys
import threading
import zipfile
from pathlib import Path

import pytest

from graphface import GraphfaceWarning
from graphface.assets import asset as assets
from graphface.assets import carriers
from graphface.assets.asset import Asset, AssetUnavailable, asset_path, asset_status

CONTENT = b"weights of a network\n" * 100

OTHER = b"the other file"


def declare(name: str, content: bytes) -> Asset:
    digest = hashlib.sha256(content).hexdigest()
    return Asset(name, digest, len(content), "MIT", "gf-sample==1.0", f"gf_sample/data/{name}", "For the tests.")


SAMPLE = declare("sample.bin", CONTENT)

COMPANION = declare("companion.bin", OTHER)


def build_wheel(folder: Path, members: dict[str, bytes]) -> Path:
    """The smallest wheel that pip downloads."""
    folder.mkdir(parents=True, exist_ok=True)
    info = "gf_sample-1.0.dist-info"
    wheel = folder / "gf_sample-1.0-py3-none-any.whl"
    with zipfile.ZipFile(wheel, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
        archive.writestr(f"{info}/METADATA", "Metadata-Version: 2.1\nName: gf-sample\nVersion: 1.0\n")
        archive.writestr(f"{info}/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        archive.writestr(f"{info}/RECORD", "")
    return wheel


@pytest.fixture
def index(tmp_path, cache) -> Path:
    """An index whose wheel carries both files."""
    members = {SAMPLE.member: CONTENT, COMPANION.member: OTHER, "../escape.txt": b"out of the folder"}
    build_wheel(tmp_path / "index", members)
    return tmp_path / "index"


@pytest.fixture
def no_pip(monkeypatch) -> list[str]:
    """pip that only counts how often it was asked, and fails."""
    calls: list[str] = []

    def fail(requirement: str, folder: Path) -> Path:
        calls.append(requirement)
        raise ValueError("no network")

    monkeypatch.setattr(assets, "download", fail)
    return calls


class TestLookup:
    def test_named_folder_comes_first(self, cache, no_pip, tmp_path, monkeypatch):
        """$GRAPHFACE_ASSETS wins over the cache."""
        for folder in (tmp_path / "mine", cache):
            folder.mkdir()
            (folder / SAMPLE.name).write_bytes(CONTENT)
        monkeypatch.setenv(assets.FOLDER_VARIABLE, str(tmp_path / "mine"))
        assert asset_path(SAMPLE) == tmp_path / "mine" / SAMPLE.name

    def test_cache_is_used(self, cache, no_pip):
        """A cached file is used without asking pip."""
        cache.mkdir()
        (cache / SAMPLE.name).write_bytes(CONTENT)
        assert asset_path(SAMPLE) == cache / SAMPLE.name
        assert no_pip == []

    def test_installed_distribution_is_read_in_place(self, cache, no_pip, tmp_path, monkeypatch):
        """A distribution that carries the file gives it, and its package is not imported."""
        site = tmp_path / "site"
        (site / "gf_sample/data").mkdir(parents=True)
        (site / "gf_sample/__init__.py").write_text("raise ImportError('must not be imported')")
        (site / SAMPLE.member).write_bytes(CONTENT)
        info = site / "gf_sample-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: gf-sample\nVersion: 1.0\n")
        (info / "RECORD").write_text(f"gf_sample/__init__.py,,\n{SAMPLE.member},,\n")
        monkeypatch.syspath_prepend(str(site))
        importlib.invalidate_caches()
        assert asset_path(SAMPLE) == site / SAMPLE.member
        assert asset_status(SAMPLE).place == "installed"

        def denied(path, **_):
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(Path, "is_file", denied)  # of the cache in a home that may not be entered
        assert asset_status(SAMPLE).place == "installed"

    def test_wrong_file_in_named_folder_is_passed_over(self, cache, no_pip, tmp_path, monkeypatch):
        """A file of the right name and the wrong bytes is warned about, left alone, and not used."""
        mine = tmp_path / "mine"
        for folder, content in ((mine, b"wrong"), (cache, CONTENT)):
            folder.mkdir()
            (folder / SAMPLE.name).write_bytes(content)
        monkeypatch.setenv(assets.FOLDER_VARIABLE, str(mine))
        with pytest.warns(GraphfaceWarning, match="another SHA-256"):
            assert asset_path(SAMPLE) == cache / SAMPLE.name
        assert (mine / SAMPLE.name).read_bytes() == b"wrong"

    def test_change_after_verification_is_noticed(self, cache, no_pip):
        """Verification is remembered for the file as it was, not for its name."""
        cache.mkdir()
        (cache / SAMPLE.name).write_bytes(CONTENT)
        asset_path(SAMPLE)
        (cache / SAMPLE.name).write_bytes(CONTENT + b"more")
        with pytest.warns(GraphfaceWarning):
            assert asset_status(SAMPLE).path is None

    def test_status_fetches_nothing(self, cache, no_pip):
        """Asking where a file is never reaches for the network."""
        status = asset_status(SAMPLE)
        assert (status.path, status.place, no_pip) == (None, None, [])


class TestFetch:
    def test_comes_from_the_wheel_into_the_cache(self, index, cache):
        """What pip downloads is verified and kept, with nothing else beside it."""
        assert asset_path(SAMPLE).read_bytes() == CONTENT
        assert [p.name for p in cache.iterdir()] == [SAMPLE.name]

    def test_companions_come_along(self, index, cache, monkeypatch):
        """One download brings every asset of the wheel."""
        asset_path(SAMPLE, companions=[SAMPLE, COMPANION])
        monkeypatch.setattr(assets, "download", lambda *_: pytest.fail("pip ran again"))
        assert asset_path(COMPANION).read_bytes() == OTHER

    def test_damaged_cache_entry_is_fetched_again(self, index, cache):
        """A wrong file in the cache is removed and replaced."""
        cache.mkdir()
        (cache / SAMPLE.name).write_bytes(CONTENT[:-1])
        with pytest.warns(GraphfaceWarning):
            assert asset_path(SAMPLE).read_bytes() == CONTENT

    def test_members_outside_the_folder_are_not_written(self, index, cache, tmp_path):
        """Paths inside the archive never become paths on the disk."""
        asset_path(SAMPLE)
        assert not list(tmp_path.rglob("escape.txt"))

    def test_wheel_with_other_bytes_is_refused(self, cache, tmp_path):
        """An index that serves another file under the pinned version is not believed."""
        build_wheel(tmp_path / "index", {SAMPLE.member: b"malice"})
        with pytest.raises(AssetUnavailable, match="not the pinned file"):
            asset_path(SAMPLE)
        assert not list(cache.glob("*"))

    def test_oversized_member_is_not_read_to_its_end(self, cache, tmp_path):
        """A member larger than pinned is refused after one byte too many."""
        build_wheel(tmp_path / "index", {SAMPLE.member: CONTENT + bytes(10_000_000)})
        with pytest.raises(AssetUnavailable, match="not the pinned file"):
            asset_path(SAMPLE)

    def test_wheel_without_the_file(self, cache, tmp_path):
        """A wheel that lacks the member is named."""
        build_wheel(tmp_path / "index", {"gf_sample/data/nothing.bin": b""})
        with pytest.raises(AssetUnavailable, match=r"gf_sample-1\.0.* has no gf_sample/data/sample\.bin"):
            asset_path(SAMPLE)

    def test_threads_fetch_once(self, index, cache, monkeypatch):
        """Eight threads that want the same file run pip once."""
        calls = []
        real = assets.download
        monkeypatch.setattr(assets, "download", lambda *a: calls.append(a) or real(*a))
        threads = [threading.Thread(target=asset_path, args=(SAMPLE,)) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(calls) == 1

    def test_processes_share_a_cache(self, index, cache, tmp_path):
        """Processes that fetch at the same time all end with a good file, and leave no stray ones."""
        code = (
            "import sys; sys.path.insert(0, sys.argv[1]); import graphface.assets.asset as a; from pathlib import Path;"
            "a.cache_folder = lambda: Path(sys.argv[2]);"
            f"print(a.asset_path(a.{SAMPLE!r}).read_bytes() == {CONTENT!r})"
        )
        source = str(Path(assets.__file__).parents[1])
        command = [sys.executable, "-c", code, source, str(cache)]
        running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(3)]
        assert [p.communicate()[0].strip() for p in running] == ["True"] * 3
        assert [p.name for p in cache.iterdir()] == [SAMPLE.name]


class TestUnavailable:
    def test_says_the_three_ways(self, cache, no_pip):
        """The error says how to provide the file: fetch, install, or a folder."""
        with pytest.raises(AssetUnavailable) as caught:
            asset_path(SAMPLE)
        for words in (
            "graphface assets fetch",
            "pip install --no-deps gf-sample==1.0",
            "GRAPHFACE_ASSETS",
            "no network",
        ):
            assert words in str(caught.value)
        assert caught.value.asset is SAMPLE

    def test_pip_is_not_asked_twice(self, cache, no_pip):
        """After a failure the process does not wait for pip again."""
        for _ in range(3):
            with pytest.raises(AssetUnavailable):
                asset_path(SAMPLE)
        assert no_pip == [SAMPLE.requirement]

    def test_real_pip_that_finds_nothing(self, cache, capfd):
        """pip's own last error becomes the reason, and pip prints nothing."""
        with pytest.raises(AssetUnavailable, match="No matching distribution"):
            asset_path(SAMPLE)
        assert capfd.readouterr() == ("", "")

    def test_slow_pip_is_given_up(self, cache, monkeypatch):
        """pip may not hang for ever."""
        monkeypatch.setattr(carriers, "TIMEOUT", 0.01)
        with pytest.raises(AssetUnavailable, match="took longer"):
            asset_path(SAMPLE)

    def test_cache_that_cannot_be_written(self, index, cache):
        """A cache folder that cannot be made is an answer, not a traceback."""
        cache.write_text("a file where the folder should be")
        with pytest.raises(AssetUnavailable):
            asset_path(SAMPLE)
