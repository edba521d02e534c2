"""Files of landmarks."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.io.landmarks import read_landmarks, write_landmarks
from graphface.nodes.types import Landmarks

POINTS = np.random.default_rng(0).uniform(0, 400, (68, 3)).astype(np.float32)


class TestRoundTrip:
    @pytest.mark.parametrize("suffix", [".csv", ".npy"])
    def test_is_exact(self, tmp_path, suffix):
        """Points are written and read again, to the last bit of float32."""
        write_landmarks(Landmarks(POINTS, "ibug68"), tmp_path / f"a{suffix}")
        back = read_landmarks(tmp_path / f"a{suffix}")
        np.testing.assert_array_equal(back.points, POINTS)
        assert back.scheme == "ibug68"

    def test_pts_has_no_depth_and_counts_from_one(self, tmp_path):
        """In .pts the first pixel's centre is (1, 1)."""
        write_landmarks(Landmarks(POINTS, "ibug68"), tmp_path / "a.pts")
        assert float((tmp_path / "a.pts").read_text().splitlines()[3].split()[0]) == pytest.approx(POINTS[0, 0] + 1)
        back = read_landmarks(tmp_path / "a.pts").points
        np.testing.assert_allclose(back[:, :2], POINTS[:, :2], atol=1e-4)
        assert not back[:, 2].any()


class TestReadLandmarks:
    def test_heading_comments_and_separators(self, tmp_path):
        """A heading, # comments and blank lines are skipped; commas, semicolons and spaces separate."""
        rows = "\n".join(f"{i}, {i}; {i}  # point" for i in range(468))
        (tmp_path / "a.txt").write_text(f"x,y,z\n\n# a face\n{rows}\n")
        back = read_landmarks(tmp_path / "a.txt")
        assert back.scheme == "facemesh468"
        np.testing.assert_array_equal(back.points[7], [7, 7, 7])

    @pytest.mark.parametrize(
        ("text", "words"),
        [
            ("1 2\n1 x\n", "line 2 is not numbers"),
            ("1 2\n1 2 3\n", "line 2 has 3 numbers"),
            ("1 2\n", r"found \(1, 2\)"),
            ("", "found"),
            ("nan 1\n" * 68, "not numbers"),
        ],
    )
    def test_mistakes_are_named(self, tmp_path, text, words):
        """With the line, where there is one."""
        (tmp_path / "a.txt").write_text(text)
        with pytest.raises(UnreadableFile, match=words):
            read_landmarks(tmp_path / "a.txt")

    def test_binary_as_text(self, tmp_path):
        """A picture in place of points is refused."""
        (tmp_path / "a.csv").write_bytes(bytes(range(256)))
        with pytest.raises(UnreadableFile):
            read_landmarks(tmp_path / "a.csv")

    def test_no_code_from_npy(self, tmp_path):
        """Pickled objects in .npy are refused."""
        np.save(tmp_path / "a.npy", np.array([{}], dtype=object), allow_pickle=True)
        with pytest.raises(UnreadableFile):
            read_landmarks(tmp_path / "a.npy")


class TestWriteLandmarks:
    @pytest.mark.parametrize("name", ["a.txt", "a", "none/a.csv"])
    def test_refused(self, tmp_path, name):
        """An unknown suffix, none, and a folder that does not exist."""
        with pytest.raises(UnwritableFile):
            write_landmarks(Landmarks(POINTS, "ibug68"), tmp_path / name)
