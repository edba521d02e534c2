"""`graphface bench masks`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphface.nodes.commands.bench.options import DATA, Data, files_of

if TYPE_CHECKING:
    from graphface.nodes.bench.segmentation_truth import Segmented
    from graphface.nodes.masks.label_weights import LabelWeights


def masks(
    data: Data = DATA,
    matting: Annotated[
        list[str] | None, typer.Option(help="none, guided, closed_form or knn; all of them by default.")
    ] = None,
    light: Annotated[str, typer.Option(help="Under which the heads are segmented: frontal, left45 ...")] = "frontal",
    noise: Annotated[
        str | None,
        typer.Option(help="Instead: how far labels of these photos (a folder, or faces/pd_*.png) jump with noise."),
    ] = None,
    agreement: Annotated[
        str | None, typer.Option(help="Instead: how far labels of these photos agree with those of masks.network.")
    ] = None,
    labels: Annotated[
        str, typer.Option(help="What finds the labels: classify, cue, detector, mixtures or network.")
    ] = "classify",
    weights: Annotated[
        Path | None, typer.Option(help="Of the cue's network, as `graphface models labels --without ...` writes them.")
    ] = None,
) -> None:
    """Overlap of face, hair and background with the truth, with themselves under noise, or with a network's.

    Data: the path-traced heads of truth/; with --noise or --agreement any photographs. The shipped representation runs
    with each matting, and with the labels found as asked. Prints for each label the intersection over union and, on
    heads, the distance between outlines in pixels, with CPU time and peak memory.
    """
    from graphface import UsageError
    from graphface.nodes.bench.heads import LIGHTS
    from graphface.nodes.bench.segmentation_graphs import LABELLINGS, MATTINGS
    from graphface.nodes.masks.label_weights import LabelWeights, read_weights

    _check("--labels", [labels], LABELLINGS)
    _check("--matting", matting or [], MATTINGS)
    _check("--light", [light], LIGHTS)
    if weights is not None and labels != "classify":
        raise UsageError("--weights goes with --labels classify")
    learned = None if weights is None else LabelWeights(read_weights(weights))
    if noise is not None:
        _noise(noise, labels, learned)
    elif agreement is not None:
        _agreement(agreement, labels, learned)
    else:
        _truth(data, matting or list(MATTINGS), labels, light, learned)


def _check(option: str, given: list[str], known: tuple[str, ...]) -> None:
    from graphface import UsageError

    for name in given:
        if name not in known:
            raise UsageError(f"{option} {name!r}: expected {', '.join(known)}")


def _truth(data: Path, mattings: list[str], labels: str, light: str, weights: LabelWeights | None) -> None:
    """A row for each matting and head, and the mean of the heads."""
    from statistics import median

    from graphface.nodes.bench.heads import LABELS
    from graphface.nodes.bench.segmentation_truth import segment_truth
    from graphface.nodes.commands.bench.figures import TIME_HEADERS, time_beside
    from graphface.report.terminal import print_table

    found = list(segment_truth(data, mattings, labels=labels, light=light, weights=weights))
    before = median(row.labels_ms for row in found)
    rows = []
    for name in mattings:
        own = [row for row in found if row.matting == name]
        rows += [(name, row.head, *_cells([row]), *time_beside(row.matting_ms, row.labels_ms)) for row in own]
        rows.append((name, "mean", *_cells(own), *time_beside(median(row.matting_ms for row in own), before)))
    columns = [f">{figure} {label}" for label in LABELS for figure in ("IoU", "edge px")]
    print_table(("matting", "head", *columns, ">MB", TIME_HEADERS[0], ">x labels"), rows)
    print(f"labels before matting: {before:.0f} ms of CPU (median)")


def _cells(rows: list[Segmented]) -> list[str]:
    """Mean overlap and boundary error of each label in turn; the most memory."""
    from graphface.nodes.commands.bench.figures import mean_of

    figures = []
    for label in range(3):
        figures.append(mean_of((row.iou[label] for row in rows), 3))
        figures.append(mean_of((row.boundary[label] for row in rows), 2))
    return [*figures, f"{max(row.peak_mb for row in rows):.0f}"]


def _noise(photos: str, labels: str, weights: LabelWeights | None) -> None:
    from graphface.nodes.bench.segmentation_noise import segment_noise
    from graphface.report.terminal import print_table

    found = sorted(segment_noise(files_of([photos]), labels=labels, weights=weights), key=lambda one: one.worst)
    rows = [
        (one.photo, *(f"{value:.3f}" for value in (*one.overlaps, one.worst)), f"{one.milliseconds:.0f}")
        for one in found
    ]
    print_table(("photo", ">face", ">hair", ">background", ">worst", ">CPU ms"), rows)
    print(f"{sum(one.worst < 0.98 for one in found)} of {len(found)} photos below 0.98")


def _agreement(photos: str, labels: str, weights: LabelWeights | None) -> None:
    from graphface.nodes.bench.heads import LABELS
    from graphface.nodes.bench.segmentation_agreement import segment_agreement
    from graphface.nodes.commands.bench.figures import mean_of
    from graphface.report.terminal import print_table

    found = sorted(segment_agreement(files_of([photos]), labels=labels, weights=weights), key=lambda one: one.worst)
    groups = [*((one.photo, [one]) for one in found), ("mean", found)]
    rows = [
        (
            name,
            *(mean_of((one.overlaps[label] for one in group), 3) for label in range(len(LABELS))),
            *(mean_of((one.milliseconds for one in group), 0), mean_of((one.network_ms for one in group), 0)),
        )
        for name, group in groups
    ]
    print_table(("photo", *(f">{label}" for label in LABELS), ">CPU ms", ">network's CPU ms"), rows)
