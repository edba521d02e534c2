"""Nothing stale is ever served: each of these is got wrong by some memoizing dataflow library of today.

A small package of operators is written to disk, run, edited and imported again; the same evaluator, with a memory or a
disk tier that remembers the first run, must answer for the code as it is now.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import Evaluator, MemoryTier, NodeError, Pack, Registry, RunFailed, load
from graphface.cache.disk import DiskTier

PACKAGE = {
    "__init__": "",
    "begin": """\
        from graphface import node

        @node("stale.source")
        def source(x: float) -> float:
            return x + 1

        @node("stale.late")
        def late(a: float) -> float:
            from {package}.lazily import imported
            return imported(a)
        """,
    "ops": """\
        import numpy as np
        from graphface import Lazy, node
        from {package} import middle
        from {package}.settings import GAIN
        from {package}.deep import Scaler

        @node("stale.direct")
        def direct(a: float) -> float:
            return a * 2

        @node("stale.helped")
        def helped(a: float) -> float:
            return middle.outer(a)

        @node("stale.constant")
        def constant(a: float) -> float:
            return a * GAIN

        @node("stale.method")
        def method(a: float) -> float:
            return Scaler(2.0).scale(a)

        def _rule(a: float):
            return {{"extra": a > 0}}

        @node("stale.ruled", needs=_rule)
        def ruled(a: float, extra: Lazy[float]) -> float:
            return a if extra is None else a + extra
        """,
    "middle": """\
        from {package}.deep import inner

        def outer(a):
            return inner(a) + 10
        """,
    "deep": """\
        def inner(a):
            return a * 3

        class Scaler:
            def __init__(self, by):
                self.by = by

            def scale(self, a):
                return a * self.by
        """,
    "settings": "GAIN = 4.0\n",
    "lazily": "def imported(a):\n    return a * 5\n",
}

GRAPH = """\
graphface: 1
inputs: {x: float}
nodes:
  source: {use: stale.source, in: {x: x}}
  direct: {use: stale.direct, in: {a: source}}
  helped: {use: stale.helped, in: {a: source}}
  constant: {use: stale.constant, in: {a: source}}
  method: {use: stale.method, in: {a: source}}
  late: {use: stale.late, in: {a: source}}
  ruled: {use: stale.ruled, in: {a: source, extra: direct}}
