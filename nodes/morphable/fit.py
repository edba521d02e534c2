"""From landmarks to a face: prepare the problem, solve it, put the result into the camera frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError, warn
from graphface.nodes.landmark_schemes import UnusableLandmarks, ibug68
from graphface.nodes.morphable.contour import CHIN, JAW_POINTS, jaw_lines, seen
from graphface.nodes.morphable.focal import focal_length
from graphface.nodes.morphable.mirror import mirror_vertices
from graphface.nodes.morphable.model import EYE_CORNERS, MorphableModel
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.morphable.pose import Pose, closed_form
from graphface.nodes.morphable.prior import Prepared, leading, prepare, standard
from graphface.nodes.morphable.solve import NEAREST, Follow, Problem, Solution, View, residuals, solve, view_cost
from graphface.nodes.types import Camera, FitRecord, Image, Landmarks, Mesh

Array = NDArray[np.float64]


CameraChoice = Literal["weak", "assumed", "estimated", "exif"]


PriorChoice = Literal["mixture", "gaussian"]


LEAST_POINTS = 6
"""Landmarks below which there is no fit: a pose has six unknowns, and each point gives two numbers."""


_INDEPENDENT = 68
"""Points of a mesh err together: more of them than this tell no more. (Against path-traced heads, fitting the Surrey
model to 459 points as if each erred alone makes the normals 4 degrees worse than fitting it to 66.)"""


_STRAY = 0.05
"""How far an estimated inverse distance may stray from the assumed one: one standard deviation, per eye distance."""


_POOR = 0.25
"""A residual above this, in eye distances, is not a fit of these points."""


_THIN = 50.0
"""Points that lie this many times longer than wide do not determine a pose."""


@dataclass(frozen=True)
class Settings:
    """See `morphable` for what each means."""

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


def fit(
    model: MorphableModel,
    landmarks: Landmarks,
    settings: Settings,
    photo: Image | None = None,
    start: Pose | None = None,
) -> Mesh:
    """The face of one photograph; see `fit_together`.

    Args:
        start: a pose to begin at, where it explains the points better than the closed form does.
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
        photos: give the principal point and, with the camera "exif", the focal length; where there is none, the
            principal point is the middle of the points.

    Raises:
        UnusableLandmarks: fewer than 6 finite points that the model knows, or all in one place.
        UsageError: the model has none of the landmarks' scheme.
    """
    ready = _prepared(model, settings.identity, settings.expression, settings.prior)
    tasks = [
        _task(ready, landmarks, settings, photo)
        for landmarks, photo in zip(faces, photos or [None] * len(faces), strict=True)
    ]
    views = [_start(task, None if index else start) for index, task in enumerate(tasks)]
    follows = {id(task.problem.points): task.follow for task in tasks if task.follow is not None}

    def follow(problem: Problem, view: View) -> Problem:
        slide = follows.get(id(problem.points))
        return problem if slide is None else slide(problem, view)

    solution = solve(
        [task.problem for task in tasks],
        views,
        steps=settings.steps,
        tolerance=settings.tolerance,
        shared=ready.identity,
        follow=follow if follows else None,
    )
    return [_mesh(ready, task, solution, index) for index, task in enumerate(tasks)]


@dataclass(frozen=True)
class _Ready:
    """A model cut to the asked components; `used` (K,) are the numbers of the coefficients kept, identity first."""

    model: MorphableModel
    used: NDArray[np.intp]
    identity: int
    prior: Prepared


@dataclass(frozen=True)
class _Task:
    """One photograph's problem; `known` (L,) are the landmarks used of the scheme's `count`."""

    problem: Problem
    pose: Pose
    center: tuple[float, float]
    known: NDArray[np.intp]
    count: int
    eyes: tuple[int, int]
    follow: Follow | None


@lru_cache(maxsize=16)
def _prepared(model: MorphableModel, identity: int | None, expression: int | None, prior: PriorChoice) -> _Ready:
    identities, expressions = len(model.identity), len(model.expression)
    kept = min(identity if identity is not None else identities, identities)
    kept_expressions = min(expression if expression is not None else expressions, expressions)
    used = np.concatenate([np.arange(kept), identities + np.arange(kept_expressions)]).astype(np.intp)
    mixture = standard(len(used)) if model.prior is None or prior == "gaussian" else leading(model.prior, used)
    return _Ready(model, used, kept, prepare(mixture))


def _task(ready: _Ready, landmarks: Landmarks, settings: Settings, photo: Image | None) -> _Task:
    model = ready.model
    landmarks = _in_scheme_of(model, landmarks)
    vertices = model.landmarks[landmarks.scheme].astype(np.intp)
    pixels = landmarks.points[:, :2].astype(np.float64)
    finite = np.isfinite(pixels).all(axis=1)
    known = np.flatnonzero(finite & (vertices >= 0))
    if len(known) < LEAST_POINTS:
        raise UnusableLandmarks(
            f"{len(known)} of {len(pixels)} landmarks are finite and known to the model {model.name!r}; "
            f"a fit needs at least {LEAST_POINTS}"
        )
    if not finite.all():
        warn(f"{int((~finite).sum())} landmarks are missing: the face is fitted to the other {len(known)}")
    if photo is not None:
        center = ((photo.width - 1) / 2, (photo.height - 1) / 2)
    else:
        middle = np.median(pixels[known], axis=0)
        center = (float(middle[0]), float(middle[1]))
    points = (pixels[known] - center) * (1, -1)
    if np.ptp(points, axis=0).max() < 1e-3:
        raise UnusableLandmarks("the landmarks all lie in one place; there is no face to fit")

    rows = vertices[known]
    mean = model.mean[rows].astype(np.float64)
    pose = closed_form(mean, points)
    _doubt(pose)
    problem = Problem(
        mean=mean,
        directions=model.directions[ready.used][:, rows].astype(np.float64),
        points=points,
        weights=np.full(len(known), min(1.0, _INDEPENDENT / len(known))),
        prior=ready.prior,
        noise=settings.noise,
        robust=max(settings.robust, settings.noise),
        strength=settings.strength,
        nearness=_nearness(settings, photo, pose),
        pixel=max(pose.scale, 1e-6),
    )
    slides = settings.slide and landmarks.scheme == "ibug68"
    follow = _sliding(ready, known) if slides else None
    return _Task(problem, pose, center, known, len(pixels), EYE_CORNERS[landmarks.scheme], follow)


def _in_scheme_of(model: MorphableModel, landmarks: Landmarks) -> Landmarks:
    if landmarks.scheme in model.landmarks:
        return landmarks
    if landmarks.scheme == "facemesh468" and "ibug68" in model.landmarks:
        return ibug68(landmarks)
    known = ", ".join(repr(scheme) for scheme in model.landmarks)
    raise UsageError(f"the model {model.name!r} knows landmarks of the scheme {known}, not {landmarks.scheme!r}")


def _doubt(pose: Pose) -> None:
    """Say so where the points hardly determine a pose."""
    if pose.thinness > _THIN:
        warn("the landmarks lie nearly on one line: the pose across it is a guess")
    elif pose.rotation[2, 2] < 0:
        warn("the landmarks show a face that looks away from the camera; is the picture or the numbering mirrored?")


def _nearness(settings: Settings, photo: Image | None, pose: Pose) -> tuple[float, float]:
    """Inverse distance and how far it may stray."""
    assumed = min(1 / settings.distance, NEAREST)
    if settings.camera == "weak":
        return 0.0, 0.0
    if settings.camera == "estimated":
        return assumed, _STRAY
    if settings.camera == "exif":
        focal = None if photo is None else focal_length(photo)
        if focal is not None:
            return float(np.clip(pose.scale / focal, 0, NEAREST)), 0.0
        warn(f"the photo tells no focal length: a camera {settings.distance:g} eye distances away is assumed")
    return assumed, 0.0


def _start(task: _Task, given: Pose | None) -> View:
    """The better of the closed form and a given pose, with zero coefficients."""
    problem = task.problem
    zero = np.zeros(len(problem.directions))
    # A nearer camera shows what is in front larger: the offset is that of the picture, not of the depth zero.
    views = [
        View(pose.rotation, max(pose.scale, 1e-6), pose.offset, problem.nearness[0], zero)
        for pose in (task.pose, given)
        if pose is not None and np.isfinite(pose.rotation).all()
    ]
    return min(views, key=lambda view: view_cost(problem, view))


def _sliding(ready: _Ready, known: NDArray[np.intp]) -> Follow | None:
    """What renews the jaw's vertices after a step, or None where the model has no jaw points."""
    on_jaw = np.flatnonzero((known < JAW_POINTS) & (known != CHIN))
    if len(on_jaw) == 0:
        return None
    lines = _lines(ready.model)[known[on_jaw]]
    means = ready.model.mean[lines].astype(np.float64)
    directions = ready.model.directions[ready.used][:, lines].astype(np.float64)
    side = known[on_jaw]

    def follow(problem: Problem, view: View) -> Problem:
        shape = means + np.tensordot(view.x, directions, axes=1)
        placed = shape @ view.rotation.T
        flat = placed[..., :2] / np.maximum(1 - placed[..., 2:] * view.near, 0.05)
        chosen = seen(flat, view.rotation[:2, 0], side)
        every = np.arange(len(on_jaw))
        mean, moves = problem.mean.copy(), problem.directions.copy()
        mean[on_jaw], moves[:, on_jaw] = means[every, chosen], directions[:, every, chosen]
        return Problem(**{**problem.__dict__, "mean": mean, "directions": moves})

    return follow


