"""What counts as the same content, and what does not."""

import os
import time
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from pydantic import BaseModel

from graphface import UnreadableFile
from graphface.values import digest as digest_module
from graphface.values.digest import Undigestible, canonical, digest_file, digest_value, new_hash

scalars = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text() | st.binary()
structures = st.recursive(
    scalars, lambda inner: st.lists(inner) | st.tuples(inner, inner) | st.dictionaries(st.text(), inner), max_leaves=12
)


def spelled(value: object) -> str:
    """A value with numbers and order made plain, types kept: equal spellings are equal parameters."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k!r}: {spelled(v)}" for k, v in sorted(value.items())) + "}"
    if isinstance(value, list | tuple):
        return f"{type(value).__name__}({', '.join(map(spelled, value))})"
    if isinstance(value, float) and value.is_integer():
        return repr(int(value))
    return repr(value)


class Mode(StrEnum):
    SOFT = "soft"


class Lamp(BaseModel):
    power: float = 1.0


class Spot(BaseModel):
    power: float = 1.0


@dataclass(frozen=True)
class Pair:
    one: object
    other: object


class TestCanonical:
    @given(structures, structures)
    def test_is_injective(self, one, other):
        """Two parameters share their bytes exactly where they say the same."""
        assert (canonical(one) == canonical(other)) == (spelled(one) == spelled(other))

    @pytest.mark.parametrize("same", [1.0, np.float32(1), np.int64(1), np.float64(1)])
    def test_numbers_coincide(self, same):
        """A parameter written 1, 1.0 or 1e0 is one key."""
        assert canonical({"sigma": same}) == canonical({"sigma": 1})

    def test_zeros_coincide(self):
        """0, 0.0 and -0.0 are one number."""
        assert canonical(0) == canonical(0.0) == canonical(-0.0)

    @given(st.integers(min_value=-(2**70), max_value=2**70))
    def test_large_integers_stay_exact(self, number):
        """Integers beyond 2**53 are told apart though their floats are not."""
        assert canonical(number) != canonical(number + 1)

    @pytest.mark.parametrize(
        ("one", "other"),
        [
            (True, 1),
            (False, 0),
            ((1, 2), [1, 2]),
            ("1", 1),
            ("a", b"a"),
            ("soft", Mode.SOFT),
            (["ab"], ["a", "b"]),
            ({"a": 1}, [("a", 1)]),
            (Lamp(), Spot()),
            (Lamp(), {"power": 1.0}),
            (Path("a"), "a"),
            (None, "None"),
            (float("nan"), float("inf")),
        ],
    )
    def test_structures_differ(self, one, other):
        """What an operator can tell apart has two keys."""
        assert canonical(one) != canonical(other)

    def test_dictionaries_are_unordered(self):
        """The order in which parameters are written is no part of them."""
        assert canonical({"a": 1, "b": 2}) == canonical({"b": 2, "a": 1})

    def test_sets_are_unordered(self):
        """A set counts by its elements."""
        assert canonical(frozenset("abc")) == canonical(frozenset("cba"))

    def test_huge_integers(self):
        """An integer too long for Python to print has a key too."""
        assert canonical(10**6000) != canonical(10**6000 + 1)

    def test_refuses_objects(self):
        """What has no content is refused by the name of its type, however deep it lies."""
        with pytest.raises(Undigestible, match="object") as caught:
            canonical({"a": [object()]})
        assert caught.value.value_type is object

    def test_refuses_cycles(self):
        """A list that holds itself is an error, not a crash."""
        knot: list[object] = []
        knot.append(knot)
        with pytest.raises(Undigestible, match="itself"):
            canonical(knot)


class TestDigestValue:
    @given(hnp.arrays(hnp.scalar_dtypes(), hnp.array_shapes(min_dims=0, min_side=0)))
    def test_array_equals_its_copy(self, array):
        """Equal bytes are equal, NaN included."""
        assert digest_value(array) == digest_value(array.copy())

    @given(hnp.arrays(np.float32, (4, 6, 3)))
    def test_layout_does_not_count(self, array):
        """A view with other strides digests as its contiguous copy."""
        view = array[::2, ::-1].transpose(2, 0, 1)
        assert digest_value(view) == digest_value(np.ascontiguousarray(view))

    @pytest.mark.parametrize("other", [(2, 6), (12,), (4, 3), (12, 1)])
    def test_shape_counts(self, other):
        """Same bytes in another shape are another input."""
        array = np.arange(12, dtype=np.float32)
        assert digest_value(array.reshape(3, 4)) != digest_value(array.reshape(other))

    def test_dtype_counts(self):
        """Same bytes under another dtype are another input."""
        array = np.arange(4, dtype=np.float32)
        assert digest_value(array) != digest_value(array.view(np.int32))

    def test_one_pixel_counts(self):
        """A change in the last bit of one pixel changes the digest."""
        array = np.zeros((64, 64, 3), np.float32)
        other = array.copy()
        other[-1, -1, -1] = np.nextafter(np.float32(0), np.float32(1))
        assert digest_value(array) != digest_value(other)

    def test_empty_arrays_keep_their_shape(self):
        """(0, 3) is not (3, 0)."""
        assert digest_value(np.zeros((0, 3))) != digest_value(np.zeros((3, 0)))

    def test_numbers_keep_their_type(self):
        """An operator can tell an input 1 from 1.0."""
        assert len({digest_value(v) for v in (1, 1.0, True, np.float32(1))}) == 4

    def test_dataclasses_count_by_field(self):
        """Which field holds an array matters."""
        ones, zeros = np.ones(3), np.zeros(3)
        assert digest_value(Pair(ones, zeros)) == digest_value(Pair(ones.copy(), zeros.copy()))
        assert digest_value(Pair(ones, zeros)) != digest_value(Pair(zeros, ones))

    def test_path_counts_with_content(self, tmp_path):
        """A path whose file changed is another input."""
        file = tmp_path / "points.txt"
        file.write_text("one")
        before = digest_value(file)
        file.write_text("two")
        assert digest_value(file) != before

    @pytest.mark.parametrize("bad", [np.array([object()]), np.ma.masked_array([1.0, 2.0], [True, False])])
    def test_refuses_arrays_without_plain_content(self, bad):
        """Object and masked arrays are refused rather than half hashed."""
        with pytest.raises(Undigestible):
            digest_value(bad)

    def test_without_xxhash(self, monkeypatch):
        """Without xxhash the digests differ: two installations never read each other's."""
        fast = digest_value("photo")
        monkeypatch.setattr(digest_module, "new_hash", lambda: new_hash("blake2b_128"))
        slow = digest_value("photo")
        assert len(slow) == 16
        assert slow != fast or digest_module.ALGORITHM == "blake2b_128"


