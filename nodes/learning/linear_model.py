"""Learning a linear face model from FaceMesh points on photographs, as the built-in model was.

1. Every face is aligned to the mean by position, size and rotation (Procrustes). Its mirror image is added, so that the
   model is symmetric.
2. Expression: principal components of the photographs of one person about that person's mean.
3. Identity: principal components of one photograph each of many people, after expression is projected out.
4. The prior: a Gaussian mixture of the coefficients of all training faces.

The network's depth is that of a camera at infinity, so no camera is estimated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError
from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468
from graphface.nodes.learning.coefficient_prior import fit_mixture
from graphface.nodes.morphable.align import aligned, procrustes_mean
from graphface.nodes.morphable.model import Basis, MorphableModel, no_basis
from graphface.nodes.morphable.topology import Topology, cylinder, facemesh_topology

Array = NDArray[np.float64]


_MIN_FACING = np.cos(np.radians(30))
"""Faces rotated by more than this are left out: the network's points shift with the rotation."""


_MIN_PER_PERSON = 3
"""Least number of photographs of a person for a mean of that person."""


@dataclass(frozen=True)
class Figures:
    """Figures of one training.

    `faces`, `people` and `photos_of_people`: numbers used. `left`: root mean square distance between a training face
    and its best approximation; `left_unseen`: the same for portraits outside the training set (5-fold
    cross-validation). Both are in per cent of the distance between the outer eye corners.
    """

    faces: int
    people: int
    photos_of_people: int
    left: float
    left_unseen: float
    components: int


def learn_model(
    name: str, faces: Array, of_people: Array, people: Sequence[str], *, identity: int, expression: int
) -> tuple[MorphableModel, Figures]:
    """A model on the 468 points and the triangles of `facemesh_topology`.

    Args:
        faces: (F, 468, 3), one photograph per person; pixels, y up.
        of_people: (P, 468, 3), several photographs of each of some people; may be empty.
        people: P names, of the person in each of these.
        identity, expression: numbers of components.

    Raises:
        UsageError: too few faces for so many components.
    """
    topology = facemesh_topology()
    mean = procrustes_mean(faces, topology.mean.astype(np.float64))
    mean = (mean + _mirrored(mean, topology)) / 2
    portraits, photos, names = _frontal(faces, mean), of_people, list(people)
    photos, names = _frontal_of_people(photos, names, mean)
    if len(portraits) < 2 * identity:
        raise UsageError(
            f"{len(portraits)} usable portraits (rotated less than 30 degrees) are too few for {identity} identity "
            f"components; give at least {2 * identity}, or ask for fewer with --identity"
        )
    within = _within_people(photos, names, topology)
    if len(within) < 2 * expression:
        raise UsageError(
            f"{len(within) // 2} photographs of people with at least {_MIN_PER_PERSON} each are too few for "
            f"{expression} expression components; give more with --people, or ask for none with --expression 0"
        )
    learned = _components(portraits, within, mean, topology, identity, expression)
    directions = learned.directions.reshape(identity + expression, -1)
    samples = _coefficients(np.concatenate([portraits, photos]), learned.mean, directions)
    prior = fit_mixture(samples)
    model = MorphableModel(
        name=name,
        mean=learned.mean.astype(np.float32),
        triangles=topology.triangles,
        identity=_basis(learned.directions[:identity], "identity"),
        expression=_basis(learned.directions[identity:], "expression"),
        landmarks={
            "facemesh468": np.arange(468, dtype=np.int32),
            "ibug68": IBUG68_IN_FACEMESH468.astype(np.int32),
        },
        uv=cylinder(topology.mean).astype(np.float32),
        prior=prior,
    )
    figures = Figures(
        faces=len(portraits),
        people=len(set(names)),
        photos_of_people=len(photos),
        left=_left(portraits, learned.mean, directions),
        left_unseen=_left_unseen(portraits, within, mean, topology, identity, expression),
        components=len(prior.weights),
    )
    return model, figures


@dataclass(frozen=True)
class _Components:
    mean: Array
    directions: Array


