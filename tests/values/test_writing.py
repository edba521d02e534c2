"""A result file appears whole or not at all."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from graphface.errors import RefusedOutput, UnwritableFile, UsageError
from graphface.values.files import Files
from graphface.values.port_types import ANY, ArrayType, PortType
from graphface.values.writing import (
    beside,
    check_folder,
    check_output,
    is_drawn,
    make_folder,
    may_be_drawn,
    write_output,
)


@dataclass(frozen=True)
class Two:
    left: np.ndarray
    right: np.ndarray


class Stubborn:
    """What refuses to be written."""


def refuse(value: Stubborn, path: Path) -> None:
    raise PermissionError(13, "Permission denied")


DRAWN = ArrayType("Drawn", "H W")
FILES = {DRAWN: Files(write=lambda value, path: None, suffixes=(".png",)), Stubborn: Files(write=refuse)}


class TestWriting:
    def test_npy(self, tmp_path: Path) -> None:
        """.npy holds the array as it is."""
        value = np.arange(6, dtype=np.int16).reshape(2, 3)
        write_output(value, ANY, tmp_path / "a.npy", FILES.get)
        np.testing.assert_array_equal(np.load(tmp_path / "a.npy", allow_pickle=False), value)

    def test_npz(self, tmp_path: Path) -> None:
        """.npz holds every array of a value by its path."""
        write_output(Two(np.zeros(2), np.ones(3)), ANY, tmp_path / "a.npz", FILES.get)
        with np.load(tmp_path / "a.npz") as stored:
            assert {name: stored[name].shape for name in stored} == {"left": (2,), "right": (3,)}

    def test_mode(self, tmp_path: Path) -> None:
        """The file has the mode that the user's umask asks for, not that of a temporary file."""
        (tmp_path / "plain").touch()
        write_output(np.zeros(1), ANY, tmp_path / "a.npy", FILES.get)
        assert (tmp_path / "a.npy").stat().st_mode == (tmp_path / "plain").stat().st_mode

    @pytest.mark.parametrize(("value", "name"), [(3.0, "a.npz"), (3.0, "a.png"), (Stubborn(), "a.txt"), ("x", "a.npy")])
    def test_unwritable(self, tmp_path: Path, value: object, name: str) -> None:
        """A value that cannot be written as asked is an error that names the file."""
        with pytest.raises(UnwritableFile) as caught:
            write_output(value, PortType((type(value),)), tmp_path / name, FILES.get)
        assert caught.value.path == tmp_path / name
        assert list(tmp_path.iterdir()) == []

    def test_missing_folder(self, tmp_path: Path) -> None:
        """A folder that is not there is made."""
        write_output(np.zeros(1), ANY, tmp_path / "none" / "deep" / "a.npy", FILES.get)
        assert (tmp_path / "none" / "deep" / "a.npy").is_file()

    def test_no_folder_can_be(self, tmp_path: Path) -> None:
        """One that a file stands in the way of is an error that names the result."""
        (tmp_path / "none").touch()
        with pytest.raises(UnwritableFile, match=r"a\.npy: its folder cannot be made"):
            write_output(np.zeros(1), ANY, tmp_path / "none" / "a.npy", FILES.get)

    def test_any_failure_of_a_writer(self, tmp_path: Path) -> None:
        """Whatever a writer raises is told with the file."""

        def broken(value: object, path: Path) -> None:
            raise ZeroDivisionError("oh")

        with pytest.raises(UnwritableFile, match=r"a\.txt: its writer failed \(ZeroDivisionError: oh\)"):
            write_output(Stubborn(), ANY, tmp_path / "a.txt", {Stubborn: Files(write=broken)}.get)


class TestBeside:
    def test_success(self, tmp_path: Path) -> None:
        """What was written takes the place of the file."""
        with beside(tmp_path / "a.txt") as path:
            path.write_text("new")
        assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]

    def test_link(self, tmp_path: Path) -> None:
        """A symbolic link stays, and what it points to is replaced, in its own folder and also where it is missing."""
        (tmp_path / "there").mkdir()
        (tmp_path / "a.txt").symlink_to(tmp_path / "there" / "b")
        for text in ("one", "two"):
            with beside(tmp_path / "a.txt") as path:
                assert (path.parent, path.suffix) == (tmp_path / "there", ".txt")
                path.write_text(text)
            assert (tmp_path / "there" / "b").read_text() == text
        assert (tmp_path / "a.txt").is_symlink()
        assert [p.name for p in (tmp_path / "there").iterdir()] == ["b"]

    @pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
    def test_failure(self, tmp_path: Path, error: type[BaseException]) -> None:
        """Where writing fails or is interrupted, the old file stays and nothing else."""
        (tmp_path / "a.txt").write_text("old")
        with pytest.raises(error), beside(tmp_path / "a.txt") as path:  # noqa: PT012 - the block is what fails
            path.write_text("half")
            raise error
        assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]
        assert (tmp_path / "a.txt").read_text() == "old"


