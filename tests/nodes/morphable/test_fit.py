"""Fitting: known faces come back, and every switch does what it says."""

from __future__ import annotations

import numpy as np
import pytest
from faces import coefficients_of, grid_model, landmarks_of, rotation_of

from graphface import GraphfaceWarning, UsageError
from graphface.nodes.geometry.average import average
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.landmark_schemes import UnusableLandmarks
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.contour import jaw_lines, seen
from graphface.nodes.morphable.focal import focal_length
from graphface.nodes.morphable.pose import closed_form, turned, yaw_pitch_roll
from graphface.nodes.person.morphable import person
from graphface.nodes.types import FileFormat, Landmarks
from graphface.nodes.types.image import image_from_array
from graphface.registry import default_registry, interchangeable


def shape_error(mesh, coefficients, rotation, scale=150.0):
    """Root mean square distance between a fitted and a true face, in eye distances, apart from where it lies."""
    truth = builtin_model().vertices(coefficients) @ rotation.T
    found = mesh.vertices / scale
    apart = (found - found.mean(axis=0)) - (truth - truth.mean(axis=0))
    return np.sqrt(np.square(apart).sum(axis=1).mean())


class TestMorphable:
    @pytest.mark.parametrize("yaw", [-45, -20, 0, 30, 45])
    def test_recovers_a_known_face(self, yaw):
        """Exact landmarks of a known face at up to 45 degrees give back its shape and pose."""
        coefficients, rotation = coefficients_of(1), rotation_of(yaw, 8, -5)
        mesh = morphable(landmarks_of(coefficients=coefficients, rotation=rotation), noise=0.005, strength=0.1)
        assert shape_error(mesh, coefficients, rotation) < 0.02
        assert yaw_pitch_roll(mesh.fit.rotation)[0] == pytest.approx(yaw, abs=1.5)

    def test_projects_onto_the_landmarks(self):
        """The camera takes the landmark vertices to their landmarks; errors and residual say how near."""
        landmarks = landmarks_of(coefficients=coefficients_of(2))
        mesh = morphable(landmarks, noise=0.01)
        projected = mesh.camera.project(mesh.vertices[builtin_model().landmarks["facemesh468"]])
        apart = np.linalg.norm(projected - landmarks.points[:, :2], axis=1)
        np.testing.assert_allclose(apart, mesh.fit.errors, atol=1e-2)
        assert mesh.fit.residual < 0.01 * 150

    def test_records_its_convergence(self):
        """Costs fall, the search comes to rest, and the condition is a number."""
        fit = morphable(landmarks_of(coefficients=coefficients_of(3), rotation=rotation_of(15))).fit
        assert (np.diff(fit.costs) <= 1e-4 * np.abs(fit.costs[:-1])).all()
        assert fit.converged
        assert 1 <= fit.condition < 1e6

    def test_full_perspective_is_recovered(self):
        """Landmarks seen from 6 eye distances are explained by a camera at about 6."""
        landmarks = landmarks_of(coefficients=coefficients_of(4, 0.3), near=1 / 6, rotation=rotation_of(20))
        estimated = morphable(landmarks, camera="estimated", noise=0.003, strength=0.3)
        weak = morphable(landmarks, camera="weak", noise=0.003, strength=0.3)
        assert estimated.fit.distance == pytest.approx(6, rel=0.25)
        assert estimated.fit.residual < weak.fit.residual

    def test_the_camera_is_continuous_with_the_weak_one(self):
        """A camera very far away gives the weak perspective's face."""
        landmarks = landmarks_of(coefficients=coefficients_of(5), rotation=rotation_of(10))
        far, weak = morphable(landmarks, camera="assumed", distance=1000), morphable(landmarks, camera="weak")
        np.testing.assert_allclose(far.vertices, weak.vertices, atol=0.5)

    def test_mixture_and_gaussian_agree_on_exact_points(self):
        """With good points the prior hardly matters."""
        landmarks = landmarks_of(coefficients=coefficients_of(6, 0.4))
        one, other = (morphable(landmarks, prior=p, noise=0.003) for p in ("mixture", "gaussian"))
        np.testing.assert_allclose(one.vertices, other.vertices, atol=3)

    def test_a_stronger_prior_stays_nearer_to_the_average(self):
        """Coefficients shrink as the strength grows."""
        landmarks = landmarks_of(coefficients=coefficients_of(7, 1.5))
        sizes = [
            np.linalg.norm(morphable(landmarks, strength=s, prior="gaussian").fit.identity) for s in (0.1, 10, 1e3)
        ]
        assert sizes[0] > sizes[1] > sizes[2]

    def test_an_outlier_hardly_moves_the_face(self):
        """One point at the other end of the picture changes no vertex by more than a pixel and a half."""
        landmarks = landmarks_of(coefficients=coefficients_of(8), rotation=rotation_of(10))
        spoiled = landmarks.points.copy()
        spoiled[4, :2] = (4000, 3000)
        clean, robust = morphable(landmarks), morphable(Landmarks(spoiled, "facemesh468"))
        assert np.abs(clean.vertices - robust.vertices).max() < 1.5

    def test_missing_points_are_said_and_borne(self):
        """A quarter of the points missing is a warning, and nearly the same face."""
        landmarks = landmarks_of(coefficients=coefficients_of(9))
        points = landmarks.points.copy()
        points[::4] = np.nan
        with pytest.warns(GraphfaceWarning, match="117 landmarks are missing"):
            holed = morphable(Landmarks(points, "facemesh468"))
        assert np.abs(holed.vertices - morphable(landmarks).vertices).mean() < 2

    def test_components_can_be_held_back(self):
        """Coefficients beyond the number asked for stay zero."""
        fit = morphable(landmarks_of(coefficients=coefficients_of(10)), identity=3, expression=0).fit
        assert np.count_nonzero(fit.identity) == 3
        assert not fit.expression.any()

    def test_no_steps_is_the_average_face(self):
        """With no step the closed-form pose of the mean face is returned."""
        with pytest.warns(GraphfaceWarning, match="rest"):
            mesh = morphable(landmarks_of(coefficients=coefficients_of(11)), steps=0)
        assert not mesh.fit.identity.any()

    def test_refuses_a_scheme_that_the_model_lacks(self):
        """The schemes that the model knows are named."""
        model = grid_model(landmarks={"facemesh468": np.arange(468, dtype=np.int32) % 144})
        with pytest.raises(UsageError, match="facemesh468"):
            morphable(Landmarks(np.zeros((68, 3), np.float32), "ibug68"), model=model)


