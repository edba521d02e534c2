"""Points from files: read, checked against the photo, written back."""

from pathlib import Path

import numpy as np
import pytest

from graphface import GraphfaceWarning, UnreadableFile, UnwritableFile
from graphface.nodes.io.landmarks import read_landmarks, write_landmarks
from graphface.nodes.landmark_schemes import UnusableLandmarks
from graphface.nodes.landmarks.given import given
from graphface.nodes.types import Image, Landmarks

PHOTO = Image(np.zeros((200, 300, 3), np.float32))


def face(count: int = 68, scheme: str = "ibug68") -> Landmarks:
    """Points spread over the photo, all different."""
    points = np.random.default_rng(0).uniform(10, 190, (count, 3)).astype(np.float32)
    return Landmarks(points, scheme)


class TestFiles:
    @pytest.mark.parametrize("suffix", [".pts", ".csv", ".npy"])
    @pytest.mark.parametrize(("count", "scheme"), [(68, "ibug68"), (468, "facemesh468")])
    def test_round_trip(self, tmp_path, suffix, count, scheme):
        """Written points are read back; .pts has no depth."""
        points = face(count, scheme)
        write_landmarks(points, tmp_path / f"a{suffix}")
        back = read_landmarks(tmp_path / f"a{suffix}")
        axes = 2 if suffix == ".pts" else 3
        np.testing.assert_allclose(back.points[:, :axes], points.points[:, :axes], atol=1e-4)
        assert back.scheme == scheme

    def test_pts_counts_pixels_from_one(self, tmp_path):
        """iBUG's (1, 1) is the centre of the first pixel, our (0, 0)."""
        rows = "".join(f"{i + 1} 1\n" for i in range(68))
        (tmp_path / "a.pts").write_text("version: 1\nn_points:  68\n{\n" + rows + "}\n")
        np.testing.assert_array_equal(read_landmarks(tmp_path / "a.pts").points[:2], [[0, 0, 0], [1, 0, 0]])

    def test_csv_with_heading_and_comments(self, tmp_path):
        """A heading, comments, blank lines and semicolons do not disturb."""
        rows = "".join(f"{i};{i + 1}  # point {i}\n\n" for i in range(68))
        (tmp_path / "a.csv").write_text("x;y\n" + rows)
        assert read_landmarks(tmp_path / "a.csv").points[5].tolist() == [5, 6, 0]

    @pytest.mark.parametrize(
        ("name", "content", "reason"),
        [
            ("a.csv", "1,2\n" * 67, "68 or 468"),
            ("a.csv", "1,2\n" * 10 + "1,two\n" + "1,2\n" * 57, "line 11 is not numbers: '1,two'"),
            ("a.csv", "1,2\n" * 10 + "1,2,3\n" + "1,2\n" * 57, "line 11 has 3 numbers"),
            ("a.csv", "nan,2\n" * 68, "not numbers"),
            ("a.csv", "", "68 or 468"),
            ("a.pts", "hello\n", "line 1"),
            ("a.npy", "not an array", "a.npy"),
            ("a.npy", "", "a.npy"),
        ],
    )
    def test_unreadable(self, tmp_path, name, content, reason):
        """A file that holds no such points is refused with the line, where there is one."""
        (tmp_path / name).write_text(content)
        with pytest.raises(UnreadableFile, match=reason):
            read_landmarks(tmp_path / name)

    def test_binary_as_text(self, tmp_path):
        """A picture given for points is an answer, not a traceback."""
        (tmp_path / "a.csv").write_bytes(bytes(range(256)))
        with pytest.raises(UnreadableFile):
            read_landmarks(tmp_path / "a.csv")

    def test_no_code_from_npy(self, tmp_path):
        """Pickled objects in .npy are refused."""
        np.save(tmp_path / "a.npy", np.array([{}], dtype=object), allow_pickle=True)
        with pytest.raises(UnreadableFile):
            read_landmarks(tmp_path / "a.npy")

    @pytest.mark.parametrize("path", ["a.txt", "none/a.csv", "none/a.npy"])
    def test_unwritable(self, tmp_path, path):
        """Unknown suffixes and missing folders are named."""
        with pytest.raises(UnwritableFile):
            write_landmarks(face(), tmp_path / Path(path))


class TestGiven:
    def test_good_points_pass(self):
        """Points on the photo come back as they are."""
        points = face()
        assert given(PHOTO, points) is points

    @pytest.mark.parametrize(
        ("points", "words"),
        [
            (Landmarks(face().points + 1000, "ibug68"), "another size"),
            (Landmarks(face().points[:60], "ibug68"), r"\(60, 3\)"),
            (Landmarks(face().points, "dlib"), "known: facemesh468"),
            (Landmarks(face().points * np.float32(np.nan), "ibug68"), "not numbers"),
            (Landmarks(np.full((68, 3), 50, np.float32), "ibug68"), "less than a pixel apart"),
        ],
    )
    def test_unusable(self, points, words):
        """Points that cannot lie on this face are refused, and why."""
        with pytest.raises(UnusableLandmarks, match=words):
            given(PHOTO, points)

    def test_mostly_outside_is_said(self):
        """A face mostly outside the photo is used, with a warning."""
        with pytest.warns(GraphfaceWarning, match="given points lie in the photo"):
            given(PHOTO, Landmarks(face().points - np.array([120, 0, 0], np.float32), "ibug68"))