def _components(
    portraits: Array, within: Array, mean: Array, topology: Topology, identity: int, expression: int
) -> _Components:
    """Mean (V, 3) and directions (K, V, 3), identity first, scaled to one standard deviation."""
    shape = mean.shape
    expressions, deviations = _principal(within.reshape(len(within), mean.size), expression)
    both = np.concatenate([portraits, _mirrored(portraits, topology)])
    differences = (both - mean).reshape(len(both), -1)
    neutral = differences - differences @ expressions.T @ expressions
    offset = neutral.mean(axis=0)
    identities, spreads = _principal(neutral - offset, identity)
    directions = np.concatenate([identities * spreads[:, None], expressions * deviations[:, None]])
    return _Components(mean + offset.reshape(shape), directions.reshape(-1, *shape))


def _principal(rows: Array, count: int) -> tuple[Array, Array]:
    """The first principal directions (count, N) of rows about zero, and their standard deviations."""
    if count == 0:
        return np.zeros((0, rows.shape[1])), np.zeros(0)
    _, sizes, directions = np.linalg.svd(rows, full_matrices=False)
    return directions[:count], np.maximum(sizes[:count] / np.sqrt(max(len(rows), 1)), 1e-9)


def _within_people(photos: Array, names: Sequence[str], topology: Topology) -> Array:
    """Photographs minus their person's mean, and their mirror images; scaled by sqrt(n / (n - 1)), since the mean is
    estimated from them."""
    labels, differences = np.asarray(names), []
    for person in np.unique(labels):
        own = photos[labels == person]
        if len(own) >= _MIN_PER_PERSON:
            differences.append((own - own.mean(axis=0)) * np.sqrt(len(own) / (len(own) - 1)))
    if not differences:
        return np.zeros((0, len(topology.mean), 3))
    rows = np.concatenate(differences)
    return np.concatenate([rows, _mirrored(rows, topology)])


def _frontal(shapes: Array, mean: Array) -> Array:
    upright, rotations = aligned(shapes, mean)
    frontal: Array = upright[rotations[:, 2, 2] > _MIN_FACING]
    return frontal


def _frontal_of_people(photos: Array, names: list[str], mean: Array) -> tuple[Array, list[str]]:
    if len(photos) == 0:
        return photos.reshape(0, *mean.shape), []
    upright, rotations = aligned(photos, mean)
    keep = rotations[:, 2, 2] > _MIN_FACING
    return upright[keep], [name for name, kept in zip(names, keep, strict=True) if kept]


def _mirrored(shapes: Array, topology: Topology) -> Array:
    mirrored: Array = shapes[..., topology.mirror, :] * (-1, 1, 1)
    return mirrored


def _coefficients(shapes: Array, mean: Array, directions: Array) -> Array:
    """Least-squares coefficients (F, K)."""
    differences = (shapes - mean).reshape(len(shapes), -1)
    return np.asarray(np.linalg.lstsq(directions.T, differences.T, rcond=None)[0].T, np.float64)


def _left(shapes: Array, mean: Array, directions: Array) -> float:
    """Root mean square distance, in per cent of the unit, between shapes and their best approximation."""
    rest = (shapes - mean).reshape(len(shapes), -1) - _coefficients(shapes, mean, directions) @ directions
    return float(100 * np.sqrt(np.square(rest.reshape(shapes.shape)).sum(axis=2).mean()))


def _left_unseen(
    portraits: Array, within: Array, mean: Array, topology: Topology, identity: int, expression: int, folds: int = 5
) -> float:
    squares = []
    for fold in range(folds):
        held = np.arange(len(portraits)) % folds == fold
        learned = _components(portraits[~held], within, mean, topology, identity, expression)
        directions = learned.directions.reshape(len(learned.directions), -1)
        squares.append(_left(portraits[held], learned.mean, directions) ** 2)
    return float(np.sqrt(np.mean(squares)))


def _basis(directions: Array, kind: str) -> Basis:
    if len(directions) == 0:
        return no_basis(directions.shape[1])
    deviations = np.sqrt(np.square(directions).sum(axis=(1, 2)))
    names = tuple(f"{kind} {k}" for k in range(len(directions)))
    return Basis(directions.astype(np.float32), deviations.astype(np.float32), names)
