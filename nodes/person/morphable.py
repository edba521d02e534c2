"""Several photographs of one person, fitted together."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import UsageError, node
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit import fit_together
from graphface.nodes.morphable.fit_problem import CameraChoice, PriorChoice, Settings
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.types import Landmarks, Mesh

Distance = Annotated[float, Field(ge=3, le=1000)]


Strength = Annotated[float, Field(gt=0, le=1e6)]


Fraction = Annotated[float, Field(gt=0, le=10)]


Steps = Annotated[int, Field(ge=0, le=1000)]


@node("person.morphable")
def person(
    landmarks: list[Landmarks],
    model: MorphableModel | None = None,
    *,
    camera: CameraChoice = "weak",
    distance: Distance = 10.0,
    prior: PriorChoice = "mixture",
    strength: Strength = 1.0,
    noise: Fraction = 0.03,
    robust: Fraction = 0.1,
    steps: Steps = 30,
) -> list[Mesh]:
    """Several photographs of one person fitted together: a pose and an expression each, one identity.

    Arguments and errors are those of `geometry.morphable`; one mesh for each element of `landmarks`.
    """
    if not landmarks:
        raise UsageError("person.morphable needs the landmarks of at least one photograph, got an empty list")
    settings = Settings(camera, distance, prior, strength, noise, robust, steps=steps)
    return fit_together(model or builtin_model(), landmarks, settings)
