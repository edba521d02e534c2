"""What a report costs a run: seconds of CPU, bytes of the page and how they change with the size of its pictures.

    python tests/bench/report_cost.py PHOTO [--reference PHOTO] [--sizes 192 224 256 320] [--rounds 3]

Runs relight, and makeup where a reference is given, in one process: without a report and with one in turn, nothing
memoized, on one thread. CPU time of the process, best of the rounds (other load on the machine matters less). The photo
is scaled to one megapixel first.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path
from typing import Any

from graphface import Evaluator, Graph, load


def one_megapixel(photo: Path, folder: Path) -> Path:
    """The photo at 1 MP, as a PNG in the folder."""
    from PIL import Image

    picture = Image.open(photo).convert("RGB")
    scale = (1e6 / (picture.width * picture.height)) ** 0.5
    made = folder / f"{photo.stem}.png"
    picture.resize((round(picture.width * scale), round(picture.height * scale)), Image.Resampling.LANCZOS).save(made)
    return made


def cpu(graph: Graph, inputs: dict[str, Any], page: Path | None, size: int) -> float:
    """Seconds of CPU that one run takes, and its report if a page is named."""
    from graphface.report.page.html import write_report
    from graphface.report.recorder import Recorder

    evaluator = Evaluator()
    recorder = Recorder(evaluator.find, size)
    begun = time.process_time()
    evaluator.run(graph.request(inputs), [recorder] if page is not None else [])
    if page is not None:
        write_report(recorder, page)
    return time.process_time() - begun


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("photo", type=Path)
    parser.add_argument("--reference", type=Path)
    parser.add_argument("--sizes", type=int, nargs="+", default=[192, 224, 256, 320, 384])
    parser.add_argument("--rounds", type=int, default=3)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cases = {"relight": {"photo": one_megapixel(asked.photo, folder)}}
        if asked.reference is not None:
            cases["makeup"] = {**cases["relight"], "reference": one_megapixel(asked.reference, folder)}
        for graph_name, inputs in cases.items():
            graph = load(graph_name)
            cpu(graph, inputs, folder / "page.html", 64)
            plain, reported, sizes = [], {size: [] for size in asked.sizes}, {}
            for _ in range(asked.rounds):
                plain.append(cpu(graph, inputs, None, 0))
                for size in asked.sizes:
                    reported[size].append(cpu(graph, inputs, folder / "page.html", size))
                    sizes[size] = (folder / "page.html").stat().st_size
            print(f"{graph_name}: {min(plain):.2f} s of CPU without a report")
            for size, seconds in reported.items():
                more = min(seconds) - min(plain)
                ratio = min(seconds) / min(plain)
                print(f"  {size} pixels: {more:+.2f} s, {ratio:.2f} times, {sizes[size] / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