class TestDigestFile:
    def test_counts_content_only(self, tmp_path):
        """Two files with the same bytes digest alike."""
        (tmp_path / "a").write_bytes(b"x" * 3_000_000)
        (tmp_path / "b").write_bytes(b"x" * 3_000_000)
        assert digest_file(tmp_path / "a") == digest_file(tmp_path / "b")

    def test_sees_an_edit_within_one_clock_tick(self, tmp_path):
        """Same size, same mtime, edited right after hashing: the stat of so young a file is not trusted."""
        file = tmp_path / "photo.png"
        file.write_bytes(b"one")
        stamp = os.stat(file).st_mtime_ns
        before = digest_file(file)
        file.write_bytes(b"two")
        os.utime(file, ns=(stamp, stamp))
        assert digest_file(file) != before

    def test_shortcut_spares_the_second_read(self, tmp_path, monkeypatch):
        """A settled file is read once."""
        file = _settled(tmp_path, monkeypatch)
        first = digest_file(file)
        monkeypatch.setattr(digest_module, "_hash_file", _must_not_read)
        assert digest_file(file) == first

    def test_shortcut_can_be_turned_off(self, tmp_path, monkeypatch):
        """Without the shortcut the bytes are read whatever stat says."""
        file = _settled(tmp_path, monkeypatch)
        digest_file(file)
        monkeypatch.setattr(digest_module, "_hash_file", _must_not_read)
        with pytest.raises(AssertionError, match="read again"):
            digest_file(file, stat_shortcut=False)

    def test_mtime_set_back_is_seen(self, tmp_path, monkeypatch):
        """An edit that restores size and mtime (cp -p, rsync) still shows in ctime."""
        file = _settled(tmp_path, monkeypatch)
        before, stamp = digest_file(file), os.stat(file).st_mtime_ns
        time.sleep(0.02)  # file systems stamp by the kernel's tick
        file.write_bytes(b"two")
        os.utime(file, ns=(stamp, stamp))
        assert digest_file(file) != before

    @pytest.mark.parametrize("name", ["missing.png", "."])
    def test_unreadable(self, tmp_path, name):
        """A missing file or a folder is an error that names it."""
        with pytest.raises(UnreadableFile) as caught:
            digest_file(tmp_path / name)
        assert caught.value.path == (tmp_path / name)


def _settled(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file that counts as old enough for its stat to be trusted."""
    file = folder / "photo.png"
    file.write_bytes(b"one")
    monkeypatch.setattr(digest_module, "RACY_NS", -60_000_000_000)
    return file


def _must_not_read(path: str) -> None:
    raise AssertionError("read again")
