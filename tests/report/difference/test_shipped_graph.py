"""A shipped graph compared with itself under another method, on a photograph."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from graphface import Evaluator, MemoryTier, load
from graphface.nodes.types.image import image_from_array
from graphface.report.difference.compare import Comparison
from graphface.report.difference.page import write_page


@pytest.fixture(scope="module")
def swapped() -> Comparison:
    """relight, the photo's detail split and added, at an eighth of the size of scikit-image's astronaut."""
    photo = image_from_array(pytest.importorskip("skimage.data").astronaut()[::2, ::2].copy())
    one, other = load("relight"), load("relight", replace={"face/detail": "detail.additive"})
    evaluator = Evaluator(memory=MemoryTier())
    return Comparison(one.request({"photo": photo}), other.request({"photo": photo}), evaluator)


def test_the_swap_is_found(swapped: Comparison) -> None:
    """The swapped node comes first and is the only one that was changed; the output inherits from it."""
    found = swapped.differences()
    assert found.first is not None
    assert (found.first.name, found.first.operators[1]) == ("face/detail", "detail.additive")
    assert [node.name for node in found if node.caused] == ["face/detail"]
    assert found.nodes[-1].name == "image"
    assert found.equal > len(found)


def test_page(swapped: Comparison, open_page: Any, tmp_path: Path) -> None:
    """Every node has pictures, and the output's pixels are read back in both."""
    found = swapped.differences()
    write_page(swapped, found, tmp_path / "d.html", size=96)
    page = open_page(tmp_path / "d.html")
    for entry in page.locator("nav button:not(.all)").all():
        entry.click()
        assert page.locator(".gc-port img.gc-picture").count() == 2
    port = page.locator(".gc-port .gc-picture").first.bounding_box()
    page.mouse.move(port["x"] + port["width"] * 0.25, port["y"] + port["height"] * 0.5)
    page.locator(".gc-position").wait_for()
    position, one, other, _ = page.locator(".gc-readout").inner_text().split("\n")
    x, y = (int(part.split()[1]) for part in position.split(", "))
    for side, said in zip(swapped.sides, (one, other), strict=True):
        read = [float(word.replace("−", "-")) for word in said.split()[1:]]
        assert read == pytest.approx(side.value("image").pixels[y, x].tolist(), abs=1e-3)
