"""What installed distributions and plug-in files offer; a broken one is told in a sentence, and nothing else breaks."""

import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from graphface import GraphfaceWarning, Pack, Registry, load
from graphface.errors import DocumentError, PluginError
from graphface.packs import import_file, installed_packs, types_in

MODULE = """
from dataclasses import dataclass
from typing import Annotated
import numpy as np
from numpy.typing import NDArray
from graphface import ArrayType, Files, node

Grain = Annotated[NDArray[np.float32], ArrayType("Grain", "H W")]

@dataclass(frozen=True)
class Film:
    speed: float

FILES = {Film: Files(suffixes=(".film",))}

@node("film.speed", formerly=("movie.speed",))
def speed(film: Film) -> float:
    return film.speed

@node("film.make")
def make() -> Film:
    return Film(400.0)

@node("paper.grade")
def grade(grain: Grain) -> float:
    return float(grain.max())
"""

Install = Callable[..., None]


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Install:
    """Puts a distribution where Python finds it: its entry points, and its modules by name."""
    monkeypatch.syspath_prepend(tmp_path)

    def make(name: str, entry_points: str, group: str = "graphface.nodes", **modules: str) -> None:
        folder = tmp_path / f"{name}-1.5.dist-info"
        folder.mkdir()
        (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.5\n")
        (folder / "entry_points.txt").write_text(f"[{group}]\n{entry_points}\n")
        for module, text in modules.items():
            (tmp_path / f"{module}.py").write_text(text)

    return make


def named(packs: list[Pack], name: str) -> Pack:
    return next(pack for pack in packs if pack.name == name)


class TestEntryPoints:
    def test_pack(self, install: Install) -> None:
        """An entry point may name a pack."""
        text = "from graphface import Pack\npack = Pack('cinema', operators={'film': 'cinema_ops'})\n"
        install("cinema", "cinema = cinema_pack:pack", cinema_pack=text)
        assert named(installed_packs(), "cinema").operators == {"film": "cinema_ops"}

    def test_module(self, install: Install) -> None:
        """Or a module: all its operators and types with their files, and the old names of its operators."""
        install("filmlab", "anything = filmlab_module", filmlab_module=MODULE)
        pack = named(installed_packs(), "filmlab_module")
        registry = Registry([pack])
        assert registry.names() == ["film.make", "film.speed", "paper.grade"]
        assert str(registry.type("Film | Grain")) == "Film | Grain"
        assert registry.operator("movie.speed").name == "film.speed"
        files = registry.files(registry.type("Film"))
        assert files is not None
        assert files.suffixes == (".film",)

    @pytest.mark.parametrize(
        ("value", "text", "reason"),
        [
            ("broken_a", "raise RuntimeError('no luck')\n", "RuntimeError: no luck ({folder}/broken_a.py:1)"),
            ("broken_b", "import not_there\n", "No module named 'not_there' ({folder}/broken_b.py:1)"),
            ("broken_c", "x = 1\n\ndef f(:\n", "SyntaxError: "),
            ("broken_d", "import sys\nsys.exit('bye')\n", "SystemExit: bye ({folder}/broken_d.py:2)"),
            ("broken_e:pack", "x = 1\n", "has no attribute 'pack'"),
            ("broken_f:pack", "pack = {}\n", "it is a dict, neither a Pack nor a module"),
            ("broken_g", "x = 1\n", "declares no operator"),
        ],
    )
    def test_broken(self, install: Install, tmp_path: Path, value: str, text: str, reason: str) -> None:
        """One that cannot be used is left out; the warning names distribution, entry point and reason."""
        install("ruin", f"ruined = {value}", **{value.partition(":")[0]: text})
        with pytest.warns(GraphfaceWarning) as told:
            names = [pack.name for pack in installed_packs()]
        assert "graphface" in names
        (warning,) = told
        said = str(warning.message)
        assert said.startswith(f"ruin 1.5: graphface.nodes entry 'ruined' ({value}) is left out: ")
        assert reason.format(folder=tmp_path) in said
        assert "\n" not in said

    def test_missing_module(self, install: Install) -> None:
        """So is one whose module does not exist."""
        install("ruin", "ruined = nowhere_at_all")
        with pytest.warns(GraphfaceWarning, match="No module named 'nowhere_at_all'$"):
            installed_packs()


class TestBrokenModule:
    """A pack is fine and one of its modules is not."""

    @pytest.fixture
    def registry(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Registry:
        (tmp_path / "half_good.py").write_text(MODULE)
        (tmp_path / "half_bad.py").write_text("import not_there\n")
        monkeypatch.syspath_prepend(tmp_path)
        pack = Pack(
            "half",
            operators={"film": "half_good half_bad", "lost": "half_bad"},
            types={"Film": "half_good:Film", "Lost": "half_bad:Lost", "Gone": "half_good:Gone"},
            files={"Film": "half_good:FILES", "Lost": "half_bad:FILES", "Gone": "half_good:FILES"},
            assets="half_bad:ASSETS",
            graphs="half_bad.graphs",
        )
        return Registry([pack])

    def test_others_work(self, registry: Registry) -> None:
        """Operators of its other modules work; the broken one is told once."""
        with pytest.warns(GraphfaceWarning, match="'half_bad' of an installed pack is left out: ModuleNotFound"):
            assert registry.operator("film.speed").name == "film.speed"
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert registry.names() == ["film.make", "film.speed"]

    def test_its_operators(self, registry: Registry) -> None:
        """A graph that uses an operator of the broken module says why there is none."""
        text = "graphface: 1\nnodes: {n: {use: lost.one}}\n"
        with pytest.warns(GraphfaceWarning), pytest.raises(DocumentError) as caught:
            load(text, registry=registry)
        assert "module 'half_bad' cannot be used: ModuleNotFoundError" in caught.value.problems[0].message

    def test_everything_else(self, registry: Registry) -> None:
        """Types, files to fetch and shipped graphs of the broken module are left out."""
        with pytest.warns(GraphfaceWarning, match="half_bad"):
            assert registry.assets() == []
        with pytest.warns(GraphfaceWarning, match="half_good:Gone"):
            assert [files.suffixes for files in registry.all_files()] == [(".film",)]
        with pytest.warns(GraphfaceWarning, match=r"half_bad\.graphs"):
            assert registry.graph_folders() == []


class TestForgotten:
    def test_unknown_family(self, registry: Registry) -> None:
        """An operator of a family that nobody offers: a plug-in was forgotten."""
        with pytest.raises(DocumentError) as caught:
            load("graphface: 1\nnodes: {n: {use: retouch.smooth}}\n", registry=registry)
        assert caught.value.problems[0].message == (
            "unknown operator 'retouch.smooth': no installed pack has operators of family 'retouch'; "
            "name its file with --plugin FILE or install its pack"
        )

    def test_known_family(self, registry: Registry) -> None:
        """A wrong name in a family that is there is a typing mistake."""
        with pytest.raises(DocumentError) as caught:
            load("graphface: 1\nnodes: {n: {use: toy.ad}}\n", registry=registry)
        assert caught.value.problems[0].message == "unknown operator 'toy.ad'"


class TestFile:
    def test_types(self, registry: Registry, tmp_path: Path) -> None:
        """A plug-in file gives its types too."""
        path = tmp_path / "film.py"
        path.write_text(MODULE)
        registry.add_file(path)
        text = "graphface: 1\ninputs: {f: Film}\nnodes: {n: {use: film.speed, in: {film: f}}}\noutputs: {y: n}\n"
        film = registry.operator("film.make").function()
        assert load(text, registry=registry).run(f=film)["y"] == 400
        assert "Film" in registry.type_names()

    def test_its_own(self, tmp_path: Path) -> None:
        """Classes that it only imports are no types of it."""
        path = tmp_path / "film.py"
        path.write_text(MODULE)
        assert set(types_in(import_file(path))) == {"Grain", "Film"}

    def test_again(self, tmp_path: Path) -> None:
        """A file that is what it was is the same module, so its nodes keep their keys; an edited one is another."""
        path = tmp_path / "film.py"
        path.write_text(MODULE)
        first = import_file(path)
        assert import_file(path) is first
        path.write_text(MODULE + "\n")
        assert import_file(path) is not first

    def test_line(self, tmp_path: Path) -> None:
        """A file that fails to import is told with the line at fault."""
        path = tmp_path / "bad.py"
        path.write_text("x = 1\ny = x / 0\n")
        with pytest.raises(PluginError) as caught:
            import_file(path)
        assert str(caught.value) == f"{path}: ZeroDivisionError: division by zero ({path}:2)"
