"""`graphface bench`: accuracy against ground truth, each figure beside what it cost in time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from graphface.nodes.commands.segmentation_truth import Labeller, Segmented

app = typer.Typer(help="Measure accuracy on ground truth, and the time it takes.", no_args_is_help=True)

_GEOMETRY_FIGURES = ("landmarks", "normals", "depth")

Data = Annotated[Path, typer.Option(help="Folder of ground truth; it holds truth/ and its README.")]


@app.callback()
def bench() -> None:
    """Measure accuracy on ground truth, and the time it takes."""


@app.command()
def relight(
    out: Annotated[Path, typer.Argument(help="Folder for the results: HEAD/LIGHT.png, as score.py reads them.")],
    data: Data = Path("../shared/data"),
    method: Annotated[str, typer.Option(help="detail: additive, multiplicative, split or none.")] = "split",
    source: Annotated[str, typer.Option(help="Light of the photo that is relit: frontal, left45, top ...")] = "frontal",
    encoding: Annotated[str, typer.Option(help="Values that albedo and shading live in: srgb or linear.")] = "srgb",
) -> None:
    """Relight the path-traced heads by their known lights and compare with the truth."""
    from graphface import UsageError
    from graphface.nodes.commands.truth import LIGHTS, relight_truth
    from graphface.report.terminal import print_table

    if method not in ("additive", "multiplicative", "none", "split"):
        raise UsageError(f"--method {method!r}: expected additive, multiplicative, split or none")
    if source not in ("frontal", *LIGHTS):
        raise UsageError(f"--source {source!r}: expected frontal, {', '.join(LIGHTS)}")
    if encoding not in ("srgb", "linear"):
        raise UsageError(f"--encoding {encoding!r}: expected srgb or linear")
    rows = [
        (
            *(r.head, r.light, f"{r.psnr:.2f}", f"{r.si_psnr:.2f}"),
            *(f"{r.unchanged_psnr:.2f}", f"{r.unchanged_si_psnr:.2f}", f"{r.normal_error:.1f}"),
        )
        for r in relight_truth(data, out, encoding=encoding, method=method, source=source)  # type: ignore[arg-type]
    ]
    headers = ("head", "light", ">PSNR dB", ">scale-inv.", ">unchanged", ">scale-inv.", ">normals, degrees off")
    print_table(headers, rows)


@app.command()
def lights(
    out: Annotated[Path | None, typer.Argument(help="Folder for the results, as score.py reads them.")] = None,
    data: Data = Path("../shared/data"),
    truth: Annotated[str, typer.Option(help="heads: path-traced; yale: photographs, one light at a time.")] = "heads",
    variant: Annotated[list[str] | None, typer.Option(help="By name; `all` for every one.")] = None,
    every: Annotated[int, typer.Option(min=1, help="Take every n-th person of the Yale set.")] = 1,
) -> None:
    """Relight by known lights with the shipped graph and parts of it changed: what each effect gains and costs.

    With a folder and several variants, a contact sheet of each head or person beside the truth is written too.
    """
    from statistics import median

    from graphface import UsageError
    from graphface.errors import did_you_mean, nearest_names
    from graphface.nodes.commands.known_lights import VARIANTS, relight_known, truth_cases, yale_cases
    from graphface.nodes.commands.variant_sheet import variant_sheets
    from graphface.report.terminal import print_table

    if truth not in ("heads", "yale"):
        raise UsageError(f"--truth {truth!r}: expected heads or yale")
    known = {v.name: v for v in VARIANTS}
    asked = list(known) if variant == ["all"] else variant or [VARIANTS[0].name]
    for name in asked:
        if name not in known:
            raise UsageError(f"unknown variant {name!r}{did_you_mean(nearest_names(name, known))}")
    kind, digits = ("si_psnr", 2) if truth == "heads" else ("si_mse", 4)
    headers: tuple[str, ...] = ()
    rows: list[tuple[str, ...]] = []
    for name in asked:
        cases = truth_cases(data) if truth == "heads" else yale_cases(data, every)
        folder = None if out is None else (out if len(asked) == 1 else out / name)
        found = list(relight_known(cases, folder, known[name], linear=truth == "yale"))
        names = dict.fromkeys(f.light for f in found)
        headers = ("variant", *(f">{light}" for light in names), ">mean", ">SSIM", ">ms")
        if not rows:
            before = [(f.light, f.unchanged) for f in found]
            rows.append(_lights_row("unchanged photo", before, names, kind, digits, ""))
        took = f"{median(f.milliseconds for f in found):.0f}"
        rows.append(_lights_row(name, [(f.light, f.measured) for f in found], names, kind, digits, took))
    print_table(headers, rows)
    if out is not None and len(asked) > 1:
        sheets = variant_sheets(out, asked, data, truth)
        print(f"wrote {len(sheets)} contact sheets, {out}/sheet-SUBJECT.png")


@app.command()
def scenes(
    photo: Annotated[Path | None, typer.Option(help="A photograph; scikit-image's astronaut by default.")] = None,
    megapixels: Annotated[float, typer.Option(min=0.01, max=100, help="The photo is scaled to this.")] = 1.0,
    repeats: Annotated[int, typer.Option(min=1, help="Edits timed for each scene; the median counts.")] = 5,
) -> None:
    """What each scene runs and costs once the representation is there, as a multiple of copying the arrays it reads."""
    from graphface.nodes.commands.scene_cost import scene_costs
    from graphface.report.terminal import print_table

    rows = [
        (c.scene, str(c.nodes), c.effects, f"{c.milliseconds:.0f}", f"{c.milliseconds / max(c.copy, 1e-6):.1f}")
        for c in scene_costs(photo, megapixels, repeats)
    ]
    print_table(("scene", ">nodes run", "effects", ">ms", ">copies"), rows)


@app.command()
def geometry(
    data: Data = Path("../shared/data"),
    model: Annotated[
        list[str] | None, typer.Option(help="Models to fit, by name or file; the built-in one by default.")
    ] = None,
    lights: Annotated[bool, typer.Option(help="One row a light instead of the mean of all.")] = False,
) -> None:
    """Compare the geometries with the path-traced heads: landmarks, normals, depth, milliseconds."""
    from statistics import fmean, median

    from graphface.nodes.commands.geometry_truth import geometry_truth
    from graphface.nodes.commands.heads import LIGHTS
    from graphface.nodes.morphable.library import named_model
    from graphface.report.terminal import print_table

    found = list(geometry_truth(data, {Path(name).stem: named_model(name) for name in model or ["builtin"]}))
    rows = []
    for name in dict.fromkeys(row.geometry for row in found):
        own = [row for row in found if row.geometry == name]
        for light in (*(LIGHTS if lights else ()), "all"):
            lit = [row for row in own if light in (row.light, "all")]
            points, normals, depth = (fmean(getattr(row, field) for row in lit) for field in _GEOMETRY_FIGURES)
            took = median(row.milliseconds for row in lit)
            rows.append((name, light, f"{points:.2f}", f"{normals:.2f}", f"{depth:.3f}", f"{took:.1f}"))
    print_table(("geometry", "light", ">landmarks %", ">normals deg", ">depth corr.", ">ms"), rows)


@app.command()
def poses(
    data: Data = Path("../shared/data"),
    model: Annotated[
        list[str] | None, typer.Option(help="Models to fit, by name or file; the built-in one by default.")
    ] = None,
    every: Annotated[int, typer.Option(min=1, help="Take every n-th of the photographs with automatic points.")] = 4,
) -> None:
    """Fit face models to photographs with 68 points: error, yaw, share of failures; residual on portraits."""
    from statistics import fmean, median

    from graphface.nodes.commands import geometry_photos as photos
    from graphface.nodes.morphable.library import named_model
    from graphface.report.terminal import print_table

    rows = []
    for name in model or ["builtin"]:
        own = named_model(name)
        sets = {
            "large poses": list(photos.pose_photos(data / "landmarks68", own)),
            "automatic points": list(photos.automatic_photos(data / "people", own, every)),
        }
        for title, fits in sets.items():
            off = [abs(fit.yaw - fit.true_yaw) for fit in fits if fit.true_yaw is not None]
            failed = fmean(fit.error > photos.FAILED for fit in fits)
            error, yaw = fmean(fit.error for fit in fits), f"{fmean(off):.1f}" if off else ""
            rows.append((own.name, f"{title} ({len(fits)})", f"{error:.2f}", yaw, f"{100 * failed:.0f}"))
        left = [per_cent for _, _, per_cent in photos.portrait_residuals(data / "portraits", own, every)]
        rows.append((own.name, f"portraits ({len(left)}), of eye distance", f"{median(left):.2f}", "", ""))
    print_table(("model", "photographs", ">error %", ">yaw off deg", ">failed %"), rows)


@app.command()
def masks(
    data: Data = Path("../shared/data"),
    matting: Annotated[
        list[str] | None, typer.Option(help="none, guided, closed_form or knn; all of them by default.")
    ] = None,
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
    """Segment the path-traced heads: overlap and boundary error of every label, time and memory, for each matting.

    With --noise, segment photos with and without noise of one 8-bit level: overlap of every label with itself. With
    --agreement, photos whose true labels nobody knows: overlap with what a network sees.
    """
    from functools import partial
    from statistics import fmean, median

    from graphface import UsageError
    from graphface.nodes.commands import segmentation_truth as truth
    from graphface.nodes.masks.label_weights import LabelWeights, read_weights
    from graphface.report.terminal import print_table

    if labels not in truth.LABELLERS:
        raise UsageError(f"--labels {labels!r}: expected {', '.join(truth.LABELLERS)}")
    label = truth.LABELLERS[labels]
    if weights is not None:
        if labels != "classify":
            raise UsageError("--weights goes with --labels classify")
        label = partial(truth.segment_photo, weights=LabelWeights(read_weights(weights)))
    if noise is not None:
        _print_noise(noise, label)
        return
    if agreement is not None:
        _print_agreement(agreement, label)
        return
    unknown = [name for name in matting or () if name not in truth.MATTINGS]
    if unknown:
        raise UsageError(f"--matting {unknown[0]!r}: expected {', '.join(truth.MATTINGS)}")
    chosen = {name: truth.MATTINGS[name] for name in matting or truth.MATTINGS}
    found = list(truth.segment_truth(data, chosen, label))
    rows = []
    for name in chosen:
        own = [row for row in found if row.matting == name]
        for row in own:
            rows.append((name, row.head, *_mask_figures([row], fmean), f"{row.matting_ms:.0f}", f"{row.peak_mb:.0f}"))
        took, most = median(row.matting_ms for row in own), max(row.peak_mb for row in own)
        rows.append((name, "mean", *_mask_figures(own, fmean), f"{took:.0f}", f"{most:.0f}"))
    columns = [f">{figure} {label}" for label in truth.LABELS for figure in ("IoU", "edge px")]
    before = median(row.labels_ms for row in found)
    print_table(("matting", "head", *columns, ">ms", ">MB"), rows)
    print(f"labels before matting: {before:.0f} ms (median)")


@app.command()
def matting(
    photos: Annotated[list[str], typer.Argument(help="Photos: files, folders, or patterns like faces/nm_*.png.")],
    trust: Annotated[
        float, typer.Option(help="Weight of the soft labels, both ways; 1e-6: Levin's own system.")
    ] = 1e-4,
    tolerance: Annotated[float, typer.Option(help="Relative residual at which the solve in the band stops.")] = 3e-3,
) -> None:
    """Closed-form matting in the band against PyMatting's for the whole picture: CPU seconds, and the alphas apart."""
    from graphface.evaluate.mapping import files_at
    from graphface.nodes.commands.matting_speed import matting_speed
    from graphface.report.terminal import print_table

    files = [Path(f) for where in photos for f in ([where] if Path(where).is_file() else files_at(where))]
    found = list(matting_speed(files, trust=trust, tolerance=tolerance))
    rows = [
        (
            *(one.photo, "x".join(map(str, one.size)), f"{100 * one.share:.0f}"),
            *(f"{one.whole_seconds:.2f}", f"{one.band_seconds:.2f}", f"{one.ratio:.1f}"),
            *(f"{one.picture:.4f}", f"{one.band:.4f}"),
        )
        for one in found
    ]
    print_table(("photo", "size", ">band %", ">whole s", ">band s", ">ratio", ">apart", ">apart in band"), rows)
    least, most = min((one.ratio for one in found), default=0.0), max((one.picture for one in found), default=0.0)
    print(f"ratio at least {least:.1f}, alphas apart by at most {most:.4f} (mean over the picture)")


