"""The weights of the normals network from rendered examples: `graphface models normals`."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from graphface import UnreadableFile
from graphface.nodes.learning.normal_lessons import Lesson, lessons_of
from graphface.nodes.learning.normal_training import Pictures, trained
from graphface.nodes.learning.unet_training import folded
from graphface.nodes.surface.normal_network import COVERAGE, NORMALS

_ASTRAY = 25.0
"""Degrees between fitted and true normals, in the mean, from which a face was not found where it is."""


def learn_normals(folder: Path, *, minutes: float, threads: int = 1) -> tuple[dict[str, Any], dict[str, Any]]:
    """Weights for `surface.refined`, and their card.

    What the network sees is computed by the shipped graph, and kept in FOLDER/seen: again after a change of the graph
    or of its operators only.

    Args:
        folder: of examples, from `graphface models render`. minutes: of training, after the examples are read.

    Raises:
        UnreadableFile: there is no example with a face. UsageError: PyTorch is not installed.
    """
    lessons = [lesson for lesson in lessons_of(folder) if _off(lesson) < _ASTRAY]
    if len(lessons) < 2:
        raise UnreadableFile(folder, "holds no two examples in which a face is found")
    pictures = Pictures(
        **{part.name: np.stack([getattr(lesson, part.name) for lesson in lessons]) for part in fields(Lesson)}
    )
    state, figures = trained(pictures, minutes=minutes, threads=threads)
    return folded(state), {"examples": len(lessons), **figures}


def _off(lesson: Lesson) -> float:
    """Mean angle between fitted and true normals on skin, degrees."""
    on = lesson.weight > 0.5
    if not on.any():
        return 180.0
    fitted, true = (part[on].astype(np.float32) for part in (lesson.seen[..., NORMALS:COVERAGE], lesson.normals))
    return float(np.degrees(np.arccos(np.clip((fitted * true).sum(axis=1), -1, 1))).mean())
