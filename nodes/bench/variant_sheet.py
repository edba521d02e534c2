"""Results of several variants beside the truth: one contact sheet a subject, a row for each light."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from graphface.nodes.bench.contact_sheet import Picture, contact_sheet
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.pictures.photo import bytes_of


def variant_sheets(out: Path, variants: Sequence[str], data: Path, truth: str, *, width: int = 180) -> list[Path]:
    """Write `out`/sheet-SUBJECT.png for every subject of the results in `out`/VARIANT/SUBJECT/LIGHT.png.

    Args:
        data: the folder of ground truth. truth: "heads" or "yale", which of it.

    Returns:
        The files written.
    """
    written = []
    for folder in sorted(path for path in (out / variants[0]).iterdir() if path.is_dir()):
        subject = folder.name
        cells = []
        for result in sorted(folder.glob("*.png")):
            cells.append((f"truth: {result.stem}", _picture(_truth(data, truth, subject, result.stem))))
            cells += [(name, _picture(out / name / subject / result.name)) for name in variants]
        if cells:
            written.append(out / f"sheet-{subject}.png")
            write_picture(contact_sheet(cells, columns=1 + len(variants), width=width), written[-1])
    return written


def _truth(data: Path, truth: str, subject: str, light: str) -> Path:
    if truth == "heads":
        return data / "truth" / subject / f"{light}.png"
    return data / "yaleb" / subject / f"{subject}_P00{light}.png"


def _picture(path: Path) -> Picture:
    return bytes_of(read_image(path))