class TestCheckFolder:
    def test_fine(self, tmp_path: Path) -> None:
        """Nothing is left behind."""
        check_folder(tmp_path / "a.png")
        assert list(tmp_path.iterdir()) == []

    def test_missing(self, tmp_path: Path) -> None:
        """A folder that can be made is not made before there is something to put in it."""
        check_folder(tmp_path / "none" / "deep" / "a.png")
        assert list(tmp_path.iterdir()) == []

    @pytest.mark.parametrize(
        "name",
        ["", "x" * 300 + ".png", "x" * 300 + "/a.png", "none/" + "x" * 300 + ".png", "file/a.png", "file/b/a.png"],
    )
    def test_refused(self, tmp_path: Path, name: str) -> None:
        """A folder, a file where a folder should be and a name too long are told before anything runs."""
        (tmp_path / "file").touch()
        with pytest.raises(RefusedOutput):
            check_folder(tmp_path / name)

    def test_no_file(self) -> None:
        """A device is not renamed over."""
        with pytest.raises(RefusedOutput, match="no ordinary file"):
            check_folder(Path(os.devnull))


class TestCheckOutput:
    @pytest.mark.parametrize(
        ("declared", "name"),
        [
            (PortType((DRAWN,)), "a.PNG"),
            (PortType((DRAWN,)), "a.npy"),
            (PortType((Two,)), "a.npz"),
            (PortType((Two,)), "a.png"),
            (PortType((np.ndarray,)), "a.npy"),
            (PortType((Stubborn,)), "a.anything"),
            (PortType((DRAWN, Stubborn)), "a.anything"),
            (ANY, "a.anything"),
        ],
    )
    def test_fine(self, tmp_path: Path, declared: PortType, name: str) -> None:
        """A suffix that a writer knows, or may know."""
        check_output(tmp_path / name, declared, FILES.get)

    def test_what_the_writer_lacks(self, tmp_path: Path) -> None:
        """A writer that cannot work here is found now, for the suffixes that it writes and no other."""

        def check(path: Path) -> None:
            raise UsageError(f"{path}: install it")

        files = {DRAWN: Files(write=lambda value, path: None, suffixes=(".obj",), check=check)}
        check_output(tmp_path / "a.npy", PortType((DRAWN,)), files.get)
        with pytest.raises(UsageError, match="install it"):
            check_output(tmp_path / "a.obj", PortType((DRAWN,)), files.get)

    @pytest.mark.parametrize(
        ("declared", "name"),
        [
            (PortType((DRAWN,)), "a.gif"),
            (PortType((DRAWN,)), "a"),
            (PortType((Two,)), "a.npy"),
            (PortType((float,), optional=True), "a.txt"),
        ],
    )
    def test_refused(self, tmp_path: Path, declared: PortType, name: str) -> None:
        """A suffix that none knows is refused, and those known are named."""
        with pytest.raises(RefusedOutput, match=r"\.npz"):
            check_output(tmp_path / name, declared, FILES.get)


class TestDrawn:
    @pytest.mark.parametrize(
        ("value", "declared", "name", "drawn"),
        [
            (Two(np.zeros(1), np.zeros(1)), PortType((Two,)), "a.png", True),
            (Two(np.zeros(1), np.zeros(1)), PortType((Two,)), "a.npz", False),
            (np.zeros((2, 2)), PortType((DRAWN,)), "a.PNG", False),
            (np.zeros((2, 2)), PortType((DRAWN,)), "a.webp", True),
            (Stubborn(), PortType((Stubborn,)), "a.png", False),
            (Stubborn(), ANY, "a.png", False),
            (2.5, ANY, "a.png", True),
            (None, PortType((DRAWN,), optional=True), "a.png", True),
        ],
    )
    def test_where_no_writer_is(self, value: object, declared: PortType, name: str, drawn: bool) -> None:
        """A picture's suffix that the type's own writer does not know; that is foreseen before anything runs."""
        assert is_drawn(value, declared, Path(name), FILES.get) == drawn
        assert may_be_drawn(Path(name), declared, FILES.get) >= drawn


class TestMakeFolder:
    def test_made(self, tmp_path: Path) -> None:
        """With those above it; one that is there is left."""
        for _ in range(2):
            make_folder(tmp_path / "a" / "b")
        assert (tmp_path / "a" / "b").is_dir()

    def test_a_file_has_its_name(self, tmp_path: Path) -> None:
        """It is said that this is a file."""
        (tmp_path / "a").touch()
        with pytest.raises(RefusedOutput, match="is a file"):
            make_folder(tmp_path / "a")