"""

OUTPUTS = ["direct", "helped", "constant", "method", "late", "ruled"]

EDITS: dict[str, tuple[str, str, str, dict[str, float]]] = {
    # what is edited: module, text before, text after, and what must change to what (x = 1)
    "the body": ("ops", "a * 2", "a * 7", {"direct": 14, "ruled": 16}),
    "a helper's helper in another module": ("deep", "a * 3", "a * 4", {"helped": 18}),
    "a helper": ("middle", "+ 10", "+ 20", {"helped": 26}),
    "a constant of another module": ("settings", "4.0", "5.0", {"constant": 10}),
    "a method": ("deep", "a * self.by", "a * self.by + 1", {"method": 5}),
    "a module imported inside the function": ("lazily", "a * 5", "a * 6", {"late": 12}),
    "the rule of lazy ports": ("ops", "a > 0", "a > 100", {"ruled": 2}),
    "an operator upstream": (
        "begin",
        "x + 1",
        "x + 2",
        {"direct": 6, "helped": 19, "constant": 12, "method": 6, "late": 15, "ruled": 9},
    ),
    "a default": ("ops", "def direct(a: float)", "def direct(a: float, *, more: float = 1)", {}),
}

BEFORE = {"direct": 4, "helped": 16, "constant": 8, "method": 4, "late": 10, "ruled": 6}


class Package:
    """The package on disk; `registry()` imports it as it is now, like a new process would."""

    def __init__(self, folder: Path, name: str) -> None:
        self.folder = folder / name
        self.name = name
        self.folder.mkdir()
        for module, text in PACKAGE.items():
            lines = text.format(package=name).splitlines()
            indent = len(lines[0]) - len(lines[0].lstrip()) if lines else 0
            (self.folder / f"{module}.py").write_text("\n".join(line[indent:] for line in lines) + "\n")

    def edit(self, module: str, before: str, after: str) -> None:
        path = self.folder / f"{module}.py"
        text = path.read_text()
        assert before in text
        path.write_text(text.replace(before, after))

    def forget(self) -> None:
        for name in [n for n in sys.modules if n == self.name or n.startswith(f"{self.name}.")]:
            del sys.modules[name]
        importlib.invalidate_caches()

    def registry(self) -> Registry:
        self.forget()
        return Registry([Pack(self.name, operators={"stale": f"{self.name}.begin {self.name}.ops"})])


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Package]:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)  # files of one size edited within a second share their .pyc
    monkeypatch.syspath_prepend(str(tmp_path))
    written = Package(tmp_path, "stale_package")
    yield written
    written.forget()


@pytest.fixture(params=["memory", "disk", "both"])
def evaluator(request: pytest.FixtureRequest, tmp_path: Path) -> Evaluator:
    memory = MemoryTier() if request.param != "disk" else None
    disk = DiskTier(tmp_path / "cache", 1 << 26) if request.param != "memory" else None
    return Evaluator(memory=memory, disk=disk)


def run(package: Package, evaluator: Evaluator) -> tuple[dict[str, Any], set[str]]:
    """All outputs at x = 1 of the graph over the package as it is now, and the nodes that ran."""
    result = load(GRAPH, registry=package.registry()).run(OUTPUTS, evaluator=evaluator, x=1.0)
    return dict(result), {record.name for record in result.records if record.state == "ran"}


class TestCode:
    @pytest.mark.parametrize(("module", "before", "after", "changed"), EDITS.values(), ids=EDITS)
    def test_edited(
        self, package: Package, evaluator: Evaluator, module: str, before: str, after: str, changed: dict[str, float]
    ) -> None:
        """After an edit every output is what the code as it is now computes."""
        assert run(package, evaluator)[0] == BEFORE
        package.edit(module, before, after)
        assert run(package, evaluator)[0] == BEFORE | changed

    @pytest.mark.parametrize("edited", ["the body", "a helper", "a constant of another module", "a method"])
    def test_only_what_it_reaches(self, package: Package, evaluator: Evaluator, edited: str) -> None:
        """An edit runs the operators whose modules import the edited one and what lies below, and no others."""
        module, before, after, changed = EDITS[edited]
        run(package, evaluator)
        package.edit(module, before, after)
        ran = run(package, evaluator)[1]
        assert changed.keys() <= ran
        assert "source" not in ran
        assert "late" not in ran

    def test_not_edited(self, package: Package, evaluator: Evaluator) -> None:
        """Imported anew without an edit, nothing runs again."""
        run(package, evaluator)
        assert run(package, evaluator)[1] == set()

    def test_edited_back(self, package: Package, evaluator: Evaluator) -> None:
        """An edit taken back finds the first results again."""
        run(package, evaluator)
        package.edit("deep", "a * 3", "a * 4")
        run(package, evaluator)
        package.edit("deep", "a * 4", "a * 3")
        assert run(package, evaluator) == (BEFORE, set())

    def test_comments(self, package: Package, evaluator: Evaluator) -> None:
        """A comment or a blank line is no edit."""
        run(package, evaluator)
        package.edit("middle", "def outer", "# why\n\n\ndef outer")
        package.edit("ops", "import numpy as np", "import numpy as np  # for arrays")
        assert run(package, evaluator)[1] == set()

    def test_version(self, package: Package, evaluator: Evaluator) -> None:
        """A raised version runs the operator again though its code is the same."""
        run(package, evaluator)
        package.edit("ops", '@node("stale.direct")', '@node("stale.direct", version=2)')
        assert {"direct", "ruled"} <= run(package, evaluator)[1]


class TestRunningProcess:
    """The same in one process without a new import, as in a notebook."""

    @pytest.mark.parametrize(
        ("module", "name", "value", "changed"),
        [
            ("deep", "inner", lambda a: a * 4, {"helped": 18}),
            ("middle", "outer", lambda a: a, {"helped": 2}),
            ("settings", "GAIN", 5.0, {}),
            ("ops", "GAIN", 5.0, {"constant": 10}),
            ("lazily", "imported", lambda a: a, {"late": 2}),
        ],
    )
    def test_replaced(
        self,
        package: Package,
        evaluator: Evaluator,
        monkeypatch: pytest.MonkeyPatch,
        module: str,
        name: str,
        value: Any,
        changed: dict[str, float],
    ) -> None:
        """A helper or constant replaced in the loaded module counts from then on, for a graph loaded before."""
        graph = load(GRAPH, registry=package.registry())
        assert dict(graph.run(OUTPUTS, evaluator=evaluator, x=1.0)) == BEFORE
        owner = importlib.import_module(f"{package.name}.{module}")
        if (module, name) == ("deep", "inner"):  # `middle` holds the function itself
            owner = importlib.import_module(f"{package.name}.middle")
        monkeypatch.setattr(owner, name, value)
        assert dict(graph.run(OUTPUTS, evaluator=evaluator, x=1.0)) == BEFORE | changed

    def test_plugin_file(self, tmp_path: Path, evaluator: Evaluator) -> None:
        """A plug-in file edited between two loads."""
        plugin, text = tmp_path / "plug.py", "graphface: 1\nnodes: {n: {use: plug.one}}\n"
        for value in (1.0, 2.0, 1.0):
            plugin.write_text(
                f"from graphface import node\n@node('plug.one')\ndef one() -> float:\n    return {value}\n"
            )
            assert load(text, plugins=[plugin]).run(["n"], evaluator=evaluator)["n"] == value


IDENTITY = "graphface: 1\ninputs: {value: Any}\nnodes: {n: {use: toy.same, in: {value: value}}}\n"


@pytest.fixture
def same(registry: Registry, evaluator: Evaluator) -> Callable[[Any], tuple[Any, bool]]:
    """Passes a value through a graph: what came out, and whether a node ran for it."""
    graph = load(IDENTITY, registry=registry)

    def through(value: Any) -> tuple[Any, bool]:
        result = graph.run(["n"], evaluator=evaluator, value=value)
        return result["n"], any(r.name == "n" and r.state == "ran" for r in result.records)

    return through


def owned(array: Any) -> Any:
    """An array that nobody can write to: what shares a caller's writable memory is never memoized."""
    array.flags.writeable = False
    return array


