"""Readers of other people's models, on small files in the same form that the tests write."""

from __future__ import annotations

import json
import pickle
import struct

import numpy as np
import pytest
from faces import grid_model

from graphface import UnreadableFile, UsageError
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.readers import guess_kind, read_model
from graphface.nodes.morphable.readers.assemble import boundary_loops, closed
from graphface.nodes.morphable.readers.landmark_file import read_landmark_numbers

SIZE = 90.0
"""Millimetres between the eye corners of the files written here."""


@pytest.fixture(scope="module")
def face():
    """The built-in mean face as a source would have it: millimetres, its own place, two directions."""
    model = builtin_model()
    mean = (model.mean * SIZE + (3, 50, -20)).astype(np.float32)
    identity = model.identity.directions[:2] * np.float32(SIZE)
    expression = model.expression.directions[:1] * np.float32(SIZE)
    return mean, model.triangles, identity, expression, model.landmarks["ibug68"]


@pytest.fixture
def numbers(face, tmp_path):
    path = tmp_path / "points.txt"
    path.write_text("# iBUG = vertex\n" + "".join(f"{k + 1} = {v}  # a point\n" for k, v in enumerate(face[4])))
    return path


def agrees(model, expressions=1):
    """What every reader promises of the face above: unit, triangles, landmarks, directions."""
    points = model.mean[model.landmarks["ibug68"]]
    assert np.linalg.norm(points[45] - points[36]) == pytest.approx(1, abs=1e-4)
    assert len(model.triangles) == len(builtin_model().triangles)
    assert len(model.identity) == 2
    assert len(model.expression) >= expressions
    ours = builtin_model()
    unit = np.linalg.norm(np.diff(ours.mean[ours.landmarks["ibug68"][[36, 45]]], axis=0))
    one = ours.identity.directions[1][ours.landmarks["ibug68"][17:]] / unit
    np.testing.assert_allclose(model.identity.directions[1][model.landmarks["ibug68"][17:]], one, atol=2e-3)
    assert (model.landmarks["facemesh468"] >= 0).sum() > 400


class TestIct:
    def test_packed(self, face, tmp_path):
        """The packed form: differences to the mean, quads or triangles with the last corner twice."""
        mean, triangles, identity, expression, points = face
        path = tmp_path / "ict.npz"
        faces = np.column_stack([triangles, triangles[:, 2]])
        names = np.array(["jawOpen"])
        np.savez(
            path,
            mean=mean,
            faces=faces,
            identity=identity,
            expression=expression,
            expression_names=names,
            landmarks68=points,
        )
        model = read_model(path)
        agrees(model)
        assert model.expression.names == ("jawOpen",)

    def test_folder(self, face, tmp_path):
        """The makers' folder of OBJ files with vertex_indices.json."""
        mean, triangles, identity, expression, points = face
        shapes = {"generic_neutral_mesh": mean, "identity000": mean + identity[0], "identity001": mean + identity[1]}
        for name, shape in {**shapes, "jawOpen": mean + expression[0]}.items():
            lines = [f"v {x} {y} {z}" for x, y, z in shape] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
            (tmp_path / f"{name}.obj").write_text("\n".join(lines))
        (tmp_path / "vertex_indices.json").write_text(json.dumps({"idx_to_landmark_verts": points.tolist()}))
        assert guess_kind(tmp_path) == "ict"
        agrees(read_model(tmp_path))

    def test_other_archives_are_refused(self, tmp_path):
        """What lacks the arrays is named with the array."""
        np.savez(tmp_path / "other.npz", mean=np.zeros((4, 3)))
        with pytest.raises(UnreadableFile, match="faces"):
            read_model(tmp_path / "other.npz")


