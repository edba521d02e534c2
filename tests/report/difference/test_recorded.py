"""The graph and the inputs of an earlier run."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from graphface import Evaluator, UnreadableFile, UsageError, load
from graphface.facade import Graph
from graphface.report.difference.recorded import Recorded, bound_again, read_recorded
from graphface.report.trace import Trace

PHOTO = """
graphface: 1
inputs: {photo: Image, strength: {type: float, default: 0.5}}
nodes: {e: {use: image.encode, in: {photo: photo}, with: {encoding: srgb}}}
outputs: {image: e}
"""


@pytest.fixture
def photo(tmp_path: Path) -> Path:
    path = tmp_path / "photo.png"
    Image.fromarray(np.full((4, 5, 3), 100, np.uint8)).save(path)
    return path


@pytest.fixture
def recorded(photo: Path, tmp_path: Path) -> tuple[Graph, Recorded]:
    graph, trace = load(PHOTO), Trace()
    Evaluator().run(graph.request({"photo": photo, "strength": 0.25}), [trace])
    trace.write_to(tmp_path / "run.json")
    return graph, read_recorded(tmp_path / "run.json")


class TestBoundAgain:
    def test_files_and_numbers(self, recorded: tuple[Graph, Recorded]) -> None:
        """Both come back with the digests that they had."""
        graph, run = recorded
        bound = bound_again(graph, run, {})
        assert {name: b.digest.hex() for name, b in bound.items()} == {n: i["digest"] for n, i in run.inputs.items()}

    def test_given_wins(self, recorded: tuple[Graph, Recorded]) -> None:
        """An input that is given is not looked for."""
        graph, run = recorded
        assert bound_again(graph, run, {"photo": "other.png"})["photo"] == "other.png"

    def test_moved_with_the_trace(self, recorded: tuple[Graph, Recorded], photo: Path, tmp_path: Path) -> None:
        """A relative path is looked for beside the trace, too."""
        graph, run = recorded
        inputs = {**run.inputs, "photo": {**run.inputs["photo"], "origin": "photo.png"}}
        assert bound_again(graph, Recorded(run.path, run.document, inputs, run.nodes), {})["photo"].is_file

    def test_gone(self, recorded: tuple[Graph, Recorded], photo: Path) -> None:
        """A file that is not there is named, and how to give another."""
        graph, run = recorded
        photo.unlink()
        with pytest.raises(UsageError, match=r"photo.png is gone; give it with -i photo=FILE"):
            bound_again(graph, run, {})

    def test_changed(self, recorded: tuple[Graph, Recorded], photo: Path) -> None:
        """A file with another content is refused."""
        graph, run = recorded
        Image.fromarray(np.full((4, 5, 3), 101, np.uint8)).save(photo)
        with pytest.raises(UsageError, match="is not what it was"):
            bound_again(graph, run, {})

    def test_from_python(self, recorded: tuple[Graph, Recorded]) -> None:
        """An array that was given in Python is in no file."""
        graph, run = recorded
        inputs = {"photo": {"origin": "Image", "digest": "00"}}
        with pytest.raises(UsageError, match="a value from Python"):
            bound_again(graph, Recorded(run.path, run.document, inputs, ()), {})


class TestReadRecorded:
    @pytest.mark.parametrize("text", ["", "[]", "{}", json.dumps({"document": "", "inputs": 1, "nodes": []})])
    def test_no_trace(self, tmp_path: Path, text: str) -> None:
        """Any other JSON is refused with its name."""
        (tmp_path / "a.json").write_text(text)
        with pytest.raises(UnreadableFile, match=r"a\.json"):
            read_recorded(tmp_path / "a.json")

    def test_missing(self, tmp_path: Path) -> None:
        """So is a file that is not there."""
        with pytest.raises(UnreadableFile, match="No such file"):
            read_recorded(tmp_path / "a.json")
