"""A saved failure is run again alone; a file that is damaged or made by somebody else is an error and nothing more."""

import io
import json
import random
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pytest
from pydantic import Field

from graphface import Evaluator, Registry, RunFailed, UnreadableFile, UsageError, load, node
from graphface.errors import UnknownOperator
from graphface.report import replay
from graphface.report.failure import MANIFEST, FirstFailure, write_failure
from graphface.report.replay import Failure, load_failure

TEXT = """graphface: 1
inputs: {x: {type: float, default: 1}}
nodes:
  g: {use: toy.grid, with: {size: 3}}
  p: {use: toy.pair, in: {grid: g}}
  nan: {use: toy.poison, in: {grid: p.low}, with: {row: 2}}
  bad: {use: toy.fail, in: {a: x}}
  wrong: {use: toy.wrong, in: {a: x}}
  odd: {use: odd.take, in: {pair: p, values: [x, x]}, with: {mode: [1, 2], least: 0.5, where: here}}
"""
Save = Callable[[str], Path]


@node("odd.take")
def take(
    pair: Any,
    values: list[float],
    *,
    mode: list[int],
    least: Annotated[float, Field(ge=0)],
    where: Path = Path("there"),
) -> float:
    raise RuntimeError(f"{sum(values)} {mode} {least}")


@pytest.fixture
def registry(registry: Registry) -> Registry:
    registry.add(take)
    return registry


@pytest.fixture
def save(registry: Registry, tmp_path: Path) -> Save:
    """Runs a node that fails, and saves it."""

    def saved(name: str) -> Path:
        first = FirstFailure()
        with pytest.raises(RunFailed):
            Evaluator().run(load(TEXT, registry=registry).request({}, [name]), [first])
        assert first.failed is not None
        write_failure(first.failed, tmp_path / f"{name}.zip")
        return tmp_path / f"{name}.zip"

    return saved