class TestAverage:
    def test_has_the_mean_shape_in_the_right_pose(self):
        """Only the pose is fitted."""
        rotation = rotation_of(25, -5)
        mesh = average(landmarks_of(coefficients=coefficients_of(1), rotation=rotation))
        assert not mesh.fit.identity.any()
        assert yaw_pitch_roll(mesh.fit.rotation)[0] == pytest.approx(25, abs=4)


class TestPerson:
    def test_photographs_share_identity_and_not_expression(self):
        """Two expressions of one person: one identity, two expressions, each photo explained."""
        one, two = coefficients_of(1), coefficients_of(2)
        two[:15] = one[:15]
        faces = [landmarks_of(coefficients=c, rotation=rotation_of(y)) for c, y in ((one, -20), (two, 20))]
        first, second = person(faces, noise=0.01)
        np.testing.assert_allclose(first.fit.identity, second.fit.identity, atol=1e-5)
        assert np.abs(first.fit.expression - second.fit.expression).max() > 0.1
        assert max(first.fit.residual, second.fit.residual) < 0.02 * 150

    def test_one_photograph_is_the_single_fit(self):
        """A list of one gives what geometry.morphable gives."""
        landmarks = landmarks_of(coefficients=coefficients_of(3))
        np.testing.assert_allclose(person([landmarks])[0].vertices, morphable(landmarks).vertices, atol=1e-2)

    def test_nobody_is_an_error(self):
        """An empty list is the user's mistake."""
        with pytest.raises(UsageError, match="at least one"):
            person([])


class TestFamily:
    def test_members_are_interchangeable(self):
        """Any geometry takes the place of any other in a graph."""
        names = ("geometry.facemesh", "geometry.morphable", "geometry.average")
        operators = [default_registry().operator(name) for name in names]
        assert all(interchangeable(a, b) for a in operators[:1] for b in operators)
        assert interchangeable(operators[1], operators[2])

    def test_all_look_the_same_way(self):
        """Direct, fitted and average mesh of one face have nearly the same normals at the same points."""
        landmarks = landmarks_of(coefficients=coefficients_of(4, 0.3), rotation=rotation_of(10))
        depth = builtin_model().vertices(coefficients_of(4, 0.3)) @ rotation_of(10).T * 150
        points = landmarks.points.copy()
        points[:, 2] = depth[:468, 2]
        direct = facemesh(Landmarks(points, "facemesh468"))
        fitted = morphable(landmarks)
        cosine = np.einsum("vc,vc->v", direct.normals, fitted.normals[:468])
        assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean() < 8