class TestSurrey:
    def write(self, folder, face):
        mean, triangles, identity, expression, points = face

        def matrix(values):
            return struct.pack("<ii", *values.shape) + values.T.astype("<f4").tobytes()

        columns = identity.reshape(len(identity), -1).T
        sizes = np.linalg.norm(columns, axis=0)
        data = (
            struct.pack("<I", 1) + matrix(mean.reshape(-1, 1)) + matrix(columns / sizes) + matrix(sizes[:, None] ** 2)
        )
        data += struct.pack("<Q", len(triangles)) + triangles.astype("<i4").tobytes()
        (folder / "sfm_shape_1.bin").write_bytes(data)
        shapes = struct.pack("<Q", 1) + struct.pack("<Q", 5) + b"smile" + matrix(expression[0].reshape(-1, 1))
        (folder / "expression_blendshapes_1.bin").write_bytes(shapes)
        (folder / "ibug_to_sfm.txt").write_text(
            "".join(f"{k + 1} = {v}\n" for k, v in enumerate(points) if k == 8 or k > 16)
        )
        jaw = {"right_contour": points[:8].tolist(), "left_contour": points[16:8:-1].tolist()}
        (folder / "sfm_model_contours.json").write_text(json.dumps({"model_contour": jaw}))

    def test_reads_eos_files(self, face, tmp_path):
        """Shape, blendshapes, mapping and contours of eos."""
        self.write(tmp_path, face)
        model = read_model(tmp_path)
        agrees(model)
        assert model.expression.names == ("smile",)
        np.testing.assert_allclose(model.mean[model.landmarks["ibug68"][:17], 0] > 1e-4, np.arange(17) > 8)

    @pytest.mark.parametrize("keep", [3, 50, 5000])
    def test_half_files_are_refused(self, face, tmp_path, keep):
        """A file that ends in the middle is named."""
        self.write(tmp_path, face)
        shape = tmp_path / "sfm_shape_1.bin"
        shape.write_bytes(shape.read_bytes()[:keep])
        with pytest.raises(UnreadableFile, match=r"sfm_shape_1\.bin"):
            read_model(tmp_path)

    def test_the_real_one(self, shared):
        """The Surrey face model as eos ships it: 3448 vertices and the mouth closed, 63 and 6 directions."""
        model = read_model(shared / "models" / "sfm")
        assert (len(model.identity), len(model.expression)) == (63, 6)
        assert len(model.mean) == 3449
        assert (model.landmarks["ibug68"] >= 0).sum() == 66


class TestBasel:
    def test_2017(self, face, numbers, tmp_path):
        """HDF5 with shape and expression."""
        h5py = pytest.importorskip("h5py")
        mean, triangles, identity, expression, _ = face
        path = tmp_path / "model2017.h5"
        with h5py.File(path, "w") as file:
            for name, basis, center in (("shape", identity, mean), ("expression", expression, 0 * mean)):
                columns = basis.reshape(len(basis), -1).T
                sizes = np.linalg.norm(columns, axis=0)
                file[f"{name}/model/mean"] = center.ravel()
                file[f"{name}/model/pcaBasis"] = columns / sizes
                file[f"{name}/model/pcaVariance"] = sizes**2
            file["shape/representer/cells"] = triangles.T
        agrees(read_model(path, landmarks=numbers))
        with pytest.raises(UsageError, match="--landmarks"):
            read_model(path)

    def test_2017_lists_its_own_landmarks(self, face, tmp_path):
        """Named landmarks are taken at the nearest vertex."""
        h5py = pytest.importorskip("h5py")
        from graphface.nodes.morphable.readers.basel import _NAMED

        mean, triangles, identity, _, points = face
        path = tmp_path / "model2017.h5"
        columns = identity.reshape(2, -1).T
        sizes = np.linalg.norm(columns, axis=0)
        with h5py.File(path, "w") as file:
            file["shape/model/mean"], file["shape/model/pcaBasis"] = mean.ravel(), columns / sizes
            file["shape/model/pcaVariance"], file["shape/representer/cells"] = sizes**2, triangles.T
            listed = [{"id": n, "coordinates": mean[points[k]].tolist()} for n, k in _NAMED.items()]
            file["metadata/landmarks/json"] = json.dumps(listed)
        found = read_model(path).landmarks["ibug68"]
        assert (found >= 0).sum() == len(_NAMED)

    def test_2009(self, face, numbers, tmp_path):
        """MATLAB: orthonormal columns and deviations, triangles from 1 and clockwise."""
        from scipy.io import savemat

        mean, triangles, identity, _, _ = face
        columns = identity.reshape(2, -1).T
        sizes = np.linalg.norm(columns, axis=0)
        content = {"shapeMU": mean.reshape(-1, 1), "shapePC": columns / sizes, "shapeEV": sizes[:, None]}
        savemat(tmp_path / "bfm.mat", {**content, "tl": triangles[:, ::-1] + 1})
        agrees(read_model(tmp_path / "bfm.mat", landmarks=numbers), expressions=0)
        with pytest.raises(UsageError, match="lists no landmarks"):
            read_model(tmp_path / "bfm.mat")

    def test_other_files_are_refused(self, tmp_path):
        """A file that is no HDF5 is named."""
        pytest.importorskip("h5py")
        (tmp_path / "model.h5").write_bytes(b"nothing of the kind")
        with pytest.raises(UnreadableFile, match="HDF5"):
            read_model(tmp_path / "model.h5")


