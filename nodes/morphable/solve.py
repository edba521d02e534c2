"""The fit of a model to landmarks: least squares of the landmarks' distances, plus a prior on the coefficients.

    sum_i w_i h(|project(s R F_i(x) + t) - l_i|^2 / (s0 noise)^2)  +  strength * (-log p(x))  +  (n - n0)^2 / dn^2

is minimized over rotation R, scale s, offset t, inverse camera distance n and coefficients x = (identity, expression),
by Levenberg and Marquardt with analytic derivatives. h is the robust loss of Geman and McClure, handled by reweighting;
p is the mixture of the paper, handled by its quadratic bound (`prior.quadratic`). Several photographs of one person are
solved together: each has its own pose and expression, all have one identity. Everything is float64, y up, in pixels
from the principal point.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.pose import rotated
from graphface.nodes.morphable.prior import Prepared, quadratic

Array = NDArray[np.float64]


POSE = 7
"""Parameters of a view before its coefficients: rotation (3), logarithm of the scale, offset (2), inverse distance."""


MAX_NEARNESS = 1 / 3
"""Largest inverse camera distance: the camera is at least three eye distances away."""


LEAST_DEPTH = 0.05
"""Least denominator 1 - z n: a vertex is at least a twentieth of the camera's distance in front of it."""


@dataclass(frozen=True)
class Problem:
    """The fit of one photograph.

    `mean` (L, 3) and `directions` (K, L, 3) of the landmark vertices; `points` (L, 2) y up; `weights` w (L,).
    `noise`: standard deviation of a point's error. `robust`: scale of the robust loss. Both are in outer-eye-corner
    distances, of `pixel` pixels each (s0). `nearness` = (n0, dn): expected inverse camera distance and its standard
    deviation; (0, 0) is the weak perspective.
    """

    mean: Array
    directions: Array
    points: Array
    weights: Array
    prior: Prepared
    noise: float
    robust: float
    strength: float
    nearness: tuple[float, float]
    pixel: float


@dataclass(frozen=True)
class View:
    """The unknowns of one photograph: `rotation` R, `scale` s, `offset` t, `nearness` n (inverse camera distance) and
    coefficients `x` (K,)."""

    rotation: Array
    scale: float
    offset: Array
    nearness: float
    x: Array


UpdateProblem = Callable[[Problem, View], Problem]
"""Gives the problem with the correspondences of a view: points of the jaw slide over the face (see `contour`)."""


@dataclass(frozen=True)
class Solution:
    """The best views, their problems with the last correspondences, and the cost after every accepted step.

    `condition`: condition number of the last normal equations, scaled to a unit diagonal. `converged`: the cost
    decreased by less than the tolerance.
    """

    views: tuple[View, ...]
    problems: tuple[Problem, ...]
    costs: tuple[float, ...]
    condition: float
    converged: bool


def solve(
    problems: Sequence[Problem],
    start: Sequence[View],
    *,
    steps: int,
    tolerance: float,
    shared: int = 0,
    updates: Sequence[UpdateProblem | None] = (),
) -> Solution:
    """Minimize the cost of several photographs, from the views `start`.

    Args:
        steps: largest number of accepted and refused steps.
        tolerance: relative decrease of the cost at which the search ends.
        shared: number of leading coefficients that are the same in all views.
        updates: for each photograph, what updates its correspondences after every accepted step, or None. In the second
            half of the steps they are kept, so that the search converges where two candidates alternate.
    """
    views, problems = list(start), list(problems)
    columns = _columns([len(v.x) for v in views], shared)
    size = 1 + max(int(c.max()) for c in columns)
    damping, converged = 1e-3, False
    cost = sum(map(view_cost, problems, views))
    costs = [cost]
    hessian, gradient = _assembled(problems, views, columns, size)
    for number in range(steps):
        damped = hessian + np.diag(damping * np.maximum(np.diag(hessian), 1e-12))
        step = np.asarray(-np.linalg.solve(damped, gradient), np.float64)
        trial = [_stepped(p, v, step[c]) for p, v, c in zip(problems, views, columns, strict=True)]
        trial_cost = sum(map(view_cost, problems, trial))
        if not trial_cost <= cost:  # also where it is NaN
            damping *= 6
            if damping > 1e8:
                converged = True
                break
            continue
        converged = cost - trial_cost <= tolerance * max(abs(cost), 1e-9)
        views, cost, damping = trial, trial_cost, max(damping / 6, 1e-9)
        if any(updates) and number < steps // 2:
            changed = zip(problems, views, updates, strict=True)
            problems = [problem if update is None else update(problem, view) for problem, view, update in changed]
            cost = sum(map(view_cost, problems, views))
        costs.append(cost)
        if converged:
            break
        hessian, gradient = _assembled(problems, views, columns, size)
    return Solution(tuple(views), tuple(problems), tuple(costs), _condition(hessian), converged)


def view_cost(problem: Problem, view: View) -> float:
    """The cost of one photograph, as in the module's formula."""
    squared = np.square(residuals(problem, view)).sum(axis=1) / (problem.noise * problem.pixel) ** 2
    width = (problem.robust / problem.noise) ** 2
    data = 0.5 * float(problem.weights @ (squared * (width / (width + squared))))
    penalty = problem.strength * quadratic(problem.prior, view.x)[0]
    n0, dn = problem.nearness
    return data + penalty + (0.5 * ((view.nearness - n0) / dn) ** 2 if dn > 0 else 0.0)


