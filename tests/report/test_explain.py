"""Every node says why it ran or did not, in the process and from one command to the next."""

from pathlib import Path

import pytest
from history_lab import NODES, Lab, graph_of
from toys import toy_registry

from graphface import load


@pytest.fixture(params=["memory", "disk"])
def lab(request: pytest.FixtureRequest, tmp_path: Path) -> Lab:
    return Lab(tmp_path / "cache", disk=request.param == "disk")


@pytest.fixture
def disk_lab(tmp_path: Path) -> Lab:
    return Lab(tmp_path / "cache")


class TestReasons:
    def test_first_seen(self, lab: Lab) -> None:
        """A node that never ran says so."""
        assert {str(e.reason) for e in lab.run(graph_of(), x=1.0).values()} == {"first seen"}

    def test_nothing_changed(self, lab: Lab) -> None:
        """A memoized output says that nothing changed, and what only it needs is skipped."""
        lab.run(graph_of(), x=1.0)
        found = lab.run(graph_of(), x=1.0)
        assert (found["join"].fate in ("memory", "disk"), str(found["join"].reason)) == (True, "nothing changed")
        assert str(found["left"].reason) == "only join needs it, and that is memoized"

    def test_parameter(self, lab: Lab) -> None:
        """A changed parameter is named with both values; what lies below names the node."""
        lab.run(graph_of(), x=1.0)
        found = lab.before(graph_of(set={"left.plus": 5}), x=1.0)
        assert str(found["left"].reason) == "parameter plus changed from 1.0 to 5.0"
        assert str(found["join"].reason) == "left changed above it"
        assert (found["right"].fate, str(found["right"].reason)) == (found["mean"].fate, "nothing changed")

    def test_parameter_behind_a_memoized_value(self, lab: Lab) -> None:
        """A node that was not even looked up last time is compared with what it was then."""
        lab.run(graph_of(), x=1.0)
        lab.run(graph_of(), x=1.0)
        assert str(lab.before(graph_of(set={"left.plus": 5}), x=1.0)["left"].reason).startswith(
            "parameter plus changed"
        )

    def test_long_parameters(self, lab: Lab) -> None:
        """Long values that differ at the end differ."""
        text = "graphface: 1\nnodes:\n  n: {use: toy.options}\n"
        lab.run(graph_of(text, set={"n.items": [0] * 500}), ["n"])
        found = lab.before(graph_of(text, set={"n.items": [0] * 499 + [1]}), ["n"])
        assert str(found["n"].reason).startswith("parameter items changed")
        assert len(str(found["n"].reason)) < 600

    def test_input(self, lab: Lab) -> None:
        """A changed graph input is named."""
        lab.run(graph_of(), x=1.0)
        found = lab.before(graph_of(), x=2.0)
        assert str(found["left"].reason) == "input x changed"
        assert str(found["join"].reason) == "left changed above it"

    def test_file(self, lab: Lab, tmp_path: Path) -> None:
        """A file is an input by its content: written anew with the same it has not changed, with other it has."""
        import numpy as np

        from graphface.nodes.io.image_write import write_picture

        node = "{use: image.encode, in: {photo: photo}, with: {encoding: srgb}}"
        text = f"graphface: 1\ninputs: {{photo: Image}}\nnodes: {{n: {node}}}\n"
        photo, graph = tmp_path / "photo.png", load(text)
        write_picture(np.zeros((4, 4, 3), np.uint8), photo)
        lab.run(graph, ["n"], photo=str(photo))
        content = photo.read_bytes()
        photo.unlink()
        photo.write_bytes(content)
        assert str(lab.before(graph, ["n"], photo=str(photo))["n"].reason) == "nothing changed"
        write_picture(np.ones((4, 4, 3), np.uint8), photo)
        assert str(lab.before(graph, ["n"], photo=str(photo))["n"].reason) == "input photo changed"

    def test_connection(self, lab: Lab) -> None:
        """A port plugged elsewhere says from where to where."""
        lab.run(graph_of(), x=1.0)
        found = lab.before(graph_of(NODES.replace("b: right", "b: left")), x=1.0)
        assert str(found["join"].reason) == "port b is connected to left, was right"

    def test_connection_to_another_field(self, lab: Lab) -> None:
        """Another field of the same node is another connection."""
        lab.run(graph_of(), x=1.0)
        other = NODES.replace(
            "mean: {use: toy.mean, in: {grid: pair.low}}", "mean: {use: toy.takes_none, in: {grid: pair.low}}"
        )
        lab.run(graph_of(other), x=1.0)
        found = lab.before(graph_of(other.replace("pair.low", "pair.high")), x=1.0)
        assert str(found["mean"].reason) == "port grid is connected to pair.high, was pair.low"

    def test_unplugged(self, lab: Lab) -> None:
        """A port with nothing in it any more says so."""
        lab.run(graph_of(), x=1.0)
        found = lab.before(graph_of(NODES.replace(", b: right", "")), x=1.0)
        assert str(found["join"].reason) == "port b is connected to nothing, was right"

    def test_operator(self, lab: Lab) -> None:
        """A replaced operator names both."""
        lab.run(graph_of(), x=1.0)
        found = lab.before(graph_of(replace={"join": "toy.subtract"}), x=1.0)
        assert str(found["join"].reason) == "operator changed from toy.add to toy.subtract"

    def test_code(self, lab: Lab, tmp_path: Path) -> None:
        """An edited operator says that its code changed; what lies below names it."""
        plugin = tmp_path / "plugin.py"
        source = "from graphface import node\n@node('mine.twice')\ndef twice(a: float) -> float:\n    return 2 * a\n"
        text = NODES.replace("left: {use: toy.add, in: {a: x}, with: {plus: 1}}", "left: {use: mine.twice, in: {a: x}}")
        plugin.write_text(source)
        lab.run(load(text, registry=toy_registry(), plugins=[plugin]), x=1.0)
        plugin.write_text(source.replace("2 * a", "2 * a + 1"))
        found = lab.before(load(text, registry=toy_registry(), plugins=[plugin]), x=1.0)
        assert str(found["left"].reason) == "operator code changed"
        assert str(found["join"].reason) == "left changed above it"
        assert str(found["mean"].reason) == "nothing changed"

    def test_other_graph(self, lab: Lab) -> None:
        """A value that another graph computed is served and said to be another's."""
        lab.run(graph_of(), x=1.0)
        found = lab.run(graph_of(NODES.replace("name: lab", "name: other")), x=1.0)
        assert {str(found["join"].reason), str(found["mean"].reason)} == {"computed before, by another run or graph"}

    def test_evicted_from_memory(self, tmp_path: Path) -> None:
        """What a small memory budget dropped was evicted."""
        lab = Lab(tmp_path, disk=False, budget=3000)
        for plus in range(20):
            lab.run(graph_of(set={"left.plus": plus}), x=1.0)
        lab.run(graph_of(), x=1.0)
        assert lab.memory is not None
        lab.memory.clear()
        assert {str(e.reason) for e in lab.before(graph_of(), x=1.0).values()} == {"evicted"}

    def test_evicted_from_disk(self, disk_lab: Lab) -> None:
        """What was stored and is not there any more was evicted."""
        disk_lab.run(graph_of(), x=1.0)
        for entry in disk_lab.folder.glob("*/*.safetensors"):
            entry.unlink()
        assert {str(e.reason) for e in disk_lab.before(graph_of(), x=1.0).values()} == {"evicted"}

    def test_too_large(self, tmp_path: Path) -> None:
        """What was never stored is not said to be evicted."""
        lab = Lab(tmp_path / "cache", budget=5000)
        large = graph_of("graphface: 1\nnodes:\n  grid: {use: toy.grid, with: {size: 128}}\n")
        lab.run(large, ["grid"])
        assert str(lab.before(large, ["grid"])["grid"].reason).startswith("not kept")

    def test_damaged(self, disk_lab: Lab) -> None:
        """A damaged entry is computed again and says so; so does what it needs."""
        disk_lab.run(graph_of(), ["mean"])
        for entry in disk_lab.folder.glob("*/*.safetensors"):
            content = bytearray(entry.read_bytes())
            content[-1] ^= 1
            entry.write_bytes(content)
        found = disk_lab.run(graph_of(), ["mean"])
        assert {n: (e.fate, str(e.reason)) for n, e in found.items() if n in ("grid", "pair", "mean")} == dict.fromkeys(
            ("grid", "pair", "mean"), ("ran", "its stored result was damaged")
        )
        assert str(disk_lab.run(graph_of(), ["mean"])["mean"].reason) == "nothing changed"

    def test_failed(self, lab: Lab) -> None:
        """A node that failed says why, those it blocks say so, and the next time it says that it had failed."""
        text = NODES.replace("toy.add, in: {a: left, b: right}", "toy.fail, in: {a: left}").replace(
            "outputs: {join: join,", "outputs: {join: end,"
        )
        graph = graph_of(text.replace("  grid:", "  end: {use: toy.add, in: {a: join}}\n  grid:", 1))
        found = lab.run(graph, x=1.0)
        assert (found["join"].fate, str(found["join"].reason)) == ("failed", "ValueError: it broke")
        assert (found["end"].fate, str(found["end"].reason)) == ("blocked", "a node above it failed")
        assert found["mean"].fate == "ran"
        again = lab.before(graph, x=1.0)
        assert str(again["join"].reason) == "it failed when it last ran"
        assert str(again["end"].reason) == "first seen"
        assert str(again["left"].reason) == "nothing changed"


