"""A random person: shape, skin, hair and relief, which stay the same in every expression."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphface.nodes.learning.rendering.head_model import HeadModel, normals_of
from graphface.nodes.learning.rendering.noise import Values
from graphface.nodes.learning.rendering.relief import relief
from graphface.nodes.learning.rendering.scene import Body
from graphface.nodes.learning.rendering.skin import Coat, coat


@dataclass(frozen=True)
class Person:
    """Who is rendered: the coarse vertices `shape` (N, 3) without expression, centimetres; `coat`; `height` (M,) of
    hair and relief above the refined vertices, centimetres."""

    shape: Values
    coat: Coat
    height: Values


def random_shape(model: HeadModel, random: np.random.Generator) -> Values:
    """Coarse vertices (N, 3) of a random identity, without expression."""
    weights = random.normal(size=len(model.identity)) * random.uniform(0.6, 1.15)
    weights[40:] *= 0.5
    return np.asarray(model.mean + np.tensordot(weights.astype(np.float32), model.identity, 1))


def dressed(model: HeadModel, shape: Values, random: np.random.Generator) -> Person:
    """Somebody of this shape, with random skin, hair and relief."""
    rest = model.refinement @ model.mean
    clothing = coat(model, rest, random)
    bumps = relief(model, rest, random) if random.uniform() < 0.9 else np.zeros(len(rest))
    return Person(shape, clothing, clothing.thickness + bumps * (1 - clothing.hair))


def expressed(model: HeadModel, person: Person, expression: Mapping[str, float]) -> tuple[Body, Values]:
    """The person with an expression, weights by name; and the 68 landmarks (68, 3)."""
    moved = person.shape.copy()
    for name, weight in expression.items():
        moved += weight * model.expression[model.names.index(name)]
    vertices = model.refinement @ moved
    vertices = vertices + person.height[:, None] * normals_of(vertices, model.triangles)
    normals, worn = normals_of(vertices, model.triangles), person.coat
    body = Body(vertices, normals, model.triangles, worn.albedo, worn.roughness, worn.specular)
    return body, moved[model.landmarks]