def residuals(problem: Problem, view: View) -> Array:
    """Projection minus point, (L, 2) pixels."""
    return _projection(problem, view)[2] - problem.points


def _projection(problem: Problem, view: View) -> tuple[Array, Array, Array]:
    """Landmark vertices rotated and scaled (L, 3), the denominators 1 - z n (L,), and the projections (L, 2)."""
    shape = problem.mean + np.tensordot(view.x, problem.directions, axes=1)
    placed = view.scale * shape @ view.rotation.T
    depth = np.maximum(1 - placed[:, 2] * (view.nearness / view.scale), LEAST_DEPTH)
    return placed, depth, (placed[:, :2] + view.offset) / depth[:, None]


def _normal_equations(problem: Problem, view: View) -> tuple[Array, Array]:
    """Hessian and gradient of one photograph: pose (7), then coefficients (K)."""
    placed, depth, projected = _projection(problem, view)
    count = len(view.x)
    moves = np.zeros((POSE + count, len(placed), 3))
    # The derivative of a rotation by w is the cross product w x p.
    moves[0, :, 1], moves[0, :, 2] = -placed[:, 2], placed[:, 1]
    moves[1, :, 0], moves[1, :, 2] = placed[:, 2], -placed[:, 0]
    moves[2, :, 0], moves[2, :, 1] = -placed[:, 1], placed[:, 0]
    moves[4, :, 0] = moves[5, :, 1] = 1
    moves[POSE:] = problem.directions @ (view.scale * view.rotation.T)
    slopes = (moves[..., :2] + (view.nearness / view.scale) * projected * moves[..., 2:]) / depth[:, None]
    slopes[3] = placed[:, :2] / depth[:, None]  # scaling leaves z n unchanged: n is relative to the face's size
    slopes[6] = projected * (placed[:, 2] / view.scale / depth)[:, None]

    residual = projected - problem.points
    unit = (problem.noise * problem.pixel) ** 2
    squared = np.square(residual).sum(axis=1) / unit
    width = (problem.robust / problem.noise) ** 2
    weight = problem.weights * np.square(width / (width + squared)) / unit
    flat = slopes.reshape(POSE + count, -1)
    weighted = flat * np.repeat(weight, 2)
    hessian, gradient = weighted @ flat.T, weighted @ residual.reshape(-1)

    _, pull, bound = quadratic(problem.prior, view.x)
    gradient[POSE:] += problem.strength * pull
    hessian[POSE:, POSE:] += problem.strength * bound
    n0, dn = problem.nearness
    if dn > 0:
        gradient[6] += (view.nearness - n0) / dn**2
        hessian[6, 6] += 1 / dn**2
    else:
        hessian[6], hessian[:, 6], hessian[6, 6], gradient[6] = 0, 0, 1, 0
    # A small ridge keeps a pose parameter unchanged that the points do not determine (if all lie on a line).
    turns, offsets = np.arange(4), np.arange(4, 6)
    hessian[turns, turns] += 1e-9 * max(float(hessian[turns, turns].max()), 1e-9)
    hessian[offsets, offsets] += 1e-9 * max(float(hessian[offsets, offsets].max()), 1e-9)
    return hessian, gradient


def _columns(counts: Sequence[int], shared: int) -> list[NDArray[np.intp]]:
    """Positions of each view's parameters among those of all views; shared coefficients are last."""
    own = [POSE + count - shared for count in counts]
    starts = np.concatenate([[0], np.cumsum(own)])
    common = starts[-1] + np.arange(shared)
    return [
        np.concatenate([s + np.arange(POSE), common, s + np.arange(POSE, n)]).astype(np.intp)
        for s, n in zip(starts[:-1], own, strict=True)
    ]


def _assembled(
    problems: Sequence[Problem], views: Sequence[View], columns: Sequence[NDArray[np.intp]], size: int
) -> tuple[Array, Array]:
    hessian, gradient = np.zeros((size, size)), np.zeros(size)
    for problem, view, at in zip(problems, views, columns, strict=True):
        own_hessian, own_gradient = _normal_equations(problem, view)
        hessian[at[:, None], at] += own_hessian
        gradient[at] += own_gradient
    return hessian, gradient


def _stepped(problem: Problem, view: View, step: Array) -> View:
    """The view after a step; a step rotates by at most a radian."""
    angle = float(np.linalg.norm(step[:3]))
    vector = step[:3] * min(1.0, 1.0 / max(angle, 1e-12))
    nearness = view.nearness
    if problem.nearness[1] > 0:
        nearness = float(np.clip(nearness + step[6], 0, MAX_NEARNESS))
    return replace(
        view,
        rotation=rotated(view.rotation, vector),
        scale=view.scale * float(np.exp(np.clip(step[3], -1, 1))),
        offset=view.offset + step[4:6],
        nearness=nearness,
        x=view.x + step[POSE:],
    )


def _condition(hessian: Array) -> float:
    """Condition number after scaling to a unit diagonal."""
    scale = 1 / np.sqrt(np.maximum(np.diag(hessian), 1e-300))
    values = np.linalg.eigvalsh(hessian * scale[:, None] * scale)
    return float(values[-1] / max(values[0], values[-1] * 1e-16, 1e-300))