@lru_cache(maxsize=16)
def _lines(model: MorphableModel) -> NDArray[np.intp]:
    lines: NDArray[np.intp] = jaw_lines(model)
    return lines


def _mesh(ready: _Ready, task: _Task, solution: Solution, index: int) -> Mesh:
    view, problem, model = solution.views[index], solution.problems[index], ready.model
    coefficients = np.zeros(len(model.identity) + len(model.expression))
    coefficients[ready.used] = view.x
    vertices = view.scale * model.vertices(coefficients) @ view.rotation.T
    vertices[:, :2] += view.offset
    errors = np.zeros(task.count)
    errors[task.known] = np.linalg.norm(residuals(problem, view), axis=1)
    trust = 1 / np.square(1 + np.square(errors[task.known] / max(problem.robust * problem.pixel, 1e-9)))
    residual = float(np.sqrt(np.average(np.square(errors[task.known]), weights=np.maximum(trust, 1e-12))))
    if residual > _POOR * view.scale:
        warn(f"the model {model.name!r} lies {residual:.1f} pixels from the landmarks: it does not fit them")
    if not solution.converged:
        warn(f"the fit had not come to rest after {len(solution.costs) - 1} steps")
    split = len(model.identity)
    return Mesh(
        vertices=vertices.astype(np.float32),
        triangles=model.triangles,
        normals=vertex_normals(vertices, model.triangles),
        camera=Camera(center=task.center, nearness=view.near / view.scale),
        interocular=_between_eyes(model, vertices, view.scale),
        uv=model.uv,
        mirror=mirror_vertices(model),
        facemesh=model.landmarks.get("facemesh468"),
        fit=FitRecord(
            model=model.name,
            identity=coefficients[:split].astype(np.float32),
            expression=coefficients[split:].astype(np.float32),
            rotation=view.rotation,
            scale=view.scale,
            distance=1 / view.near if view.near > 0 else 0.0,
            residual=residual,
            errors=errors.astype(np.float32),
            costs=np.asarray(solution.costs, np.float32),
            condition=solution.condition,
            converged=solution.converged,
        ),
    )


def _between_eyes(model: MorphableModel, vertices: Array, scale: float) -> float:
    """Distance of the outer eye corners of the fitted face, pixels at its depth."""
    for scheme, corners in EYE_CORNERS.items():
        at = model.landmarks.get(scheme)
        if at is not None and min(at[corners[0]], at[corners[1]]) >= 0:
            return float(np.linalg.norm(vertices[at[corners[0]]] - vertices[at[corners[1]]]))
    return scale
