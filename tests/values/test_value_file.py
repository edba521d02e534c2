"""A value in a file: nothing is lost, and what is damaged says so."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from toys import Grid, Pair

from graphface import UnreadableFile, UnwritableFile
from graphface.values.codec import encode
from graphface.values.value_file import is_value_file, read_value, write_value


class TestValues:
    @pytest.mark.parametrize(
        ("value", "annotation"),
        [
            (1.5, float),
            ("text", str),
            (None, Pair | None),
            (np.array([[np.nan, -np.inf], [0.1, 1e-40]]), Grid),
            (Pair(np.arange(6.0).reshape(2, 3)), Pair),
            ([np.zeros((0, 3), np.float32), np.ones(2, np.int64)], list[Any]),
        ],
    )
    def test_comes_back(self, tmp_path: Path, value: Any, annotation: Any) -> None:
        """Arrays bit by bit, with NaN, dtype and shape; records as their class."""
        write_value(value, tmp_path / "v.npz")
        back = read_value(tmp_path / "v.npz", annotation)
        assert type(back) is type(value)
        held, found = encode(value), encode(back)
        assert held[1] == found[1]
        assert [array.tobytes() for array in held[0].values()] == [array.tobytes() for array in found[0].values()]

    def test_numpy_reads_it(self, tmp_path: Path) -> None:
        """NumPy alone opens the file: arrays by number, and the structure as a text."""
        write_value(Pair(np.ones((2, 3))), tmp_path / "v.npz")
        with np.load(tmp_path / "v.npz", allow_pickle=False) as held:
            assert sorted(held.files) == ["0", "structure"]
            assert held["0"].shape == (2, 3)

    def test_unknown_type(self, tmp_path: Path) -> None:
        """What cannot be stored is refused, and no file is left."""

        class Opaque:
            pass

        with pytest.raises(UnwritableFile, match="Opaque"):
            write_value(Opaque(), tmp_path / "v.npz")
        assert not list(tmp_path.iterdir())

    def test_other_type(self, tmp_path: Path) -> None:
        """A value is read as the type that is asked for, or not at all."""

        @dataclass(frozen=True)
        class Other:
            low: int

        write_value(Pair(np.ones((2, 3))), tmp_path / "v.npz")
        with pytest.raises(UnreadableFile, match="not a"):
            read_value(tmp_path / "v.npz", Other)

    def test_no_value(self, tmp_path: Path) -> None:
        """A file that is not there, is damaged, or is another .npz is named with the reason."""
        np.savez(tmp_path / "other.npz", a=np.ones(2))
        (tmp_path / "damaged.npz").write_bytes(b"PK\x03\x04 and nothing more")
        for name in ("missing", "damaged", "other"):
            with pytest.raises(UnreadableFile, match=name):
                read_value(tmp_path / f"{name}.npz", float)

    def test_is_one(self, tmp_path: Path) -> None:
        """Its table of contents tells a value from another .npz."""
        np.savez(tmp_path / "other.npz", a=np.ones(2))
        write_value(1.5, tmp_path / "v.npz")
        found = [is_value_file(tmp_path / f"{name}.npz") for name in ("v", "other", "missing")]
        assert found == [True, False, False]
