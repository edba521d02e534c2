"""Operators are found by name, in packs, in plug-in files, and beside each other in families."""

import sys
from pathlib import Path
from typing import Annotated

import numpy as np
import pytest
from numpy.typing import NDArray

from graphface import ArrayType, Files, GraphfaceWarning, Pack, Registry, node
from graphface.errors import PluginError, UnknownOperator, UnknownType
from graphface.values.port_types import ANY, ListOf, port_type

PLUGIN = '''
from graphface import Files, node

class Curve:
    pass

FILES = {Curve: Files(suffixes=(".csv",))}

@node("mine.curve")
def curve() -> Curve:
    """A class of its own, with files."""
    return Curve()

@node("mine.double")
def double(x: float) -> float:
    """Twice."""
    return 2 * x
'''


class TestOperators:
    def test_by_name(self, registry: Registry) -> None:
        """An operator is found by its name."""
        assert registry.operator("toy.add").name == "toy.add"

    def test_unknown(self, registry: Registry) -> None:
        """An unknown name is told the nearest."""
        with pytest.raises(UnknownOperator) as caught:
            registry.operator("toy.ad")
        assert caught.value.nearest[0] == "toy.add"

    def test_added_wins(self, registry: Registry) -> None:
        """A function of one's own takes the place of an installed one."""

        @node("toy.add")
        def mine(a: float) -> float:
            return a

        registry.add(mine)
        assert registry.operator("toy.add").function is mine

    def test_plain_function(self, registry: Registry) -> None:
        """A function without @node is refused."""
        with pytest.raises(TypeError, match="@node"):
            registry.add(len)

    def test_extension_leaves_the_original(self, registry: Registry) -> None:
        """What is added to an extended registry is not in the first."""

        @node("toy.new")
        def new(a: float) -> float:
            return a

        registry.extended().add(new)
        assert "toy.new" not in registry.names()