def _files(pattern: str) -> list[Path]:
    from graphface.evaluate.mapping import files_at

    return [Path(file) for file in files_at(pattern)]


def _print_agreement(photos: str, label: Labeller) -> None:
    from statistics import fmean

    from graphface.nodes.commands.segmentation_agreement import segment_agreement
    from graphface.report.terminal import print_table

    found = sorted(segment_agreement(_files(photos), label), key=lambda one: one.worst)
    columns = list(zip(*(one.overlaps for one in found), strict=True))
    means = [fmean(known) if (known := [o for o in column if o is not None]) else None for column in columns]
    named = [*((one.photo, one.overlaps) for one in found), ("mean", means)]
    rows = [(name, *("" if value is None else f"{value:.3f}" for value in values)) for name, values in named]
    print_table(("photo", ">face", ">hair", ">background"), rows)


def _print_noise(photos: str, label: Labeller) -> None:
    from graphface.nodes.commands.segmentation_noise import segment_noise
    from graphface.report.terminal import print_table

    found = sorted(segment_noise(_files(photos), label=label), key=lambda one: one.worst)
    rows = [(one.photo, *(f"{value:.3f}" for value in (*one.overlaps, one.worst))) for one in found]
    print_table(("photo", ">face", ">hair", ">background", ">worst"), rows)
    print(f"{sum(one.worst < 0.98 for one in found)} of {len(found)} photos below 0.98")


