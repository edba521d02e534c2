"""`graphface gallery`: a photograph under every scene."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from graphface.nodes.commands.distinct_names import check_distinct


def gallery(
    folder: Annotated[Path, typer.Argument(help="Folder for the pictures; made if missing.")] = Path("gallery"),
    photo: Annotated[
        list[Path] | None, typer.Option(metavar="FILE", help="Photographs; scikit-image's astronaut by default.")
    ] = None,
    scene: Annotated[
        list[Path] | None, typer.Option(metavar="FILE", help="Scene files; all shipped ones by default.")
    ] = None,
    profile: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="Profiles of the relight graph, such as draft.")
    ] = None,
    columns: Annotated[int, typer.Option(min=1, help="Pictures in a row of the sheet.")] = 6,
) -> None:
    """Relight photographs under every scene; one picture each and a contact sheet for each photograph."""
    import os

    from graphface import Evaluator, MemoryTier, load
    from graphface.nodes.bench.contact_sheet import around_face, contact_sheet
    from graphface.nodes.bench.shipped import astronaut, shipped_scenes
    from graphface.nodes.io.image_write import write_image, write_picture
    from graphface.nodes.landmarks.scaled import scaled
    from graphface.nodes.pictures.photo import bytes_of
    from graphface.values.writing import make_folder

    scenes = scene or shipped_scenes()
    for files in (photo or [], scenes):
        check_distinct(files)
    graph = load("relight", profiles=profile or ())
    make_folder(folder)
    photos: list[Path | None] = [*photo] if photo else [None]
    for given in photos:
        name = "astronaut" if given is None else given.stem
        source = astronaut() if given is None else given
        evaluator = Evaluator(memory=MemoryTier(), threads=os.cpu_count() or 1)
        cells: list[tuple[str, Any]] = []
        for path in scenes:
            asked = ["image", "photo", "face.working", "face.landmarks"]
            found = graph.run(asked, evaluator=evaluator, photo=source, scene=path)
            near = around_face(scaled(found["face.landmarks"], found["face.working"], found["photo"]), found["photo"])
            if not cells:
                cells.append((name, bytes_of(found["photo"])[near]))
            cells.append((path.stem, bytes_of(found["image"])[near]))
            write_image(found["image"], folder / f"{name}-{path.stem}.png")
        write_picture(contact_sheet(cells, columns=columns, width=300), folder / f"{name}-sheet.png")
    print(f"wrote {len(photos) * len(scenes)} pictures and {len(photos)} sheets to {folder}/")
