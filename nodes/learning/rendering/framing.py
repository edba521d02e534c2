"""How a head is held before the camera, and where the camera stands."""

from __future__ import annotations

import numpy as np

from graphface.nodes.harmonics import rotation_matrix
from graphface.nodes.learning.rendering.noise import Values
from graphface.nodes.learning.rendering.scene import Body, View


def turned(
    body: Body, landmarks: Values, random: np.random.Generator, *, scale: float = 1.0
) -> tuple[Body, Values, dict[str, float]]:
    """The body and its landmarks (68, 3), turned about their middle; and yaw, pitch and roll in degrees.

    Args:
        scale: of the angles; at 1 a third of the heads is turned by more than 17 degrees.
    """
    yaw = float(np.clip(random.normal() * 17, -45, 45)) * scale
    pitch, roll = float(np.clip(random.normal() * 8, -22, 22)) * scale, float(random.normal() * 6) * scale
    turn, middle = rotation_matrix(yaw, pitch, roll), landmarks.mean(axis=0)
    moved = Body(
        (body.vertices - middle) @ turn.T + middle,
        body.normals @ turn.T,
        body.triangles,
        body.albedo,
        body.roughness,
        body.specular,
    )
    return moved, (landmarks - middle) @ turn.T + middle, {"yaw": yaw, "pitch": pitch, "roll": roll}


def framed(landmarks: Values, random: np.random.Generator, size: int, *, room: float = 1.0) -> View:
    """A camera that frames the face; far away with a long lens, or near as for a selfie.

    Args:
        room: at 1 the face fills the height; larger values show more around it.
    """
    u = random.uniform
    middle = landmarks.mean(axis=0)
    height = float(np.linalg.norm(landmarks[8] - landmarks[27]))
    angle = np.radians(u(9, 26))
    distance = room * u(0.82, 1.08) * height / np.tan(angle / 2)
    origin = middle + np.array([u(-1, 1), u(-2, 2), distance])
    target = middle + np.array([u(-0.8, 0.8), u(0.04, 0.16) * height, 0])
    back = (origin - target) / np.linalg.norm(origin - target)
    right = np.cross([0, 1, 0], back)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(back, right), back])
    return View(origin, axes, size / 2 / float(np.tan(angle / 2)), size, float((origin - middle) @ back))