def _mask_figures(rows: list[Segmented], mean: Callable[[Iterable[float]], float]) -> list[str]:
    """Mean overlap and boundary error of each label in turn."""
    figures = []
    for label in range(3):
        figures.append(f"{mean(row.iou[label] for row in rows):.3f}")
        figures.append(f"{mean(row.boundary[label] for row in rows):.2f}")
    return figures


def _lights_row(
    name: str, found: list[tuple[str, dict[str, float]]], lights: Iterable[str], kind: str, digits: int, took: str
) -> tuple[str, ...]:
    """Mean of one figure for each light and over all of them, mean SSIM, time."""
    from statistics import fmean

    each = [fmean(f[kind] for light, f in found if light == wanted) for wanted in lights]
    whole, ssim = fmean(f[kind] for _, f in found), fmean(f["ssim"] for _, f in found)
    return (name, *(f"{value:.{digits}f}" for value in each), f"{whole:.{digits}f}", f"{ssim:.3f}", took)


@app.command()
def intrinsic(
    data: Data = Path("../shared/data"),
    method: Annotated[list[str] | None, typer.Option(help="Methods of the family; all by default.")] = None,
    csv: Annotated[Path | None, typer.Option(help="Write every figure here as well.")] = None,
) -> None:
    """Albedo and shading errors of the intrinsic methods on path-traced heads, with milliseconds."""
    from graphface.nodes.commands.intrinsic_truth import intrinsic_truth
    from graphface.registry import default_registry
    from graphface.report.terminal import print_table

    registry = default_registry()
    base = registry.operator("intrinsic.intensity")
    names = [base.name, *(operator.name for operator in registry.alternatives(base))]
    asked = [name if "." in name else f"intrinsic.{name}" for name in method or names]
    figures = list(intrinsic_truth(data, {name: registry.operator(name).function for name in asked}))
    measures = ("albedo_si_mse", "albedo_lmse", "shading_si_mse", "shading_lmse", "milliseconds")
    rows = [(name, *_means([f for f in figures if f.method == name], measures)) for name in asked]
    print_table(("method", *(f">{measure.replace('_', ' ')}" for measure in measures)), rows)
    _write_csv(figures, csv)