class TestArrays:
    def test_same_bytes_other_dtype(self, same: Any) -> None:
        """The bytes of float32 and int32 zeros are the same, the arrays are not."""
        for dtype in ("<f4", "<i4", ">f4", "<u4"):
            out, _ = same(owned(np.zeros(6, dtype)))
            assert out.dtype == np.dtype(dtype)

    def test_same_bytes_other_shape(self, same: Any) -> None:
        """So for shapes, and for orders of axes."""
        for shape in ((6,), (2, 3), (3, 2), (1, 6), (6, 1), (2, 3, 1)):
            assert same(owned(np.zeros(shape)))[0].shape == shape
        assert (same(owned(np.arange(6.0).reshape(2, 3)))[0] == np.arange(6.0).reshape(2, 3)).all()
        assert (same(owned(np.asfortranarray(np.arange(6.0).reshape(3, 2))))[0] == np.arange(6.0).reshape(3, 2)).all()

    def test_scalars(self, same: Any) -> None:
        """1, 1.0, True, a NumPy 1 and a list or tuple of 1 are as many values."""
        values = [1, 1.0, True, "one", np.float32(1), np.int64(1), [1], (1,)]
        assert [type(same(value)[0]) for value in values] == [type(value) for value in values]

    def test_nan_hits(self, registry: Registry, tmp_path: Path) -> None:
        """An array that holds NaN equals itself: the second run finds the first."""
        graph = load(IDENTITY, registry=registry)
        evaluator = Evaluator(disk=DiskTier(tmp_path / "cache", 1 << 26), guard="off")
        for expected in ("ran", "disk"):
            result = graph.run(["n"], evaluator=evaluator, value=owned(np.array([1.0, np.nan])))
            assert [r.state for r in result.records if r.name == "n"] == [expected]
            np.testing.assert_array_equal(result["n"], [1.0, np.nan])

    def test_nan_payloads(self, same: Any, registry: Registry) -> None:
        """NaN with another payload is another array; -0.0 is not 0.0."""
        assert np.signbit(same(owned(np.array([-0.0])))[0])
        assert not np.signbit(same(owned(np.array([0.0])))[0])

    def test_written_by_the_caller(self, registry: Registry, evaluator: Evaluator) -> None:
        """An array that its owner writes to after a run is another input in the next."""
        graph = load(IDENTITY, registry=registry)
        mine = np.zeros(4)
        graph.run(["n"], evaluator=evaluator, value=mine)
        mine[0] = 1
        assert graph.run(["n"], evaluator=evaluator, value=mine)["n"][0] == 1
        mine[0] = 0
        assert graph.run(["n"], evaluator=evaluator, value=mine)["n"][0] == 0

    def test_written_in_place(self, registry: Registry, evaluator: Evaluator) -> None:
        """A memoized array cannot be written to: not by its receiver, nor by a node that gets it."""
        text = "graphface: 1\nnodes:\n  grid: {use: toy.grid}\n  bad: {use: toy.write, in: {grid: grid}}\n"
        graph = load(text, registry=registry)
        for _ in range(2):
            kept = graph.run(["grid"], evaluator=evaluator)["grid"]
            with pytest.raises(ValueError, match="read-only"):
                kept[0, 0] = 5
            with pytest.raises(RunFailed) as caught:
                graph.run(["bad"], evaluator=evaluator)
            assert isinstance(caught.value.failures[0], NodeError)
            assert "read-only" in caught.value.failures[0].reason
        np.testing.assert_array_equal(graph.run(["grid"], evaluator=evaluator)["grid"], np.ones((4, 4)))

    @given(
        st.lists(
            st.tuples(
                st.sampled_from(["<f4", "<f8", "<i4", "<i8", "|u1", "|b1", "<c8", "<f2"]),
                st.lists(st.integers(0, 3), max_size=3),
                st.integers(0, 1),
            ),
            min_size=2,
            max_size=12,
        )
    )
    @settings(max_examples=60, deadline=None)
    def test_never_another_array(self, asked: list[tuple[str, list[int], int]]) -> None:
        """However arrays of equal bytes follow each other, each comes back with its own dtype, shape and content."""
        from toys import toy_registry

        graph = load(IDENTITY, registry=toy_registry())
        evaluator = Evaluator(memory=MemoryTier())
        for dtype, shape, fill in asked:
            array = owned(np.full(shape, fill, dtype))
            out = graph.run(["n"], evaluator=evaluator, value=array)["n"]
            assert (out.dtype, out.shape) == (array.dtype, array.shape)
            np.testing.assert_array_equal(out, array)


class TestFiles:
    @pytest.mark.parametrize("shortcut", [True, False])
    def test_rewritten(self, registry: Registry, evaluator: Evaluator, tmp_path: Path, shortcut: bool) -> None:
        """A file rewritten at once, with the same size, is read anew."""
        graph = load(
            "graphface: 1\ninputs: {m: Mask}\nnodes: {n: {use: toy.same, in: {value: m}}}\n",
            registry=_with_mask(registry),
        )
        path = tmp_path / "mask.png"
        for level in (0, 255, 0, 128):
            _write_mask(path, level)
            bound = graph.bind({"m": str(path)}, stat_shortcut=shortcut)
            value = evaluator.run(graph.request(bound, ["n"]))["n"]
            assert float(value.max()) == pytest.approx(level / 255)


def _with_mask(registry: Registry) -> Registry:
    from toys import PACK

    types, files = {"Mask": "graphface.nodes.types:Mask"}, {"Mask": "graphface.nodes.io.files:MASK"}
    return Registry([PACK, Pack("masks", operators={}, types=types, files=files)])


def _write_mask(path: Path, level: int) -> None:
    from graphface.nodes.io.image_write import write_picture

    write_picture(np.full((8, 8), level, np.uint8), path)
