"""Minimize the distance between a model's landmark vertices and the points found, plus a prior on the coefficients.

    sum_i h(|project(s R F_i(x) + t) - l_i|^2 / (s0 noise)^2)  +  strength * (-log p(x))  +  (n - n0)^2 / dn^2

over turn R, size s, offset t, inverse distance n and coefficients x = (identity, expression), by Levenberg and
Marquardt with analytic derivatives. h is Geman and McClure's robust loss, handled by reweighting; p the mixture of the
paper, handled by its quadratic bound (`prior.quadratic`). Several photographs of one person are solved together: each
has its own pose and expression, all have one identity. Everything is float64, y up, in pixels from
the principal point.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.pose import turned
from graphface.nodes.morphable.prior import Prepared, quadratic

Array = NDArray[np.float64]


POSE = 7
"""Parameters of a view before its coefficients: turn (3), logarithm of the size, offset (2), inverse distance."""


NEAREST = 1 / 3
"""The camera is kept at least three eye distances away."""


_LEAST_DEPTH = 0.05
"""Denominator 1 - z n is kept above this: no vertex comes nearer to the camera than a twentieth of its distance."""


@dataclass(frozen=True)
class Problem:
    """What is fitted to what, in one photograph.

    `mean` (L, 3) and `directions` (K, L, 3) of the landmark vertices; `points` (L, 2) y up; `weights` (L,).
    `noise` of a point and `robust`, the error from which it loses influence, in outer-eye-corner distances; `pixel`,
    how many pixels that distance has. `nearness` = (n0, dn): inverse camera distance and how far it may stray; (0, 0)
    is the weak perspective.
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
    """Where the search is in one photograph: `rotation`, `scale`, `offset`, `near` (inverse distance) and `x` (K,)."""

    rotation: Array
    scale: float
    offset: Array
    near: float
    x: Array


Follow = Callable[[Problem, View], Problem]
"""Given a view, its problem with correspondences renewed: contours slide."""


