"""The problem of fitting a model to the landmarks of one photograph."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError, warn
from graphface.nodes.landmark_schemes import UnusableLandmarks, ibug68
from graphface.nodes.morphable.contour import sliding_jaw
from graphface.nodes.morphable.focal import focal_length
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.pose import Pose, closed_form
from graphface.nodes.morphable.prior import Prepared, marginal, prepare, standard
from graphface.nodes.morphable.solve import MAX_NEARNESS, Problem, UpdateProblem
from graphface.nodes.types import Image, Landmarks

CameraChoice = Literal["weak", "assumed", "estimated", "exif"]


PriorChoice = Literal["mixture", "gaussian"]


MIN_POINTS = 6
"""Least number of landmarks for a fit: a pose has six unknowns, and each point gives two numbers."""


_INDEPENDENT_POINTS = 68
"""Errors of a mesh's points are correlated: more points than this together weigh as much as this many. (Against
path-traced heads, fitting the Surrey model to 459 points of full weight makes the normals 4 degrees worse than fitting
it to 66.)"""


_NEARNESS_DEVIATION = 0.05
"""Standard deviation of an estimated inverse distance from the assumed one, per eye distance."""


_MAX_THINNESS = 50.0
"""Largest ratio of the principal deviations of points that determine a pose."""


@dataclass(frozen=True)
class Settings:
    """See `geometry.morphable` for the meaning of each."""

    camera: CameraChoice = "weak"
    distance: float = 10.0
    prior: PriorChoice = "mixture"
    strength: float = 1.0
    noise: float = 0.03
    robust: float = 0.1
    identity: int | None = None
    expression: int | None = None
    slide: bool = True
    steps: int = 20
    tolerance: float = 1e-4


@dataclass(frozen=True)
class ReducedModel:
    """A model with some of its components: `used` (K,) are the numbers of their coefficients, `identity` of them
    first."""

    model: MorphableModel
    used: NDArray[np.intp]
    identity: int
    prior: Prepared


@dataclass(frozen=True)
class PhotoFit:
    """The fit of one photograph.

    `known` (L,): the landmarks used, of the scheme's `count`. `pose`: the initial one, in closed form. `center`: the
    principal point in pixels. `update`: see `solve`.
    """

    problem: Problem
    pose: Pose
    center: tuple[float, float]
    known: NDArray[np.intp]
    count: int
    update: UpdateProblem | None


@lru_cache(maxsize=16)
def reduced_model(
    model: MorphableModel, identity: int | None, expression: int | None, prior: PriorChoice
) -> ReducedModel:
    """The model with at most so many components of identity and expression, and the chosen prior over them."""
    identities, expressions = len(model.identity), len(model.expression)
    kept = min(identity if identity is not None else identities, identities)
    kept_expressions = min(expression if expression is not None else expressions, expressions)
    used = np.concatenate([np.arange(kept), identities + np.arange(kept_expressions)]).astype(np.intp)
    mixture = standard(len(used)) if model.prior is None or prior == "gaussian" else marginal(model.prior, used)
    return ReducedModel(model, used, kept, prepare(mixture))


def fit_of_photo(reduced: ReducedModel, landmarks: Landmarks, settings: Settings, photo: Image | None) -> PhotoFit:
    """The problem of one photograph, and its initial pose.

    Raises:
        UnusableLandmarks: fewer than 6 finite points that the model knows, or all in one place.
        UsageError: the model has none of the landmarks' scheme.
    """
    landmarks = _in_scheme_of(reduced.model, landmarks)
    vertices = reduced.model.landmarks[landmarks.scheme].astype(np.intp)
    known = _known_landmarks(reduced.model, landmarks)
    center, points = _centered(landmarks.points[known, :2].astype(np.float64), photo)
    rows = vertices[known]
    mean = reduced.model.mean[rows].astype(np.float64)
    pose = closed_form(mean, points)
    _warn_of_uncertain_pose(pose)
    problem = Problem(
        mean=mean,
        directions=reduced.model.directions[reduced.used][:, rows].astype(np.float64),
        points=points,
        weights=np.full(len(known), min(1.0, _INDEPENDENT_POINTS / len(known))),
        prior=reduced.prior,
        noise=settings.noise,
        robust=max(settings.robust, settings.noise),
        strength=settings.strength,
        nearness=_nearness(settings, photo, pose),
        pixel=max(pose.scale, 1e-6),
    )
    slides = settings.slide and landmarks.scheme == "ibug68"
    update = sliding_jaw(reduced.model, reduced.used, known) if slides else None
    return PhotoFit(problem, pose, center, known, len(vertices), update)


def _in_scheme_of(model: MorphableModel, landmarks: Landmarks) -> Landmarks:
    if landmarks.scheme in model.landmarks:
        return landmarks
    if landmarks.scheme == "facemesh468" and "ibug68" in model.landmarks:
        return ibug68(landmarks)
    known = ", ".join(repr(scheme) for scheme in model.landmarks)
    raise UsageError(f"the model {model.name!r} knows landmarks of the scheme {known}, not {landmarks.scheme!r}")


def _known_landmarks(model: MorphableModel, landmarks: Landmarks) -> NDArray[np.intp]:
    """Numbers of the landmarks that are finite and that the model knows."""
    finite = np.asarray(np.isfinite(landmarks.points[:, :2]).all(axis=1), np.bool_)
    known = np.flatnonzero(finite & (model.landmarks[landmarks.scheme] >= 0))
    if len(known) < MIN_POINTS:
        raise UnusableLandmarks(
            f"{len(known)} of {len(finite)} landmarks are finite and known to the model {model.name!r}; "
            f"a fit needs at least {MIN_POINTS}"
        )
    if not finite.all():
        warn(f"{int((~finite).sum())} landmarks are missing: the face is fitted to the other {len(known)}")
    return known


def _centered(pixels: NDArray[np.float64], photo: Image | None) -> tuple[tuple[float, float], NDArray[np.float64]]:
    """The principal point, and the pixels (n, 2) relative to it with y up."""
    if photo is not None:
        center = ((photo.width - 1) / 2, (photo.height - 1) / 2)
    else:
        median = np.median(pixels, axis=0)
        center = (float(median[0]), float(median[1]))
    points = (pixels - center) * (1, -1)
    if np.ptp(points, axis=0).max() < 1e-3:
        raise UnusableLandmarks("the landmarks all lie in one place; there is no face to fit")
    return center, points


def _warn_of_uncertain_pose(pose: Pose) -> None:
    if pose.thinness > _MAX_THINNESS:
        warn("the landmarks lie nearly on one line: the pose across it is a guess")
    elif pose.rotation[2, 2] < 0:
        warn("the landmarks show a face that looks away from the camera; is the picture or the numbering mirrored?")


def _nearness(settings: Settings, photo: Image | None, pose: Pose) -> tuple[float, float]:
    """Expected inverse distance of the camera, and its standard deviation."""
    assumed = min(1 / settings.distance, MAX_NEARNESS)
    if settings.camera == "weak":
        return 0.0, 0.0
    if settings.camera == "estimated":
        return assumed, _NEARNESS_DEVIATION
    if settings.camera == "exif":
        focal = None if photo is None else focal_length(photo)
        if focal is not None:
            return float(np.clip(pose.scale / focal, 0, MAX_NEARNESS)), 0.0
        warn(f"the photo has no focal length: a camera at {settings.distance:g} eye distances is assumed")
    return assumed, 0.0
