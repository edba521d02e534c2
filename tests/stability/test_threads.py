"""One graph, one evaluator, many threads with different inputs: every answer is the one that a single thread gives.

A graph that kept the keys of its last run in place gave, with two threads, 10 wrong answers of 800, and its cache kept
8 of them.
"""

import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from graphface import Evaluator, Graph, MemoryTier, Registry, load, node
from graphface.cache.disk import DiskTier

THREADS = 8
RUNS = 3000


@node("threads.add")
def add(a: float, b: float) -> float:
    return a + b


@node("threads.blur")
def blur(picture: np.ndarray, *, sigma: float = 1.0) -> np.ndarray:
    return cv2.GaussianBlur(picture, (0, 0), sigma)


@node("threads.mix")
def mix(one: np.ndarray, other: np.ndarray, share: float) -> np.ndarray:
    return one * share + other * (1 - share)


CHAIN = "\n".join(
    ["graphface: 1", "inputs: {x: float}", "nodes:"]
    + [f"  n{i}: {{use: threads.add, in: {{a: {f'n{i - 1}' if i else 'x'}, b: x}}}}" for i in range(60)]
    + ["outputs: {y: n59}", ""]
)
PICTURES = """\
graphface: 1
inputs: {picture: Array, share: float}
nodes:
  soft: {use: threads.blur, in: {picture: picture}}
  softer: {use: threads.blur, in: {picture: soft}, with: {sigma: 2}}
  mixed: {use: threads.mix, in: {one: picture, other: softer, share: share}}
outputs: {y: mixed}
"""


@pytest.fixture
def hurried() -> Iterator[None]:
    """Threads that take turns a thousand times as often as they would."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(5e-6)
    yield
    sys.setswitchinterval(before)


@pytest.fixture(params=["memory", "disk", "both"])
def evaluator(request: pytest.FixtureRequest, tmp_path: Path) -> Evaluator:
    memory = MemoryTier(1 << 20) if request.param != "disk" else None
    return Evaluator(memory=memory, disk=DiskTier(tmp_path, 1 << 22) if request.param != "memory" else None)


def graph_of(text: str) -> Graph:
    registry = Registry()
    for function in (add, blur, mix):
        registry.add(function)
    return load(text, registry=registry)


def from_threads(call: Callable[[int], Any], runs: int) -> list[Any]:
    with ThreadPoolExecutor(THREADS) as pool:
        return list(pool.map(call, range(runs)))


@pytest.mark.usefixtures("hurried")
class TestOneGraph:
    def test_chain(self, evaluator: Evaluator) -> None:
        """Thousands of runs of a chain, whose inputs come again and again, so that the caches answer too."""
        graph = graph_of(CHAIN)
        runs = RUNS if evaluator.disk is None else RUNS // 10
        found = from_threads(lambda i: graph.run(evaluator=evaluator, x=float(i % 97))["y"], runs)
        assert found == [61.0 * (i % 97) for i in range(runs)]
        assert [graph.run(evaluator=evaluator, x=float(x))["y"] for x in range(97)] == [61.0 * x for x in range(97)]

    def test_pictures(self, evaluator: Evaluator) -> None:
        """Arrays as well, with several threads inside each run."""
        graph = graph_of(PICTURES)
        rng = np.random.default_rng(0)
        pictures = [rng.random((24, 24, 3), np.float32) for _ in range(7)]
        serial = [graph.run(evaluator=Evaluator(), picture=p, share=0.25)["y"] for p in pictures]
        evaluator.threads = 2

        def call(i: int) -> bool:
            found = graph.run(evaluator=evaluator, picture=pictures[i % 7], share=0.25)["y"]
            return np.array_equal(found, serial[i % 7])

        assert all(from_threads(call, RUNS // 10))
        assert all(call(i) for i in range(7))


class TestOneInput:
    def test_array_written_to_meanwhile(self) -> None:
        """An array that its owner changes while a run uses it poisons no cache: the run has a copy."""
        evaluator = Evaluator(memory=MemoryTier())
        graph = graph_of(PICTURES)
        picture = np.ones((8, 8, 3), np.float32)
        asked = graph.request({"picture": picture, "share": 1.0})
        picture[:] = 7
        evaluator.run(asked)
        assert np.all(evaluator.run(graph.request({"picture": np.ones((8, 8, 3), np.float32), "share": 1.0}))["y"] == 1)

    def test_file_written_to_meanwhile(self, tmp_path: Path) -> None:
        """A file that changes between its hashing and its reading is an error, not a wrong entry."""
        from graphface import UnreadableFile

        path = tmp_path / "photo.png"
        cv2.imwrite(str(path), np.zeros((8, 8, 3), np.uint8))
        node_text = "{use: image.encode, in: {photo: photo}, with: {encoding: srgb}}"
        graph = load(f"graphface: 1\ninputs: {{photo: Image}}\nnodes: {{n: {node_text}}}\noutputs: {{y: n}}\n")
        asked = graph.request({"photo": path})
        cv2.imwrite(str(path), np.full((8, 8, 3), 255, np.uint8))
        with pytest.raises(UnreadableFile, match="changed"):
            Evaluator(memory=MemoryTier()).run(asked)