@app.command()
def light(
    data: Data = Path("../shared/data"),
    csv: Annotated[Path | None, typer.Option(help="Write every figure here as well.")] = None,
) -> None:
    """Error of the direction of light that `sh.fit` finds on path-traced heads, by order and robustness."""
    from graphface.nodes.commands.intrinsic_truth import light_truth
    from graphface.report.terminal import print_table

    figures = list(light_truth(data))
    measures = ("mesh_degrees", "true_degrees", "milliseconds")
    kinds = dict.fromkeys((f.order, f.robust) for f in figures)
    rows = [(str(o), r, *_means([f for f in figures if (f.order, f.robust) == (o, r)], measures)) for o, r in kinds]
    print_table(("order", "robust", ">FaceMesh normals, degrees", ">true normals, degrees", ">milliseconds"), rows)
    _write_csv(figures, csv)


@app.command()
def makeup(
    out: Annotated[Path, typer.Argument(help="Folder for the results: METHOD/A_from_B.png, as score.py reads them.")],
    data: Data = Path("../shared/data"),
    swaps: Annotated[bool, typer.Option(help="Each optical flow and each way of blending in turn.")] = True,
    intrinsic: Annotated[bool, typer.Option(help="Each intrinsic method in turn; takes minutes.")] = False,
) -> None:
    """Give path-traced heads each other's makeup and compare with the truth."""
    from graphface.nodes.commands.transfer_truth import makeup_truth
    from graphface.report.terminal import print_table

    scored = makeup_truth(data, out, swaps=swaps, intrinsic=intrinsic)
    rows = [(s.method, f"{s.psnr:.2f}", f"{s.ssim:.3f}", f"{s.milliseconds:.0f}") for s in scored]
    print_table(("method", ">PSNR dB", ">SSIM", ">CPU ms"), rows)


