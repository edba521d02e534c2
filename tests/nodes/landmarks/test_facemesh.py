"""Landmarks on a photograph: right place, whatever is done to the picture, and clear words where there is no face."""

import threading
import warnings

import cv2
import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.color import decode_srgb
from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.landmarks.blazeface import Face
from graphface.nodes.landmarks.facemesh import NoFaceFound, NoSuchFace, disagreement, facemesh
from graphface.nodes.types import Image, Landmarks

pytestmark = pytest.mark.usefixtures("weights")


def deviation(found: np.ndarray, expected: Landmarks) -> float:
    """Mean distance in the picture over the inter-ocular distance."""
    return float(np.linalg.norm(found[:, :2] - expected.points[:, :2], axis=1).mean()) / expected.interocular


@pytest.fixture(scope="module")
def found(weights, astronaut) -> Landmarks:
    return facemesh(astronaut)


class TestAstronaut:
    def test_scheme_and_shape(self, found):
        """468 points with depth, float32, of one face with a good score."""
        assert (found.points.shape, found.points.dtype) == ((468, 3), np.float32)
        assert (found.scheme, found.faces) == ("facemesh468", 1)
        assert found.score > 0.75

    def test_eyes_and_mouth(self, found):
        """Outer eye corners and mouth lie where one sees them in the photograph."""
        expected = {33: (195, 101), 263: (256, 104), 13: (223, 144)}
        for index, place in expected.items():
            assert np.linalg.norm(found.points[index, :2] - place) < 4, index

    def test_nose_is_nearer_than_the_cheeks(self, found):
        """z grows towards the viewer, in pixels: the nose tip stands out well."""
        depth = (found.points[4, 2] - found.points[[234, 454], 2].mean()) / found.interocular
        assert 0.3 < depth < 1.5

    def test_ibug68(self, found):
        """The 68 points are in iBUG's order: chin lowest of the jaw, eyes under brows."""
        points = ibug68(found).points
        assert points[:17, 1].argmax() in (7, 8, 9)
        assert points[36:42, 1].mean() > points[17:22, 1].mean()
        assert points[36, 0] < points[45, 0]


