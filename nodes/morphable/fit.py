"""From landmarks to a face: set up the problem, solve it, put the result into the camera frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphface.nodes.morphable.fit_problem import PhotoFit, Settings, fit_of_photo, reduced_model
from graphface.nodes.morphable.fitted_mesh import fitted_mesh
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.pose import Pose
from graphface.nodes.morphable.solve import View, solve, view_cost
from graphface.nodes.types import Image, Landmarks, Mesh


def fit(
    model: MorphableModel,
    landmarks: Landmarks,
    settings: Settings,
    photo: Image | None = None,
    start: Pose | None = None,
) -> Mesh:
    """The face of one photograph; see `fit_together`.

    Args:
        start: an initial pose, used where it explains the points better than the closed form does.
    """
    return fit_together(model, [landmarks], settings, [photo], start)[0]


def fit_together(
    model: MorphableModel,
    faces: Sequence[Landmarks],
    settings: Settings,
    photos: Sequence[Image | None] | None = None,
    start: Pose | None = None,
) -> list[Mesh]:
    """One person in several photographs: a pose and an expression for each, one identity for all.

    Args:
        photos: give the principal point and, with the camera "exif", the focal length; without a photo the principal
            point is the median of the points.
        start: an initial pose for the first photograph.

    Raises:
        UnusableLandmarks: fewer than 6 finite points that the model knows, or all in one place.
        UsageError: the model has none of the landmarks' scheme.
    """
    reduced = reduced_model(model, settings.identity, settings.expression, settings.prior)
    fits = [
        fit_of_photo(reduced, landmarks, settings, photo)
        for landmarks, photo in zip(faces, photos or [None] * len(faces), strict=True)
    ]
    solution = solve(
        [one.problem for one in fits],
        [_initial(one, None if index else start) for index, one in enumerate(fits)],
        steps=settings.steps,
        tolerance=settings.tolerance,
        shared=reduced.identity,
        updates=[one.update for one in fits],
    )
    return [fitted_mesh(reduced, one, solution, index) for index, one in enumerate(fits)]


def _initial(photo: PhotoFit, given: Pose | None) -> View:
    """The better of the closed form and a given pose, with zero coefficients."""
    problem = photo.problem
    zero = np.zeros(len(problem.directions))
    # The offset is that of the picture and not of depth zero: a near camera enlarges what is in front.
    views = [
        View(pose.rotation, max(pose.scale, 1e-6), pose.offset, problem.nearness[0], zero)
        for pose in (photo.pose, given)
        if pose is not None and np.isfinite(pose.rotation).all()
    ]
    return min(views, key=lambda view: view_cost(problem, view))
