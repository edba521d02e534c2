"""`graphface demo`: relight a photograph under three scenes and show every stage on the way."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from graphface import Graph, Result
    from graphface.nodes.bench.contact_sheet import Picture

SCENES = ("golden-hour", "moonlight", "red-blue")
_STAGES = {
    "normals": "face.normals",
    "face mask": "face.mask",
    "albedo": "face.albedo",
    "shading": "face.shading",
    "light on the face": "face.estimated",
    "detail map": "face.detail.gain",
}


def demo(
    folder: Annotated[Path, typer.Argument(help="Folder for the results; made if missing.")] = Path("results"),
    photo: Annotated[
        Path | None, typer.Option(help="A photograph; scikit-image's astronaut (Eileen Collins, NASA) by default.")
    ] = None,
) -> None:
    """Relight a photograph under three scenes; writes the pictures, a row of all, and a sheet of every stage."""
    import os

    from graphface import Evaluator, MemoryTier, load
    from graphface.nodes.bench.shipped import astronaut
    from graphface.nodes.io.image_write import write_image, write_picture
    from graphface.report.terminal import ProgressBar, print_times, print_warnings
    from graphface.values.writing import make_folder

    make_folder(folder)
    given = photo if photo is not None else astronaut()
    # Every stage is shown beside the photo, so all of them are of its size.
    graph = load("relight", set={"face/working_size.resolution": None})
    asked = ["image", "photo", "face.mesh", "face.landmarks", *_STAGES.values()]
    records, relit, results = [], {}, None
    with ProgressBar() as bar:
        evaluator = Evaluator(memory=MemoryTier(), threads=os.cpu_count() or 1, observers=[bar])
        for scene in SCENES:
            results = graph.run(asked, evaluator=evaluator, photo=given, scene=f"scenes/{scene}.yaml")
            records += results.records
            relit[scene] = results["image"]
    assert results is not None
    for scene, image in relit.items():
        write_image(image, folder / f"{scene}.png")
    write_picture(_row(results, relit), folder / "demo.jpg")
    write_picture(_sheet(graph, results, relit), folder / "contact-sheet.png")
    print_times(records, title=f"{len(SCENES)} scenes")
    print_warnings(results.warnings)
    print(f"wrote {', '.join(f'{scene}.png' for scene in SCENES)}, demo.jpg and contact-sheet.png to {folder}/")


def _row(results: Result, relit: dict[str, Any]) -> Picture:
    """The face as it was and under each scene, side by side: the picture that the README opens with."""
    from graphface.nodes.bench.contact_sheet import around_face, contact_sheet
    from graphface.nodes.pictures.photo import bytes_of

    near = around_face(results["face.landmarks"], results["photo"], reach=1.7)
    cells = {"photo": results["photo"], **relit}
    return contact_sheet([(name, bytes_of(cell)[near]) for name, cell in cells.items()], columns=4, width=300)


def _sheet(graph: Graph, results: Result, relit: dict[str, Any]) -> Picture:
    """The photo whole, every stage around the face."""
    from graphface.nodes.bench.contact_sheet import around_face, contact_sheet, mesh_overlay
    from graphface.nodes.pictures.photo import bytes_of
    from graphface.nodes.types import Image
    from graphface.pictures import draw
    from graphface.values.picture import View

    photo, landmarks = results["photo"], results["face.landmarks"]
    near = around_face(landmarks, photo)
    cells = [("photo", bytes_of(photo)), ("face", bytes_of(photo)[near])]
    cells.append(("mesh", mesh_overlay(photo, results["face.mesh"], landmarks)[near]))
    view = View(above=lambda kind: photo if kind is Image else None)
    for caption, name in _STAGES.items():
        declared = graph.type_of(graph.targets([name])[name])
        cells.append((caption, draw(results[name], declared, graph.registry, view).pixels[near]))
    cells += [(f"relit: {scene}", bytes_of(image)[near]) for scene, image in relit.items()]
    return contact_sheet(cells, columns=4)