@dataclass(frozen=True)
class Solution:
    """The best views, the cost at every accepted step, and how well the last step was determined.

    `condition` of the normal equations with every parameter in its own best unit; `converged` where the cost rested.
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
    follow: Follow | None = None,
) -> Solution:
    """Search from `start`.

    Args:
        steps: at most so many accepted or refused steps.
        tolerance: relative decrease of the cost below which the search rests.
        shared: the first so many coefficients are the same in all views.
        follow: renews the correspondences after every accepted step; in the second half of the steps they are held, so
            that the search comes to rest where two candidates take turns.
    """
    views, problems = list(start), list(problems)
    columns = _columns([len(v.x) for v in views], shared)
    size = 1 + max(int(c.max()) for c in columns)
    damping, converged = 1e-3, False
    cost = sum(map(view_cost, problems, views))
    costs = [cost]
    hessian, gradient = _assembled(problems, views, columns, size)
    for step_number in range(steps):
        damped = hessian + np.diag(damping * np.maximum(np.diag(hessian), 1e-12))
        step = np.asarray(-np.linalg.solve(damped, gradient), np.float64)
        trial = [_moved(p, v, step[c]) for p, v, c in zip(problems, views, columns, strict=True)]
        trial_cost = sum(map(view_cost, problems, trial))
        if not trial_cost <= cost:  # also where it is not a number
            damping *= 6
            if damping > 1e8:
                converged = True
                break
            continue
        rested = cost - trial_cost <= tolerance * max(abs(cost), 1e-9)
        views, cost, damping = trial, trial_cost, max(damping / 6, 1e-9)
        if follow is not None and step_number < steps // 2:
            problems = [follow(p, v) for p, v in zip(problems, views, strict=True)]
            cost = sum(map(view_cost, problems, views))
        costs.append(cost)
        if rested:
            converged = True
            break
        hessian, gradient = _assembled(problems, views, columns, size)
    return Solution(tuple(views), tuple(problems), tuple(costs), _condition(hessian), converged)


def view_cost(problem: Problem, view: View) -> float:
    """The sum above, of one photograph."""
    squared = np.square(residuals(problem, view)).sum(axis=1) / (problem.noise * problem.pixel) ** 2
    width = (problem.robust / problem.noise) ** 2
    data = 0.5 * float(problem.weights @ (squared * (width / (width + squared))))
    penalty = problem.strength * quadratic(problem.prior, view.x)[0]
    n0, dn = problem.nearness
    return data + penalty + (0.5 * ((view.near - n0) / dn) ** 2 if dn > 0 else 0.0)


def residuals(problem: Problem, view: View) -> Array:
    """Projection minus point, (L, 2) pixels."""
    return _face(problem, view)[2] - problem.points


def _face(problem: Problem, view: View) -> tuple[Array, Array, Array]:
    """Landmark vertices turned and scaled (L, 3), the denominators (L,), and the projections (L, 2)."""
    shape = problem.mean + np.tensordot(view.x, problem.directions, axes=1)
    placed = view.scale * shape @ view.rotation.T
    away = np.maximum(1 - placed[:, 2] * (view.near / view.scale), _LEAST_DEPTH)
    return placed, away, (placed[:, :2] + view.offset) / away[:, None]


def _normal_equations(problem: Problem, view: View) -> tuple[Array, Array]:
    """Hessian and gradient of one photograph: pose (7), then coefficients (K)."""
    placed, away, projected = _face(problem, view)
    count = len(view.x)
    moves = np.zeros((POSE + count, len(placed), 3))
    # A turn w moves p by w x p.
    moves[0, :, 1], moves[0, :, 2] = -placed[:, 2], placed[:, 1]
    moves[1, :, 0], moves[1, :, 2] = placed[:, 2], -placed[:, 0]
    moves[2, :, 0], moves[2, :, 1] = -placed[:, 1], placed[:, 0]
    moves[4, :, 0] = moves[5, :, 1] = 1
    moves[POSE:] = problem.directions @ (view.scale * view.rotation.T)
    slopes = (moves[..., :2] + (view.near / view.scale) * projected * moves[..., 2:]) / away[:, None]
    slopes[3] = placed[:, :2] / away[:, None]  # growing leaves z n as it is: distance counts in the face's own size
    slopes[6] = projected * (placed[:, 2] / view.scale / away)[:, None]

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
        gradient[6] += (view.near - n0) / dn**2
        hessian[6, 6] += 1 / dn**2
    else:
        hessian[6], hessian[:, 6], hessian[6, 6], gradient[6] = 0, 0, 1, 0
    # Where the points say nothing of the pose (all on one line, say) it stays.
    turns, offsets = np.arange(4), np.arange(4, 6)
    hessian[turns, turns] += 1e-9 * max(float(hessian[turns, turns].max()), 1e-9)
    hessian[offsets, offsets] += 1e-9 * max(float(hessian[offsets, offsets].max()), 1e-9)
    return hessian, gradient


def _columns(counts: Sequence[int], shared: int) -> list[NDArray[np.intp]]:
    """Where the parameters of each view stand among all: shared coefficients last."""
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


def _moved(problem: Problem, view: View, step: Array) -> View:
    angle = float(np.linalg.norm(step[:3]))
    turn = step[:3] * min(1.0, 1.0 / max(angle, 1e-12))  # at most a radian at a time
    near = view.near
    if problem.nearness[1] > 0:
        near = float(np.clip(near + step[6], 0, NEAREST))
    return replace(
        view,
        rotation=turned(view.rotation, turn),
        scale=view.scale * float(np.exp(np.clip(step[3], -1, 1))),
        offset=view.offset + step[4:6],
        near=near,
        x=view.x + step[POSE:],
    )


def _condition(hessian: Array) -> float:
    """Condition number with every parameter in its own best unit."""
    scale = 1 / np.sqrt(np.maximum(np.diag(hessian), 1e-300))
    values = np.linalg.eigvalsh(hessian * scale[:, None] * scale)
    return float(values[-1] / max(values[0], values[-1] * 1e-16, 1e-300))
