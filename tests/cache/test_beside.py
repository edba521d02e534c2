"""Where a package lies does not count; the data files beside its code do, by their content."""

import ast
import itertools
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import graphface.nodes
from graphface.cache.beside import content, named_files, place
from graphface.cache.fingerprint import fingerprint

EARLY = "from pathlib import Path\nLUT = {lut}\ndef f():\n    return LUT\n"
LATE = "def f():\n    from beside_pack.tables import LUT\n    return LUT\n"

Digest = Callable[..., bytes]


@pytest.fixture
def digest(tmp_path, monkeypatch) -> Iterator[Digest]:
    """Installs a package whose operator uses `LUT`, an expression, in a place of its own; the operator's digest."""
    numbers = itertools.count()

    def unload() -> None:
        for name in [n for n in sys.modules if n.partition(".")[0] == "beside_pack"]:
            del sys.modules[name]

    def digest(lut: str, data: bytes = b"data", *, late: bool = False) -> bytes:
        unload()
        folder = tmp_path / ("place" * next(numbers) or "p") / "beside_pack"
        (folder / "data").mkdir(parents=True)
        (folder / "__init__.py").touch()
        (folder / "lut.bin").write_bytes(data)
        (folder / "data" / "lut.bin").write_bytes(data)
        (folder / "tables.py").write_text(EARLY.format(lut=lut))
        (folder / "op.py").write_text(LATE if late else EARLY.format(lut=lut))
        monkeypatch.syspath_prepend(folder.parent)
        return fingerprint(__import__("beside_pack.op", fromlist=["_"]).f).digest

    yield digest
    unload()


@pytest.mark.parametrize("late", [False, True], ids=["constant", "constant of a late import"])
@pytest.mark.parametrize(
    "lut",
    [
        'Path(__file__).with_name("lut.bin")',
        'Path(__file__).parent / "data" / "lut.bin"',
        'Path(__file__).resolve().parent / "lut.bin"',
    ],
)
class TestDataFile:
    def test_two_places(self, digest, lut, late):
        """Two copies of a package have one digest."""
        assert digest(lut, late=late) == digest(lut, late=late)

    def test_another_content(self, digest, lut, late):
        """A copy with another data file has another digest."""
        assert digest(lut, late=late) != digest(lut, b"other", late=late)


class TestOtherPaths:
    @pytest.mark.parametrize("lut", ["__file__", "Path(__file__).parent", '{Path(__file__): 1, "a": 2}'])
    def test_two_places(self, digest, lut):
        """The module's own file, its folder and a path as a key count by their place in the package."""
        assert digest(lut) == digest(lut)

    def test_a_path_as_text(self, digest):
        """A path spelled as text counts as a path does."""
        lut = 'str(Path(__file__).with_name("lut.bin"))'
        assert digest(lut) == digest(lut)
        assert digest(lut) != digest(lut, b"other")

    def test_another_name(self, digest):
        """A path counts even where it names nothing yet."""
        assert digest('Path(__file__).with_name("a")') != digest('Path(__file__).with_name("b")')

    def test_outside_the_package(self, digest, tmp_path):
        """A path elsewhere counts as it is written, and by its content."""
        for name in ("a", "b"):
            (tmp_path / name).write_bytes(b"same")
        before = digest(f"Path({str(tmp_path / 'a')!r})")
        assert before != digest(f"Path({str(tmp_path / 'b')!r})")
        (tmp_path / "a").write_bytes(b"changed")
        assert before != digest(f"Path({str(tmp_path / 'a')!r})")

    def test_the_shipped_operators(self, tmp_path):
        """An installation elsewhere shares results with this one: geometry, which reads shipped data, included."""
        elsewhere = tmp_path / "graphface"
        unwanted = shutil.ignore_patterns("__pycache__", ".*")
        shutil.copytree(Path(graphface.__file__).parent, elsewhere, ignore=unwanted)
        shutil.copytree(Path(graphface.nodes.__file__).parent, elsewhere / "nodes", ignore=unwanted, dirs_exist_ok=True)
        program = (
            "import graphface.nodes\n"
            "from graphface.cache.fingerprint import fingerprint\n"
            "from graphface.registry import default_registry\n"
            "operators = map(default_registry().operator, ['geometry.morphable', 'masks.geometric', 'regions.nine'])\n"
            "print(graphface.nodes.__file__, *(fingerprint(o.function, o.needs).digest.hex() for o in operators))"
        )
        run = [sys.executable, "-c", program]
        path = {"PYTHONPATH": str(tmp_path)}
        file, *there = subprocess.check_output(run, env=os.environ | path, cwd=tmp_path, text=True).split()
        _, *here = subprocess.check_output(run, cwd=tmp_path, text=True).split()
        assert Path(file).is_relative_to(elsewhere)
        assert there == here


class TestPlace:
    def test_inside(self):
        """The innermost folder is the one that counts."""
        inner = os.path.join(os.sep, "a", "b")
        assert place(os.path.join(inner, "c", "d"), [os.path.join(os.sep, "a"), inner]) == "c/d"

    def test_a_folder_of_a_longer_name(self):
        """A neighbour whose name begins alike is elsewhere."""
        assert place(os.path.join(os.sep, "ab", "c"), [os.path.join(os.sep, "a")]) is None


class TestContent:
    def test_code_counts_elsewhere(self, tmp_path):
        """A source file counts by what its code says, not by its bytes."""
        (tmp_path / "a.py").write_text("x = 1")
        assert content(tmp_path / "a.py") == b""

    def test_no_file(self, tmp_path):
        """A folder, and a path that names nothing, have no content."""
        assert content(tmp_path) == content(tmp_path / "none") == b""


class TestNamedFiles:
    def test_the_whole_expression(self):
        """Every path on the way is named, the last one among them."""
        code = ast.parse("a = Path(__file__).parent / 'data' / 'a.bin'")
        assert named_files(code, Path("m.py"))[0] == Path("data/a.bin")

    def test_what_only_running_it_would_tell(self):
        """A path made of a variable is not guessed at."""
        assert named_files(ast.parse("a = Path(folder) / 'b'"), Path("m.py")) == []