class TestLazyPorts:
    TEXT = """\
graphface: 1
inputs: {x: float}
nodes:
  a: {use: toy.add, in: {a: x}}
  b: {use: toy.add, in: {a: x}, with: {plus: 7}}
  gate: {use: toy.positive, in: {a: a, extra: b}}
  c: {use: toy.add, in: {a: x}, with: {plus: 8}}
  other: {use: toy.numpy_gate, in: {a: x, extra: c}}
outputs: {gate: gate, other: other}
"""

    def test_maybe(self, lab: Lab) -> None:
        """Before the run a node behind an open decision names who decides."""
        assert str(lab.before(graph_of(self.TEXT), x=-1.0)["b"].reason) == "gate decides when its inputs are there"

    def test_declined(self, lab: Lab) -> None:
        """After the run it has the reason of its own decider, not of another."""
        found = lab.run(graph_of(self.TEXT), x=-1.0)
        assert (found["b"].fate, str(found["b"].reason)) == ("skipped", "a is not positive")
        assert (found["c"].fate, str(found["c"].reason)) == ("skipped", "its rule does not want it")

    def test_wanted(self, lab: Lab) -> None:
        """A node that was declined before is seen for the first time when it runs."""
        lab.run(graph_of(self.TEXT), x=-1.0)
        found = lab.run(graph_of(self.TEXT), x=1.0)
        assert (found["b"].fate, str(found["b"].reason)) == ("ran", "first seen")
        assert str(found["a"].reason) == "input x changed"