class TestSamePointsWhateverIsDone:
    def test_quarter_turns(self, astronaut, found):
        """A photo on its side or on its head gives the same points, turned with it."""
        for turns, place in (
            (1, lambda p: np.stack([511 - p[:, 1], p[:, 0]], axis=1)),
            (2, lambda p: 511 - p[:, :2]),
            (3, lambda p: np.stack([p[:, 1], 511 - p[:, 0]], axis=1)),
        ):
            pixels = np.ascontiguousarray(np.rot90(astronaut.pixels, turns))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", GraphfaceWarning)
                turned = facemesh(Image(pixels))
            assert deviation(place(turned.points), found) < 0.05, turns

    @pytest.mark.parametrize("angle", [-40, -15, 20, 45])
    def test_tilted_head(self, astronaut, found, angle):
        """A tilted head gives the same points, tilted."""
        matrix = cv2.getRotationMatrix2D((225, 130), angle, 1)
        tilted = facemesh(Image(cv2.warpAffine(astronaut.pixels, matrix, (512, 512))))
        back = cv2.invertAffineTransform(matrix)
        assert deviation(tilted.points[:, :2] @ back[:, :2].T + back[:, 2], found) < 0.06

    @pytest.mark.parametrize("scale", [0.5, 2, 5])
    def test_resolution(self, astronaut, found, scale):
        """A larger or smaller copy gives the same points, depth included, at its own scale."""
        pixels = cv2.resize(astronaut.pixels, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
        scaled = facemesh(Image(pixels)).points
        back = (scaled[:, :2] + 0.5) / scale - 0.5
        assert deviation(back, found) < 0.03
        assert np.abs(scaled[:, 2] / scale - found.points[:, 2]).max() < 0.1 * found.interocular

    def test_linear_light(self, astronaut, found):
        """A photo in linear light gives the same points."""
        linear = Image(decode_srgb(astronaut.pixels), encoding="linear")
        assert deviation(facemesh(linear).points, found) < 0.01

    def test_tight_crop(self, astronaut, found):
        """A crop that cuts off forehead and ears is found with a border around it."""
        left, top = 195, 85
        crop = Image(np.ascontiguousarray(astronaut.pixels[top:165, left:262]))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", GraphfaceWarning)
            points = facemesh(crop).points
        assert deviation(points[:, :2] + (left, top), found) < 0.12

    def test_small_face_in_a_large_photo(self, astronaut, found):
        """A face of 3 % of the picture is found, and the fallback is said."""
        canvas = np.full((3000, 4000, 3), 0.4, np.float32)
        canvas[1000:1512, 3000:3512] = astronaut.pixels
        with pytest.warns(GraphfaceWarning, match="hard to find"):
            points = facemesh(Image(canvas)).points
        assert deviation(points[:, :2] - (3000, 1000), found) < 0.03


class TestSeveralFaces:
    @pytest.fixture(scope="class")
    @staticmethod
    def group(astronaut) -> Image:
        """Two faces, the right one half as large."""
        canvas = np.full((512, 800, 3), 0.5, np.float32)
        canvas[:, :512] = astronaut.pixels
        canvas[100:356, 530:786] = cv2.resize(astronaut.pixels, (256, 256), interpolation=cv2.INTER_AREA)
        return Image(canvas)

    def test_largest_by_default(self, group, found):
        """The largest face is taken, and the number of faces told."""
        largest = facemesh(group)
        assert deviation(largest.points, found) < 0.03
        assert largest.faces == 2

    def test_by_index(self, group, found):
        """Index 1 is the second largest."""
        second = facemesh(group, face=1).points
        assert deviation((second[:, :2] - (530, 100) + 0.5) * 2 - 0.5, found) < 0.06

    def test_index_too_high(self, group):
        """An index past the last face says how many there are."""
        with pytest.raises(NoSuchFace, match="2 faces") as caught:
            facemesh(group, face=5)
        assert (caught.value.index, caught.value.faces) == (5, 2)


class TestNoFace:
    @pytest.mark.parametrize(
        "pixels",
        [
            np.zeros((1, 1, 3), np.float32),
            np.zeros((300, 400, 3), np.float32),
            np.ones((300, 400, 3), np.float32),
            np.full((64, 64, 3), np.nan, np.float32),
            np.random.default_rng(0).random((200, 200, 3), dtype=np.float32),
        ],
        ids=["one pixel", "black", "white", "NaN", "noise"],
    )
    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_error_says_what_was_tried(self, pixels):
        """Without a face the error names the size and everything that was tried."""
        with pytest.raises(NoFaceFound, match=r"with a border around it.*upside down") as caught:
            facemesh(Image(pixels))
        assert caught.value.size == (pixels.shape[1], pixels.shape[0])

    def test_half_a_face_is_not_a_face_of_its_own(self, astronaut, found):
        """The forehead and one eye are either completed from what is seen or refused: never a face inside an eye."""
        crop = Image(np.ascontiguousarray(astronaut.pixels[95:130, 195:232]))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", GraphfaceWarning)
                points = facemesh(crop).points
        except NoFaceFound:
            return
        assert np.ptp(points[:, 0]) > 40

    def test_disagreement_is_safe_for_a_mesh_of_one_point(self):
        """A collapsed mesh disagrees, without dividing by zero."""
        face = Face(np.array([0, 0, 9, 9], np.float32), np.arange(12, dtype=np.float32).reshape(6, 2), 1.0)
        assert disagreement(np.zeros((468, 3), np.float32), face) > 1e3


class TestDeterminism:
    def test_threads_agree(self, astronaut, found):
        """Four threads at once, each with its own networks, give the same bits as one."""
        results: list[np.ndarray] = []
        threads = [threading.Thread(target=lambda: results.append(facemesh(astronaut).points)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(results) == 4
        assert all(np.array_equal(r, found.points) for r in results)

    def test_thread_count_does_not_matter(self, astronaut, found):
        """OpenCV on one thread gives the same bits as on all."""
        before = cv2.getNumThreads()
        try:
            cv2.setNumThreads(1)
            single = facemesh(astronaut).points
        finally:
            cv2.setNumThreads(before)
        np.testing.assert_array_equal(single, found.points)

    def test_photo_is_not_changed(self, astronaut):
        """The photo is only read: a frozen array passes."""
        pixels = astronaut.pixels.copy()
        pixels.setflags(write=False)
        facemesh(Image(pixels))
        np.testing.assert_array_equal(pixels, astronaut.pixels)
