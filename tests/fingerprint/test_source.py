"""What a file says; where its package lies does not count, the data files it names do, by their content."""

import itertools
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import graphface.nodes
from graphface.fingerprint import fingerprint
from graphface.fingerprint.source import Source

EARLY = (
    "import os.path\nfrom importlib import resources\nfrom pathlib import Path\nLUT = {lut}\ndef f():\n    return LUT\n"
)
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
        (folder / "card.txt").touch()
        (folder / "card.bin").write_bytes(data)
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
        'Path(__file__).parent.joinpath("data", "lut.bin")',
        'Path(__file__).parent.parent / "beside_pack" / "data/lut.bin"',
        'resources.files(__package__) / "lut.bin"',
        'open(os.path.join(os.path.dirname(__file__), "data", "lut.bin"), "rb").read()',
        'Path(__file__).with_name("card.txt").with_suffix(".bin")',
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

    def test_files_of_the_kernel(self, digest):
        """What the kernel shows as a file, such as the memory that is taken now, is no part of the code."""
        lut = '"/proc/self/statm"'
        assert digest(lut) == digest(lut)

    def test_outside_the_package(self, digest, tmp_path):
        """A path elsewhere counts as it is written, and by its content."""
        for name in ("a.bin", "b.bin"):
            (tmp_path / name).write_bytes(b"same")
        before = digest(f"Path({str(tmp_path / 'a.bin')!r})")
        assert before != digest(f"Path({str(tmp_path / 'b.bin')!r})")
        (tmp_path / "a.bin").write_bytes(b"changed")
        assert before != digest(f"Path({str(tmp_path / 'a.bin')!r})")

    def test_rewritten_while_the_process_runs(self, digest, tmp_path):
        """A fingerprint no longer holds when a data file it counts was written."""
        digest('Path(__file__).with_name("lut.bin")')
        module = sys.modules["beside_pack.op"]
        before = fingerprint(module.f)
        Path(module.__file__).with_name("lut.bin").write_bytes(b"written anew")
        assert before.stale()
        assert fingerprint(module.f).digest != before.digest


def _holds_no_data(path):
    """Code, and the notices of licenses."""
    return path.suffix in (".py", ".pyc") or path.name.startswith("LICENSE")


class TestShipped:
    def test_every_data_file_is_named(self):
        """No data file of the face operators is out of every fingerprint."""
        root = Path(graphface.nodes.__file__).parent
        sources = [
            Source(".".join(["graphface.nodes", *path.relative_to(root).with_suffix("").parts]), path)
            for path in root.rglob("*.py")
        ]
        named = {file for source in sources for file in source.files}
        there = {path for path in root.rglob("*.*") if path.is_file() and not _holds_no_data(path)}
        assert there <= named

    def test_the_shipped_operators(self, tmp_path):
        """An installation elsewhere shares results with this one: geometry, which reads shipped data, included."""
        elsewhere = tmp_path / "graphface"
        unwanted = shutil.ignore_patterns("__pycache__", ".*")
        shutil.copytree(Path(graphface.__file__).parent, elsewhere, ignore=unwanted)
        shutil.copytree(Path(graphface.nodes.__file__).parent, elsewhere / "nodes", ignore=unwanted, dirs_exist_ok=True)
        program = (
            "import graphface.nodes\n"
            "from graphface.fingerprint import fingerprint\n"
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


class TestSource:
    @pytest.fixture
    def read(self, tmp_path) -> Callable[[str], Source]:
        """The source of a module `pack.module` of this text."""

        def read(text: str) -> Source:
            path = tmp_path / "module.py"
            path.write_text(text)
            return Source("pack.module", path)

        return read

    @pytest.mark.parametrize(
        ("text", "bindings"),
        [
            ("a = 1", {"a": ("literal", 1)}),
            ("a: int = 1", {"a": ("literal", 1)}),
            ("a: int", {}),
            ("a = 1\na += 1", {"a": None}),
            ("if x:\n    a = 1\nelse:\n    a = 2", {"a": None}),
            ("a, b = 1, 2", {"a": None, "b": None}),
            ("a = f()", {"a": None}),
            ("import a.b", {"a": ("import", ("a", None))}),
            ("import a.b as c", {"c": ("import", ("a.b", None))}),
            ("from .a import b as c", {"c": ("import", ("pack.a", "b"))}),
            ("try:\n    import a\nexcept ImportError:\n    a = None", {"a": None}),
            ("def f(x):\n    y = 1\n    import z", {"f": ("def", False)}),
            ("@property\ndef f(): pass\n@f.setter\ndef f(): pass", {"f": ("def", True)}),
            (
                "class C:\n    a = 1\n    def f(self): pass",
                {"C": ("def", False), "C.a": ("literal", 1), "C.f": ("def", False)},
            ),
        ],
    )
    def test_pins(self, read, text, bindings):
        """What a name is, as far as one statement says it."""
        assert {
            name: binding
            for name, binding in read(text).bindings.items()
            if name not in bindings or binding != bindings[name]
        } == {}
        assert read(text).bindings.keys() == bindings.keys()

    def test_imports(self, read):
        """Those inside functions count, those for type checkers do not."""
        text = (
            "from typing import TYPE_CHECKING\nimport typing\nimport json.decoder\n"
            "if TYPE_CHECKING:\n    import csv\nelse:\n    import wave\n"
            "if typing.TYPE_CHECKING:\n    import ast\n"
            "class C:\n    def f(self):\n        with self:\n            import numpy as np\n"
        )
        assert set(read(text).imports) == {"typing", "json.decoder", "wave", "numpy"}

    @pytest.mark.parametrize(
        ("text", "effects"),
        [
            (
                '"""Words."""\nimport a\nfrom b import c\n__all__ = ["c"]\ndef f(): pass\nclass C: pass\nx: int = 1',
                False,
            ),
            ("", False),
            ("import a\na.b()", True),
            ("try:\n    import a\nexcept ImportError:\n    pass", True),
        ],
    )
    def test_effects(self, read, text, effects):
        """Whether importing a module does more than define names."""
        assert read(text).has_effects is effects

    def test_not_python(self, read):
        """A file that does not parse counts by its bytes."""
        assert read("x = (").digest != read("x = ((").digest
        assert read("x = (").codes == {}
        assert read("# a remark").digest == read("").digest