class TestEqualNodes:
    def test_one_for_both(self, lab: Lab) -> None:
        """Of equal nodes one runs, and the other says which."""
        text = "graphface: 1\ninputs: {x: float}\nnodes:\n"
        text += "".join(f"  {name}: {{use: toy.add, in: {{a: x}}}}\n" for name in "ab")
        found = lab.run(graph_of(text + "  c: {use: toy.add, in: {a: a, b: b}}\noutputs: {c: c}\n"), x=1.0)
        assert sorted((e.fate, str(e.reason).partition(" ")[0]) for e in (found["a"], found["b"])) == [
            ("ran", "equal"),
            ("ran", "first"),
        ]


class TestNumbers:
    def test_ran(self, lab: Lab) -> None:
        """A node that ran has milliseconds, bytes and the beginning of its key."""
        entry = lab.run(graph_of(), x=1.0)["grid"]
        assert entry.milliseconds is not None
        assert entry.milliseconds >= 0
        assert entry.bytes == 4 * 4 * 8
        assert len(entry.key) == 8

    def test_memoized(self, lab: Lab) -> None:
        """A memoized one has its bytes and no time."""
        lab.run(graph_of(), ["grid"], x=1.0)
        entry = lab.run(graph_of(), ["grid"], x=1.0)["grid"]
        assert (entry.milliseconds, entry.bytes) == (None, 4 * 4 * 8)

    def test_warnings(self, lab: Lab) -> None:
        """What a node fell back on stands with it."""
        graph = graph_of("graphface: 1\ninputs: {x: float}\nnodes: {n: {use: toy.fall_back, in: {a: x}}}\n")
        assert lab.run(graph, ["n"], x=9.0)["n"].warnings == ("9.0 was too much",)
