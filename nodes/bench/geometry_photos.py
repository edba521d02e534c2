"""How well face models fit photographs: 68 points with large poses, automatic points, and the network's own.

The 68-point pictures (AFLW2000-3D) carry points that lie on the face, the hidden ones too, so the jaw does not slide
there; automatic points are on the outline that is seen, and it does.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import Graph, GraphfaceError, UnreadableFile, warn
from graphface.nodes.bench.geometry_graphs import model_graph, points_graph
from graphface.nodes.bench.geometry_truth import landmark_error
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.pose import yaw_pitch_roll
from graphface.nodes.types import FloatArray, Landmarks

FAILED = 10.0
"""Per cent of the face's size from which a fit counts as failed."""


@dataclass(frozen=True)
class PhotoFit:
    """One photograph: `error` in per cent of the face's size (root of its box's area); yaw in degrees, the fit's and
    the file's (None where the file has none); CPU `milliseconds` of the fit. A fit that was refused has the error 100.
    """

    photo: str
    error: float
    yaw: float
    true_yaw: float | None
    milliseconds: float


@dataclass(frozen=True)
class Residual:
    """What a fit to the network's points leaves: in per cent of the eye distance; CPU `milliseconds` of the fit."""

    photo: str
    per_cent: float
    milliseconds: float


def pose_photos(folder: Path, model: MorphableModel) -> Iterator[PhotoFit]:
    """The model fitted to the 68 points of every .mat of `folder`, and compared with them and with their pose.

    Raises:
        UnreadableFile: there is none.
    """
    from scipy.io import loadmat

    files = sorted(folder.glob("*.mat"))
    if not files:
        raise UnreadableFile(folder, "holds no .mat with 68 points")
    graph = points_graph(slide=False)
    for file in files:
        data = loadmat(file)
        yield _fitted(graph, file.stem, data["pt3d_68"].T, model, -float(np.degrees(data["Pose_Para"][0, 1])))


def automatic_photos(folder: Path, model: MorphableModel, every: int = 1) -> Iterator[PhotoFit]:
    """The model fitted to `points68_automatic.npz` of a folder; every n-th picture.

    Raises:
        UnreadableFile: the file is missing or damaged.
    """
    path = folder / "points68_automatic.npz"
    try:
        with np.load(path, allow_pickle=False) as file:
            names, points = file["names"], file["points"]
    except (OSError, ValueError, KeyError) as error:
        raise UnreadableFile(path, f"not a file of automatic points: {error}") from error
    graph = points_graph(slide=True)
    for name, own in list(zip(names, points, strict=True))[::every]:
        yield _fitted(graph, str(name), own, model, None)


def portrait_residuals(folder: Path, model: MorphableModel, every: int = 1) -> Iterator[Residual]:
    """The model fitted to the network's points on every n-th portrait of a folder; one without a face is left out."""
    graph = model_graph()
    for path in sorted(folder.glob("*.jpg"))[::every]:
        evaluator = MeteredEvaluator()
        try:
            fit = graph.run(["landmarks", "mesh"], evaluator=evaluator, photo=path, model=model)["mesh"].fit
        except GraphfaceError as error:
            warn(f"{path.name} is left out: {error}")
            continue
        spent = evaluator.cpu_ms(evaluator.key("mesh"), [evaluator.key("landmarks")])
        yield Residual(path.name, 100 * fit.residual / max(fit.scale, 1e-6), spent)


def _fitted(
    graph: Graph, name: str, points: NDArray[np.floating[Any]], model: MorphableModel, true_yaw: float | None
) -> PhotoFit:
    own: FloatArray = np.zeros((68, 3), np.float32)
    own[:, :2] = points[:, :2]
    size = float(np.sqrt(np.prod(np.ptp(own[:, :2], axis=0))))
    evaluator = MeteredEvaluator()
    try:
        mesh = graph.run(["mesh"], evaluator=evaluator, points=Landmarks(own, "ibug68"), model=model)["mesh"]
    except GraphfaceError:
        return PhotoFit(name, 100.0, 0.0, true_yaw, 0.0)
    error = landmark_error(mesh, model.landmarks["ibug68"], own, size)
    spent = evaluator.cpu_ms(evaluator.key("mesh"))
    return PhotoFit(name, error, yaw_pitch_roll(mesh.fit.rotation)[0], true_yaw, spent)