class TestOldNames:
    @pytest.fixture
    def packed(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Registry:
        """A pack of two families in modules of their own."""
        for family in ("oldhair", "oldface", "oldother"):
            (tmp_path / f"{family}.py").write_text(
                "from graphface import node\n"
                f"@node('{family}.new', formerly=('{family}.old', 'oldgone.{family}'))\n"
                "def new(a: float) -> float:\n    return a\n"
            )
        monkeypatch.syspath_prepend(tmp_path)
        families = {family: family for family in ("oldhair", "oldface", "oldother")}
        return Registry([Pack("old", families, formerly={"oldgone.oldhair": "oldhair.new"})])

    def test_same_family(self, packed: Registry) -> None:
        """Within a family the operator's own word is enough."""
        assert packed.operator("oldface.old").name == "oldface.new"

    def test_moved(self, packed: Registry) -> None:
        """An operator that moved to another family is found by its pack's word; no other family is imported."""
        sys.modules.pop("oldother", None)
        assert packed.operator("oldgone.oldhair").name == "oldhair.new"
        assert "oldother" not in sys.modules

    def test_taken_since(self, packed: Registry) -> None:
        """An operator that has the name now wins over one that had it before."""

        @node("oldgone.oldhair")
        def mine(a: float) -> float:
            return a

        packed.add(mine)
        assert packed.operator("oldgone.oldhair").function is mine

    def test_added(self, registry: Registry) -> None:
        """A function of one's own may have an old name too."""

        @node("mine.new", formerly=("mine.old", "theirs.old"))
        def mine(a: float) -> float:
            return a

        registry.add(mine)
        assert registry.operator("mine.old").function is mine
        assert registry.operator("theirs.old").function is mine

    def test_not_listed(self, packed: Registry) -> None:
        """Old names are no names to choose from."""
        assert packed.names() == ["oldface.new", "oldhair.new", "oldother.new"]


class TestAlternatives:
    def test_same_ports(self, registry: Registry) -> None:
        """Operators of a family whose ports agree may take each other's place, others may not."""
        names = {other.name for other in registry.alternatives(registry.operator("toy.add"))}
        assert "toy.subtract" in names
        assert "toy.grid" not in names
        assert "toy.add" not in names


class TestPluginFiles:
    def test_added(self, registry: Registry, tmp_path: Path) -> None:
        """A plug-in file adds its operators."""
        path = tmp_path / "plug.py"
        path.write_text(PLUGIN)
        assert registry.add_file(path) == ["mine.curve", "mine.double"]
        assert registry.operator("mine.double").function(2.0) == 4

    def test_files(self, registry: Registry, tmp_path: Path) -> None:
        """It says in FILES how its types are written."""
        path = tmp_path / "plug.py"
        path.write_text(PLUGIN)
        registry.add_file(path)
        files = registry.files(registry.operator("mine.curve").output)
        assert files is not None
        assert files.suffixes == (".csv",)

    def test_twice(self, registry: Registry, tmp_path: Path) -> None:
        """The same file may be named twice."""
        path = tmp_path / "plug.py"
        path.write_text(PLUGIN)
        registry.add_file(path)
        assert registry.add_file(path) == ["mine.curve", "mine.double"]

    @pytest.mark.parametrize("text", ["x = 1", "def f(:", "raise RuntimeError('no')", "import nonexistent_module"])
    def test_unusable(self, registry: Registry, tmp_path: Path, text: str) -> None:
        """A file that cannot be imported or declares nothing is named."""
        path = tmp_path / "plug.py"
        path.write_text(text)
        with pytest.raises(PluginError) as caught:
            registry.add_file(path)
        assert caught.value.path == path

    @pytest.mark.parametrize("name", ["none.py", "", "notes.txt"])
    def test_missing(self, registry: Registry, tmp_path: Path, name: str) -> None:
        """A file that is not there, a folder, or no Python file is named."""
        with pytest.raises(PluginError):
            registry.add_file(tmp_path / name)


class TestTypes:
    @pytest.mark.parametrize(
        "text", ["Grid", "Grid | None", "list[Grid]", "Grid | float", "list[list[Grid | None]]", "int"]
    )
    def test_round_trip(self, registry: Registry, text: str) -> None:
        """A type prints as graph files write it."""
        assert str(registry.type(text)) == text

    def test_any(self, registry: Registry) -> None:
        """`Any` takes everything, None included."""
        assert registry.type("Any").accepts(registry.type("Grid | None"))

    def test_unknown(self, registry: Registry) -> None:
        """An unknown type is told the nearest."""
        with pytest.raises(UnknownType) as caught:
            registry.type("Gird")
        assert caught.value.nearest[0] == "Grid"


class Sound:
    pass


class Loud(Sound):
    pass


_WAVE = ArrayType("Wave", "N")
Wave = Annotated[NDArray[np.float64], _WAVE]
_TONE = ArrayType("Tone", "N", parent=_WAVE)
SOUND_FILES = Files(lambda path: Sound(), lambda value, path: None, (".wav",))
WAVE_FILES = Files(lambda path: np.zeros(1), lambda value, path: None, (".txt",))


@pytest.fixture
def sounds() -> Registry:
    """A pack with two types that have files, and one that is broken: nobody should import it."""
    types = {"Sound": f"{__name__}:Sound", "Curve": f"{__name__}:Wave", "Broken": "no_such_module:Broken"}
    files = {"Sound": f"{__name__}:SOUND_FILES", "Curve": f"{__name__}:WAVE_FILES", "Broken": "no_such_module:FILES"}
    return Registry([Pack("sounds", {}, types=types, files=files)])


class TestFiles:
    def test_of_a_pack(self, sounds: Registry) -> None:
        """A type of a pack has the files that the pack names, by whatever name it goes there."""
        assert sounds.files(Sound) is SOUND_FILES
        assert sounds.files(_WAVE) is WAVE_FILES
        assert "no_such_module" not in sys.modules

    def test_of_a_port(self, sounds: Registry) -> None:
        """A port has those of its first alternative that has any."""
        assert sounds.files(port_type(float | Wave | None)) is WAVE_FILES
        assert sounds.files(ANY) is None

    @pytest.mark.parametrize("kind", [object, float, ListOf(ANY), ArrayType("Wave"), type("Sound", (), {})])
    def test_none(self, sounds: Registry, kind: object) -> None:
        """Others have none, those of the same name neither."""
        assert sounds.files(kind) is None  # type: ignore[arg-type]

    @pytest.mark.parametrize("kind", [Loud, _TONE])
    def test_inherited(self, sounds: Registry, kind: object) -> None:
        """What a type is a kind of is written alike; reading would give something less."""
        found = sounds.files(kind)  # type: ignore[arg-type]
        assert found is not None
        assert found.write is not None
        assert found.read is None

    def test_added(self, sounds: Registry) -> None:
        """A notebook adds files of its own, which win."""
        mine, other = Files(suffixes=(".flac",)), sounds.extended()
        assert other.files(Sound) is SOUND_FILES
        other.add_files(Sound, mine)
        other.add_files(Wave, mine)
        assert other.files(Sound) is other.files(_WAVE) is mine
        assert other.extended().files(Sound) is mine
        assert sounds.files(Sound) is SOUND_FILES


class TestSchemas:
    def test_of_packs(self) -> None:
        """Kinds of files that packs describe; what cannot be found is left out with a warning."""
        packs = [Pack("a", {}, schemas={"thing": "toys:Pair", "lost": "toys:Lost"}), Pack("b", {})]
        with pytest.warns(GraphfaceWarning, match="toys:Lost"):
            assert list(Registry(packs).schemas()) == ["thing"]
