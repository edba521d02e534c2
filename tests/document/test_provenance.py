"""A result carries the graph it came from; run again on the same inputs it gives the same bytes, and nothing more."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import DocumentError, UnreadableFile, load
from graphface.cli import main
from graphface.document.provenance import KEY, read_provenance
from graphface.nodes.io.image_write import write_image
from graphface.nodes.types import Image, Mask, Normals
from graphface.registry import default_registry
from graphface.values.port_types import port_type
from graphface.values.writing import write_output

GRAPH = """\
graphface: 1
name: halve
inputs: {photo: Image}
nodes:
  inner: {use: encode.yaml, in: {photo: photo}}
  small: {use: image.resize, in: {photo: inner.image}, with: {long_side: 16}}
outputs: {image: small, large: inner.image}
"""

ENCODE = """\
graphface: 1
inputs: {photo: Image}
nodes: {coded: {use: image.encode, in: {photo: photo}, with: {encoding: srgb}}}
outputs: {image: coded}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a graph, one that it uses, and a photo of noise; it is the working folder."""
    (tmp_path / "halve.yaml").write_text(GRAPH)
    (tmp_path / "encode.yaml").write_text(ENCODE)
    pixels = np.random.default_rng(0).random((48, 40, 3)).astype(np.float32)
    write_image(Image(pixels), tmp_path / "photo.png")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str]]:
    """The command line: exit code and standard error."""

    def call(*arguments: str) -> tuple[int, str]:
        with pytest.raises(SystemExit) as left:
            main(list(arguments))
        return int(left.value.code or 0), capsys.readouterr().err

    return call


def picture_with(path: Path, text: str) -> Path:
    """A picture that carries some text as its graph."""
    write_image(Image(np.zeros((4, 4, 3), np.float32)), path, text={KEY: text})
    return path


class TestCarried:
    @pytest.mark.parametrize("suffix", ["png", "jpg", "tif", "webp"])
    def test_effective(self, folder: Path, command: Any, suffix: str) -> None:
        """A result holds the effective document, flags included."""
        code, _ = command(
            "run", "halve.yaml", "-i", "photo=photo.png", "--set", "small.long_side=9", "-o", f"r.{suffix}"
        )
        assert code == 0
        graph = load("halve.yaml", set={"small.long_side": 9})
        assert read_provenance(Path(f"r.{suffix}"), default_registry()) == graph.effective(origins=False)

    @pytest.mark.parametrize("suffix", ["png", "jpg", "tif", "webp"])
    def test_rerun(self, folder: Path, command: Any, suffix: str) -> None:
        """Run from the result alone, the same input gives the same bytes."""
        command("run", "halve.yaml", "-i", "photo=photo.png", "--set", "small.long_side=9", "-o", f"first.{suffix}")
        (folder / "halve.yaml").unlink()
        (folder / "encode.yaml").unlink()
        code, _ = command("run", f"first.{suffix}", "-i", "photo=photo.png", "-o", f"second.{suffix}")
        assert code == 0
        assert (folder / f"second.{suffix}").read_bytes() == (folder / f"first.{suffix}").read_bytes()

    def test_16_bit(self, folder: Path, command: Any) -> None:
        """Also where pixels are written with 16 bits a channel."""
        from dataclasses import replace

        from graphface.nodes.types import FileFormat

        photo = Image(np.random.default_rng(1).random((20, 20, 3)).astype(np.float32))
        write_image(replace(photo, file=FileFormat(bits=16)), folder / "deep.png")
        command("run", "halve.yaml", "-i", "photo=deep.png", "-o", "first.png")
        assert command("run", "first.png", "-i", "photo=deep.png", "-o", "second.png")[0] == 0
        assert (folder / "second.png").read_bytes() == (folder / "first.png").read_bytes()

    @pytest.mark.parametrize(("declared", "shape"), [(Mask, (4, 4)), (Normals, (4, 4, 3))])
    def test_maps(self, tmp_path: Path, declared: Any, shape: tuple[int, ...]) -> None:
        """Drawings of masks, normals and the like hold it too."""
        path = tmp_path / "map.png"
        registry = default_registry()
        value, kind = np.zeros(shape, np.float32), port_type(declared)
        write_output(value, kind, path, registry.files, text={KEY: "graphface: 1\n"})
        assert read_provenance(path, registry) == "graphface: 1\n"

    def test_any_characters(self, tmp_path: Path) -> None:
        """Texts in any script come back."""
        graph = load({"graphface": 1, "doc": 'Größe "α" <&> \u2028 \U0001f600 ]]>\n'})
        for suffix in ("png", "jpg", "tif", "webp"):
            path = picture_with(tmp_path / f"a.{suffix}", graph.provenance()[KEY])
            assert load(path).composition.doc == graph.composition.doc

    def test_large(self, tmp_path: Path) -> None:
        """A graph of hundreds of nodes fits into a PNG."""
        small = {"use": "image.resize", "with": {"long_side": 9}}
        nodes = {f"n{i}": {**small, "in": {"photo": f"n{i - 1}" if i else "photo"}} for i in range(500)}
        graph = load({"graphface": 1, "inputs": {"photo": "Image"}, "nodes": nodes})
        assert len(load(picture_with(tmp_path / "a.png", graph.provenance()[KEY])).steps) == 500


class TestNotCarried:
    def test_plain_picture(self, folder: Path, command: Any) -> None:
        """A picture without a graph is refused in one line, with exit code 2."""
        code, said = command("run", "photo.png", "-i", "photo=photo.png", "-o", "out.png")
        assert code == 2
        assert said.strip() == (
            "error: photo.png: is neither a graph file (.yaml, .yml) nor a result that carries its graph"
        )

    @pytest.mark.parametrize("content", [b"", b"graphface: 1\n", b"\x89PNG\r\n\x1a\n", b"PK\x03\x04", bytes(1000)])
    def test_no_picture(self, folder: Path, command: Any, content: bytes) -> None:
        """Whatever else a file is, the answer says what was expected, and why it is not that."""
        (folder / "result.png").write_bytes(content)
        code, said = command("run", "result.png", "-o", "out.png")
        assert code == 2
        assert said.startswith("error: result.png: is neither a graph file (.yaml, .yml) nor a result")
        assert len(said.splitlines()) == 1

    def test_damaged_text(self, folder: Path, command: Any) -> None:
        """A graph cut short inside a picture has line and column."""
        picture_with(folder / "cut.png", GRAPH[: GRAPH.index("in: {photo: inner") + 20])
        code, said = command("run", "cut.png", "-o", "out.png")
        assert code == 2
        assert said.startswith("error: cut.png (its provenance):7:1: not YAML")


HOSTILE = {
    "alias bomb": "a: &a [x,x,x,x,x,x,x,x,x]\n"
    + "".join(f"{b}: &{b} [{','.join([f'*{a}'] * 9)}]\n" for a, b in zip("abcdefgh", "bcdefghi", strict=True)),
    "tag": "graphface: !!python/object/apply:os.system ['touch ran']\n",
    "parent": "graphface: 1\nnodes: {n: {use: ../../secret.yaml}}\n",
    "absolute": "graphface: 1\nnodes: {n: {use: SECRET}}\n",
    "extends": "graphface: 1\nextends: SECRET\n",
    "plugin": "graphface: 1\nnodes: {n: {use: secret.py}}\n",
    "deep": "graphface: 1\nnodes: " + "[" * 5000 + "\n",
    "input of lists": f"graphface: 1\ninputs: {{x: '{'list[' * 3000}int{']' * 3000}'}}\n",
}


class TestHostile:
    @pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
    def test_refused(self, folder: Path, command: Any, text: str, tmp_path_factory: pytest.TempPathFactory) -> None:
        """A graph inside a picture is trusted no more than a graph file: exit code 2, nothing run, nothing read."""
        secret = tmp_path_factory.mktemp("elsewhere") / "secret.yaml"
        secret.write_text("graphface: 1\nname: secret\n")
        picture_with(folder / "evil.png", text.replace("SECRET", str(secret)))
        code, said = command("run", "evil.png", "-o", "out.png")
        assert code == 2
        assert "Traceback" not in said
        assert not (folder / "ran").exists()
        assert not (folder / "out.png").exists()

    @pytest.mark.parametrize("name", ["SECRET", "../elsewhere0/secret.png", "/dev/zero", "/etc/passwd", "a\0b", "~"])
    def test_default(self, folder: Path, command: Any, name: str, tmp_path_factory: pytest.TempPathFactory) -> None:
        """A default outside the working folder and the shipped graphs is not read."""
        secret = tmp_path_factory.mktemp("elsewhere") / "secret.png"
        write_image(Image(np.ones((4, 4, 3), np.float32)), secret)
        quoted = name.replace("SECRET", str(secret)).replace("\0", "\\0")
        text = ENCODE.replace("photo: Image", f'photo: {{type: Image, default: "{quoted}"}}')
        picture_with(folder / "evil.png", text)
        code, said = command("run", "evil.png", "-o", "out.png")
        assert code == 2
        assert "no such file beside the graph" in said
        assert not (folder / "out.png").exists()

    def test_bomb(self, folder: Path) -> None:
        """A compressed text that grows without end is not believed."""
        import base64
        import json
        import zlib

        from graphface.nodes.io import image_text

        bomb = zlib.compress(json.dumps({KEY: "a" * (image_text.MAX_TEXT + 100)}).encode(), 9)
        plain = image_text.packed
        image_text.packed = lambda text: "zlib:" + base64.b64encode(bomb).decode()
        try:
            picture_with(folder / "bomb.tif", "")
        finally:
            image_text.packed = plain
        with pytest.raises(UnreadableFile, match="implausibly long"):
            load("bomb.tif")

    def test_unknown_operator(self, folder: Path) -> None:
        """A graph that needs a plug-in says which operator is unknown."""
        with pytest.raises(DocumentError, match=r"unknown operator 'mine\.blur'"):
            load(picture_with(folder / "a.png", "graphface: 1\nnodes: {n: {use: mine.blur}}\n"))
