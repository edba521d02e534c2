"""The container of a linear 3-D face model: F(a, b) = mean + sum_k a_k identity_k + sum_k b_k expression_k.

Every source (learned here, ICT-FaceKit, Surrey, FLAME, Basel) is converted to one form when it is read:

- axes: x to the picture's right, y up, z out of the face; the unit is the distance between the outer eye corners;
- a coefficient of 1 is one standard deviation of the population: bases are multiplied by their deviations;
- triangles are counter-clockwise seen from outside; they close eyes and mouth, and cover the face alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError
from graphface.nodes.landmark_schemes import POINTS
from graphface.nodes.morphable.prior import Mixture
from graphface.nodes.types import FloatArray

EYE_CORNERS = {"facemesh468": (33, 263), "ibug68": (36, 45)}
"""Numbers of the outer eye corners in each scheme; their distance is the unit of length."""


class InvalidModel(UsageError):
    """A face model whose parts do not agree; `model` is its name, `reason` the disagreement."""

    def __init__(self, model: str, reason: str) -> None:
        self.model = model
        self.reason = reason
        super().__init__(f"face model {model!r}: {reason}")


@dataclass(frozen=True)
class Basis:
    """Directions of variation among faces.

    `directions` float32 (K, V, 3): displacement of every vertex for a coefficient of 1, one standard deviation;
    `deviations` float32 (K,): that deviation in the source's own units, to convert coefficients back; `names` (K,).
    """

    directions: FloatArray
    deviations: FloatArray
    names: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.directions)


@dataclass(frozen=True, eq=False)
class MorphableModel:
    """A linear face model.

    `mean` float32 (V, 3); `triangles` int32 (T, 3); `landmarks` scheme to int32 (n,) vertices, -1 where the model lacks
    a point; `uv` float32 (V, 2) in [0, 1], v up; `parts` int32 (V,) numbers into `part_names`; `prior` over
    (identity, expression) together, None where only the deviations are known; `card` describes the origin.
    """

    name: str
    mean: FloatArray
    triangles: NDArray[np.int32]
    identity: Basis
    expression: Basis
    landmarks: Mapping[str, NDArray[np.int32]]
    uv: FloatArray | None = None
    parts: NDArray[np.int32] | None = None
    part_names: tuple[str, ...] = ()
    prior: Mixture | None = None
    card: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        reason = _problem(self)
        if reason is not None:
            raise InvalidModel(self.name, reason)

    def flaw(self) -> str | None:
        """Why its parts do not agree."""
        return _problem(self)

    def vertices(self, coefficients: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
        """The face (V, 3) of (identity, expression) coefficients; missing ones are zero."""
        directions = self.directions[: len(coefficients)].reshape(len(coefficients), self.mean.size)
        moved = np.asarray(coefficients, np.float32) @ directions
        face: NDArray[np.float64] = self.mean.astype(np.float64) + moved.reshape(-1, 3)
        return face

    @cached_property
    def directions(self) -> FloatArray:
        """Identity, then expression: float32 (K, V, 3)."""
        return np.concatenate([self.identity.directions, self.expression.directions])


def no_basis(vertices: int) -> Basis:
    """A basis without directions."""
    return Basis(np.zeros((0, vertices, 3), np.float32), np.zeros(0, np.float32), ())


def _problem(model: MorphableModel) -> str | None:
    """The first disagreement between parts of a model, or None."""
    checks = (_mesh_problem, _basis_problem, _landmark_problem, _attribute_problem)
    return next((reason for check in checks if (reason := check(model)) is not None), None)


def _mesh_problem(model: MorphableModel) -> str | None:
    count = len(model.mean)
    if model.mean.ndim != 2 or model.mean.shape[1] != 3 or count < 4:
        return f"mean has the shape {model.mean.shape}, expected (V, 3) with at least 4 vertices"
    if model.triangles.ndim != 2 or model.triangles.shape[1] != 3:
        return f"triangles have the shape {model.triangles.shape}, expected (T, 3)"
    if model.triangles.size and not 0 <= model.triangles.min() <= model.triangles.max() < count:
        return f"triangles name vertices outside 0..{count - 1}"
    if not np.isfinite(model.mean).all():
        return "mean has values that are not numbers"
    return None


def _basis_problem(model: MorphableModel) -> str | None:
    count = len(model.mean)
    for kind, basis in (("identity", model.identity), ("expression", model.expression)):
        if basis.directions.shape[1:] != (count, 3):
            return f"{kind} directions have the shape {basis.directions.shape}, expected (K, {count}, 3)"
        if len(basis.deviations) != len(basis) or len(basis.names) != len(basis):
            return f"{kind} has {len(basis)} directions, {len(basis.deviations)} deviations, {len(basis.names)} names"
        if not np.isfinite(basis.directions).all():
            return f"{kind} directions have values that are not numbers"
    return None


def _landmark_problem(model: MorphableModel) -> str | None:
    count = len(model.mean)
    if not model.landmarks:
        return "no landmark scheme; nothing could be fitted"
    for scheme, vertices in model.landmarks.items():
        if len(vertices) != POINTS.get(scheme, -1):
            return f"landmarks {scheme!r} has {len(vertices)} vertices, expected {POINTS.get(scheme, 'a known scheme')}"
        if vertices.max() >= count or vertices.min() < -1 or (vertices >= 0).sum() < 6:
            return f"landmarks {scheme!r} must name at least 6 vertices in 0..{count - 1} (-1: absent)"
    return None


def _attribute_problem(model: MorphableModel) -> str | None:
    count = len(model.mean)
    if model.uv is not None and model.uv.shape != (count, 2):
        return f"uv has the shape {model.uv.shape}, expected ({count}, 2)"
    if model.parts is not None and len(model.parts) != count:
        return f"parts has {len(model.parts)} numbers, expected {count}"
    wanted = len(model.identity) + len(model.expression)
    if model.prior is not None and model.prior.means.shape[1] != wanted:
        return f"the prior is over {model.prior.means.shape[1]} coefficients, the model has {wanted}"
    return None