class TestFlame:
    def write(self, path, face, extra=None):
        mean, triangles, identity, _, _ = face
        directions = np.zeros((len(mean), 3, 301))
        directions[..., :2] = identity.transpose(1, 2, 0)
        weights = np.zeros((len(mean), 5))
        weights[:, 0], weights[mean[:, 1] < mean[:, 1].mean(), 2] = 1, 1
        joints = np.full((5, len(mean)), 1 / len(mean))
        data = {"v_template": mean, "shapedirs": directions, "f": triangles, "weights": weights, "J_regressor": joints}
        path.write_bytes(pickle.dumps({**data, **(extra or {})}, protocol=2))

    def test_reads_arrays_and_the_jaw(self, face, numbers, tmp_path):
        """Identity, expression and the opening of the jaw."""
        self.write(tmp_path / "flame.pkl", face)
        model = read_model(tmp_path / "flame.pkl", landmarks=numbers)
        assert model.expression.names == ("expression 0", "jaw open")
        assert len(model.identity) == 300
        moved = np.abs(model.expression.directions[1]).sum(axis=1) > 0
        assert moved.any()
        assert not moved.all()

    def test_the_embedding_beside_it_gives_the_landmarks(self, face, tmp_path):
        """The 51 inner points come from the file that FLAME has for them."""
        self.write(tmp_path / "flame.pkl", face)
        triangles, points = face[1], face[4]
        faces = [int(np.flatnonzero((triangles == p).any(axis=1))[0]) for p in points[17:]]
        weights = np.stack([(triangles[f] == p) * 0.8 + 0.1 for f, p in zip(faces, points[17:], strict=True)])
        data = pickle.dumps({"lmk_face_idx": np.array(faces), "lmk_b_coords": weights}, protocol=2)
        (tmp_path / "flame_static_embedding.pkl").write_bytes(data)
        found = read_model(tmp_path / "flame.pkl").landmarks["ibug68"]
        assert (found[:17] == -1).all()
        assert (found[17:] >= 0).all()

    def test_code_in_a_pickle_does_not_run(self, face, numbers, tmp_path):
        """A pickle that asks for anything but arrays is refused."""
        self.write(tmp_path / "flame.pkl", face, {"trap": pathlib_touch(tmp_path / "ran")})
        with pytest.raises(UnreadableFile, match="no array"):
            read_model(tmp_path / "flame.pkl", landmarks=numbers)
        assert not (tmp_path / "ran").exists()


def pathlib_touch(path):
    """An object whose unpickling would make a file."""

    class Trap:
        def __reduce__(self):
            return (open, (str(path), "w"))

    return Trap()


class TestAssemble:
    def test_holes_are_closed_with_the_same_winding(self):
        """Every edge of a closed hole has two triangles, running in opposite directions."""
        triangles = grid_model().triangles
        center = np.flatnonzero((triangles == 66).any(axis=1))
        holed = np.delete(triangles, center, axis=0)
        loops = boundary_loops(holed)
        assert len(loops) == 2
        filled, fans = closed(holed, loops[1:], 144)
        assert len(boundary_loops(filled)) == 1
        assert len(fans) == 1


class TestLandmarkFile:
    @pytest.mark.parametrize(("text", "reason"), [("nothing", "no line"), ("99 = 3", "no iBUG point 99")])
    def test_wrong_files_are_named(self, tmp_path, text, reason):
        """A file without a mapping, or with numbers beyond 68."""
        (tmp_path / "points.txt").write_text(text)
        with pytest.raises(UnreadableFile, match=reason):
            read_landmark_numbers(tmp_path / "points.txt")


class TestGuessKind:
    def test_says_what_it_does_not_know(self, tmp_path):
        """An unknown file is answered with the kinds there are."""
        with pytest.raises(UsageError, match="ict, surrey, flame, basel"):
            guess_kind(tmp_path / "face.xyz")