class TestPose:
    @pytest.mark.parametrize(("yaw", "pitch", "roll"), [(0, 0, 0), (40, 10, -30), (-70, -20, 90), (10, 0, 170)])
    def test_closed_form_is_exact_on_exact_points(self, yaw, pitch, roll):
        """A rigid shape's pose is found from its projection, rolled by any angle."""
        shape, rotation = builtin_model().mean.astype(float), rotation_of(yaw, pitch, roll)
        pose = closed_form(shape, 80 * (shape @ rotation.T)[:, :2] + (5, -7))
        np.testing.assert_allclose(pose.rotation, rotation, atol=1e-3)
        assert pose.scale == pytest.approx(80, rel=1e-3)

    @pytest.mark.parametrize(("yaw", "pitch", "roll"), [(0, 0, 0), (40, 0, 0), (0, 25, 0), (0, 0, -50), (30, -10, 20)])
    def test_angles_come_back(self, yaw, pitch, roll):
        """Yaw and pitch are where the face looks; roll its lean about that direction."""
        found = yaw_pitch_roll(rotation_of(yaw, pitch, roll))
        np.testing.assert_allclose(found, (yaw, pitch, roll), atol=1e-6)

    def test_turning_keeps_rotations(self):
        """Many turns later the matrix is still orthonormal."""
        rotation = np.eye(3)
        for _ in range(500):
            rotation = turned(rotation, np.array([0.3, -0.2, 0.5]))
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)


class TestContour:
    def test_the_chin_stays_and_candidates_run_inwards(self):
        """Every jaw line starts at its own vertex and comes nearer to the mid-line."""
        model = builtin_model()
        lines = jaw_lines(model)
        np.testing.assert_array_equal(lines[:, 0], model.landmarks["ibug68"][:17])
        assert (lines[8] == lines[8, 0]).all()
        assert (np.abs(model.mean[lines[3:6, -1], 0]) < np.abs(model.mean[lines[3:6, 0], 0])).all()

    def test_the_outline_slides_on_the_far_side_only(self):
        """On a face turned to the right, the outline on the right comes from further inside; on the left it stays."""
        model = builtin_model()
        rotation = rotation_of(50)
        flat = (model.mean[jaw_lines(model)] @ rotation.T)[..., :2]
        chosen = seen(flat, rotation[:2, 0], np.arange(17))
        assert (chosen[11:16] > 0).any()
        assert (chosen[3:7] == 0).all()


class TestFocalLength:
    def test_is_read_from_exif(self):
        """A 50 mm equivalent is 50 / 43.27 diagonals."""
        from PIL.Image import Exif

        exif = Exif()
        exif.get_ifd(0x8769)[0xA405] = 50
        photo = image_from_array(np.zeros((300, 400, 3), np.uint8))
        photo = type(photo)(photo.pixels, file=FileFormat(exif=exif.tobytes()))
        assert focal_length(photo) == pytest.approx(500 * 50 / 43.267, rel=1e-3)
        mesh = morphable(landmarks_of(), photo, camera="exif")
        assert mesh.fit.distance == pytest.approx(focal_length(photo) / 150, rel=0.1)

    @pytest.mark.parametrize("exif", [None, b"", b"nonsense"])
    def test_without_it_a_distance_is_assumed(self, exif):
        """No or damaged EXIF is a warning, not a failure."""
        photo = image_from_array(np.zeros((300, 400, 3), np.uint8))
        photo = type(photo)(photo.pixels, file=FileFormat(exif=exif))
        assert focal_length(photo) is None
        with pytest.warns(GraphfaceWarning, match="no focal length"):
            assert morphable(landmarks_of(), photo, camera="exif").fit.distance == pytest.approx(10)


class TestUnusable:
    @pytest.mark.parametrize("points", [np.full((468, 3), np.nan), np.full((468, 3), 5.0)])
    def test_points_that_are_no_face_are_refused(self, points):
        """All missing or all in one place is a clear error."""
        with pytest.raises(UnusableLandmarks):
            morphable(Landmarks(points.astype(np.float32), "facemesh468"))