@app.command()
def transfer(
    photos: Annotated[str, typer.Argument(help="Inputs: a folder, or a pattern like faces/nm_*.png.")],
    references: Annotated[str, typer.Argument(help="References: likewise.")],
    table: Annotated[Path | None, typer.Option(help="Also draw the table of results into this picture.")] = None,
    graph: Annotated[str, typer.Option(help="What --table draws: makeup or transfer.")] = "makeup",
) -> None:
    """Faithfulness, realism and predictability of makeup on pairs of photographs; with --table, their picture."""
    from graphface.nodes.commands.transfer_criteria import Criteria, criteria
    from graphface.nodes.commands.transfer_table import transfer_table
    from graphface.nodes.io.image_write import write_picture
    from graphface.report.terminal import print_table

    inputs, others = _files(photos), _files(references)
    if table is not None:
        write_picture(transfer_table(inputs, others, graph=graph), table)
    rows: list[tuple[str, ...]] = []
    for found in criteria(inputs, others):
        if not isinstance(found, Criteria):
            rows.append((*found, *[""] * 5))
            continue
        shift, floor = 100 * found.shift, 100 * found.floor
        figures = (shift, floor, found.similarity, found.seam, found.albedo_before, found.albedo_after)
        rows.append((found.photo, found.reference, *(f"{figure:.3f}" for figure in figures)))
    shifts = (">landmark shift, % of eyes", ">of recolouring alone")
    print_table(("photo", "reference", *shifts, ">similarity", ">seam", ">albedo before", ">albedo after"), rows)


def _means(figures: Sequence[object], measures: Iterable[str]) -> list[str]:
    """Mean of each measure; of times the median, which a busy machine spoils less."""
    from statistics import mean, median

    return [
        f"{(median if name == 'milliseconds' else mean)([getattr(f, name) for f in figures]):.4g}" for name in measures
    ]


def _write_csv(figures: Sequence[Any], path: Path | None) -> None:
    """One line for each figure; nothing without a path."""
    if path is None or not figures:
        return
    from csv import DictWriter
    from dataclasses import asdict

    with path.open("w", newline="", encoding="utf-8") as file:
        writer = DictWriter(file, list(asdict(figures[0])))
        writer.writeheader()
        writer.writerows(asdict(figure) for figure in figures)