def edited(path: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    """The same file with another manifest."""
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    manifest = json.loads(members[MANIFEST])
    change(manifest)
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in {**members, MANIFEST: json.dumps(manifest).encode()}.items():
            archive.writestr(name, data)
    return path


class TestRuns:
    @pytest.mark.parametrize("name", ["nan", "bad", "wrong"])
    def test_fails_alike(self, save: Save, registry: Registry, name: str) -> None:
        """Alone, a node fails with the same words as in its run, by the same code."""
        failure = load_failure(save(name), registry)
        assert failure.run().reason == failure.about.error
        assert failure.code_changes() is None

    def test_arguments(self, save: Save, registry: Registry) -> None:
        """What it was given comes back as it was, and read-only."""
        grid = load_failure(save("nan"), registry).arguments["grid"]
        np.testing.assert_array_equal(grid, np.ones((3, 3)))
        assert not grid.flags.writeable

    def test_changes(self, save: Save, registry: Registry) -> None:
        """A parameter may be set otherwise; it is checked."""
        failure = load_failure(save("bad"), registry)
        assert failure.run({"message": "another"}).reason == "ValueError: another"
        with pytest.raises(UsageError, match="did you mean 'message'"):
            failure.run({"mesage": "another"})
        with pytest.raises(UsageError, match=r"'message'.*got"):
            failure.run({"message": 3})

    def test_works(self, save: Save, registry: Registry) -> None:
        """Where the operator was mended it works, and the code is said to be another."""
        path = save("bad")

        @node("toy.fail")
        def mended(a: float, *, message: str = "", label: str = "") -> float:
            return a

        registry.add(mended)
        failure = load_failure(path, registry)
        assert failure.run().value == 1
        assert failure.code_changes() is not None

    def test_unknown_operator(self, save: Save) -> None:
        """An operator that is not installed is told by name."""
        with pytest.raises(UnknownOperator, match=r"toy\.fail"):
            load_failure(save("bad"), Registry([])).run()


class TestPaths:
    def test_never_opened(self, save: Save, registry: Registry) -> None:
        """A path in the file is of another machine: the user says which one is meant here."""
        failure = load_failure(save("odd"), registry)
        with pytest.raises(UnreadableFile, match=r"'where'.*--set where=FILE"):
            failure.parameters()

    def test_given_here(self, save: Save, registry: Registry) -> None:
        """With it set, the node runs with all else as it was."""

        def drop_pair(manifest: dict[str, Any]) -> None:
            manifest["inputs"]["pair"] = 3  # its port takes anything, so no class is known for what was stored

        failure = load_failure(edited(save("odd"), drop_pair), registry)
        assert failure.run({"where": "x"}).reason == "RuntimeError: 2 [1, 2] 0.5"

    def test_unnamed_class(self, save: Save, registry: Registry) -> None:
        """A class that no annotation names is not built."""
        with pytest.raises(UnreadableFile, match="'pair'"):
            _ = load_failure(save("odd"), registry).arguments


class TestDamaged:
    def test_any_byte(self, save: Save, registry: Registry, tmp_path: Path) -> None:
        """Whatever is changed or cut off, the file is refused, or read as what it says."""
        whole = save("nan").read_bytes()
        chance = random.Random(3)
        for _ in range(300):
            data = bytearray(whole[: chance.choice([len(whole), chance.randrange(len(whole))])])
            for _ in range(chance.randrange(3)):
                if data:
                    data[chance.randrange(len(data))] = chance.randrange(256)
            (tmp_path / "d.zip").write_bytes(data)
            try:
                _ = load_failure(tmp_path / "d.zip", registry).run()
            except (UsageError, UnreadableFile):
                continue

    @pytest.mark.parametrize(
        "change",
        [
            lambda m: m.update(format="graphface-failure/9"),
            lambda m: m.pop("node"),
            lambda m: m.update(inputs=[1]),
            lambda m: m.update(version="1"),
            lambda m: m.clear(),
        ],
    )
    def test_manifest(self, save: Save, registry: Registry, change: Any) -> None:
        """A manifest of another form is refused."""
        with pytest.raises(UnreadableFile, match="no saved failure"):
            load_failure(edited(save("bad"), change), registry)

    @pytest.mark.parametrize(
        "stored",
        [{"array": "7"}, {"array": 0}, {"record": "os.system", "fields": {}}, {"nothing": 1}, "text", {}, [[]]],
    )
    def test_structure(self, save: Save, registry: Registry, stored: Any) -> None:
        """A value that the port does not take is refused by the name of the port."""
        failure = load_failure(edited(save("nan"), lambda m: m["inputs"].update(grid=stored)), registry)
        with pytest.raises(UnreadableFile, match="'grid'"):
            failure.run()

    def test_foreign(self, registry: Registry, tmp_path: Path) -> None:
        """Other files, and none at all."""
        with zipfile.ZipFile(tmp_path / "other.zip", "w") as archive:
            archive.writestr("../../evil.npy", b"x")
        (tmp_path / "text.zip").write_text("nothing")
        for name in ("other.zip", "text.zip", "absent.zip", "."):
            with pytest.raises(UnreadableFile):
                load_failure(tmp_path / name, registry)


class TestBounds:
    def with_array(self, path: Path, data: bytes) -> Path:
        with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("inputs/5.npy", data)
        return path

    def header(self, shape: tuple[int, ...], dtype: str = "<f8") -> bytes:
        held = io.BytesIO()
        np.lib.format.write_array_header_1_0(held, {"descr": dtype, "fortran_order": False, "shape": shape})
        return held.getvalue()

    @pytest.mark.parametrize(
        "data",
        [
            pytest.param(((1 << 40,), b""), id="claims more than allowed"),
            pytest.param(((-1,), b""), id="negative"),
            pytest.param(((4,), bytes(8)), id="cut off"),
            pytest.param(((1,), bytes(1000)), id="longer than it says"),
        ],
    )
    def test_claims(self, save: Save, registry: Registry, data: tuple[tuple[int, ...], bytes]) -> None:
        """What the header claims is checked before memory is taken."""
        with pytest.raises(UnreadableFile):
            load_failure(self.with_array(save("bad"), self.header(data[0]) + data[1]), registry)

    def test_bomb(self, save: Save, registry: Registry, monkeypatch: pytest.MonkeyPatch) -> None:
        """What unpacks to more than is allowed is not unpacked."""
        monkeypatch.setattr(replay, "MAX_BYTES", 1 << 20)
        path = self.with_array(save("bad"), self.header((1 << 20,)) + bytes(8 << 20))
        assert path.stat().st_size < 1 << 20
        with pytest.raises(UnreadableFile, match="too large"):
            load_failure(path, registry)

    def test_objects(self, save: Save, registry: Registry) -> None:
        """No pickle is read."""
        held = io.BytesIO()
        np.save(held, np.array([{}]), allow_pickle=True)
        with pytest.raises(UnreadableFile):
            load_failure(self.with_array(save("bad"), held.getvalue()), registry)

    def test_others_are_not_read(self, save: Save, registry: Registry, tmp_path: Path) -> None:
        """Members of other names are ignored, and nothing is unpacked to disk."""
        path = save("bad")
        with zipfile.ZipFile(path, "a") as archive:
            for name in ("../out.npy", "/abs.npy", "inputs/../../x.npy", "inputs/a.npy"):
                archive.writestr(name, b"x")
        before = set(tmp_path.parent.rglob("*"))
        assert isinstance(load_failure(path, registry), Failure)
        assert set(tmp_path.parent.rglob("*")) == before
