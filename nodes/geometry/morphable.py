"""The paper's face geometry: a linear model fitted to the landmarks."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit import fit
from graphface.nodes.morphable.fit_problem import CameraChoice, PriorChoice, Settings
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.types import Image, Landmarks, Mesh

Distance = Annotated[float, Field(ge=3, le=1000)]


Count = Annotated[int, Field(ge=0)] | None


Strength = Annotated[float, Field(gt=0, le=1e6)]


Fraction = Annotated[float, Field(gt=0, le=10)]


Steps = Annotated[int, Field(ge=0, le=1000)]


@node("geometry.morphable")
def morphable(
    landmarks: Landmarks,
    photo: Image | None = None,
    model: MorphableModel | None = None,
    *,
    camera: CameraChoice = "weak",
    distance: Distance = 10.0,
    prior: PriorChoice = "mixture",
    strength: Strength = 1.0,
    noise: Fraction = 0.03,
    robust: Fraction = 0.1,
    identity: Count = None,
    expression: Count = None,
    slide: bool = True,
    steps: Steps = 20,
    tolerance: Annotated[float, Field(gt=0, le=1)] = 1e-4,
) -> Mesh:
    """A face model fitted to landmarks: pose, identity and expression (paper, section 2, "Face geometry").

    Minimizes the distance between projected landmark vertices and landmarks, plus the negative logarithm of the prior,
    by Levenberg and Marquardt from a closed-form pose.

    Args:
        landmarks: "facemesh468" or "ibug68"; points that are not finite count as missing.
        photo: gives the principal point and, for the camera "exif", the focal length. Without it the principal point is
            the middle of the face.
        model: the built-in one by default; as a graph input, a file that `graphface models import` wrote.
        camera: "weak" perspective; perspective at the "assumed" `distance`; at an "estimated" distance near it; or by
            the photo's "exif". On path-traced heads seen from 9 eye distances the normals of all are the same.
        distance: of the camera, in distances between the outer eye corners (about 9 cm).
        prior: the model's Gaussian "mixture", as in the paper, or the single "gaussian" (Tikhonov).
        strength: weight of the prior; a larger one keeps closer to the average face.
        noise: standard deviation of a landmark's error, in eye distances.
        robust: error from which a landmark loses influence (the scale of the robust loss), in eye distances.
        identity, expression: largest number of components to use; all by default.
        slide: let the points of the jaw ("ibug68") slide to the outline as the head turns.
        steps: largest number of steps. tolerance: relative decrease of the cost at which the search ends.

    Returns:
        The model's mesh in the camera frame, one unit a pixel at the face; `fit` is the record of the fit.

    Raises:
        UnusableLandmarks: fewer than 6 usable points, or all in one place.
        UsageError: the model does not know the landmarks' scheme.
    """
    settings = Settings(camera, distance, prior, strength, noise, robust, identity, expression, slide, steps, tolerance)
    return fit(model or builtin_model(), landmarks, settings, photo)
