"""The average face in the pose of the landmarks."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit import fit
from graphface.nodes.morphable.fit_problem import CameraChoice, Settings
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.types import Image, Landmarks, Mesh

Distance = Annotated[float, Field(ge=3, le=1000)]


Fraction = Annotated[float, Field(gt=0, le=10)]


Steps = Annotated[int, Field(ge=0, le=1000)]


@node("geometry.average")
def average(
    landmarks: Landmarks,
    photo: Image | None = None,
    model: MorphableModel | None = None,
    *,
    camera: CameraChoice = "weak",
    distance: Distance = 10.0,
    robust: Fraction = 0.1,
    steps: Steps = 20,
) -> Mesh:
    """The average face in the pose of the landmarks: the paper's ablation of identity and expression.

    Arguments, result and errors are those of `geometry.morphable`.
    """
    settings = Settings(camera, distance, robust=robust, identity=0, expression=0, steps=steps)
    return fit(model or builtin_model(), landmarks, settings, photo)
