"""Graphs go on working after operators, ports and parameters were renamed, with one warning for each place."""

import warnings
from pathlib import Path
from typing import Annotated

import pytest
from pydantic import Field

from graphface import DocumentError, Formerly, Graph, GraphfaceWarning, Lazy, Registry, load, node


@node("hair.beard", formerly=("face.shaved", "hair.whiskers"))
def beard(
    photo: Annotated[float, Formerly("picture")],
    paint: Annotated[float, Formerly("cover")] | None = None,
    *,
    softness: Annotated[float, Field(ge=0, le=9), Formerly("doubt", "unsure")] = 1.0,
) -> float:
    return photo + (paint or 0.0) + 10 * softness


Softness = Annotated[float, Formerly("doubt")]


@node("hair.stubble")
def stubble(
    photo: Annotated[float, Formerly("picture")], *, softness: Annotated[float, Formerly("doubt")] = 1.0
) -> float:
    return photo + 100 * softness


@node("hair.lazy", needs=lambda: {"photo": True})
def lazy(photo: Annotated[Lazy[float], Formerly("picture")]) -> float:
    return photo or 0.0


@pytest.fixture
def renamed(registry: Registry) -> Registry:
    for function in (beard, stubble, lazy):
        registry.add(function)
    return registry


TEXT = """graphface: 1
inputs: {x: float}
nodes:
  b: {use: face.shaved, in: {picture: x}, with: {doubt: 2}}
outputs: {y: b}
"""


def told(registry: Registry, source: object, **choices: object) -> tuple[Graph, list[str]]:
    """A graph, and what loading it warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        graph = load(source, registry=registry, **choices)  # type: ignore[arg-type]
    assert all(warning.category is GraphfaceWarning for warning in caught)
    return graph, [str(warning.message) for warning in caught]


class TestGraphFile:
    def test_old_names(self, renamed: Registry) -> None:
        """Old names of an operator, a port and a parameter work; each place is warned of with the present name."""
        graph, said = told(renamed, TEXT)
        assert graph.run(x=1.0)["y"] == 21
        assert said == [
            "<text>:4:12: operator 'face.shaved' is now called 'hair.beard'",
            "<text>:4:39: port 'picture' of hair.beard is now called 'photo'",
            "<text>:4:50: parameter 'doubt' of hair.beard is now called 'softness'",
        ]

    def test_present_names(self, renamed: Registry) -> None:
        """Present names warn of nothing, and mean the same."""
        text = TEXT.replace("face.shaved", "hair.beard").replace("picture", "photo").replace("doubt", "softness")
        graph, said = told(renamed, text)
        assert (graph.run(x=1.0)["y"], said) == (21, [])

    def test_second_old_name(self, renamed: Registry) -> None:
        """A thing renamed twice has two old names."""
        text = TEXT.replace("face.shaved", "hair.whiskers").replace("doubt", "unsure")
        graph, said = told(renamed, text)
        assert (graph.run(x=1.0)["y"], len(said)) == (21, 3)

    def test_lazy_port(self, renamed: Registry) -> None:
        """A lazy port may have an old name."""
        graph, said = told(renamed, TEXT.replace("face.shaved", "hair.lazy").replace(", with: {doubt: 2}", ""))
        assert (graph.run(x=1.0)["y"], len(said)) == (1, 1)

    def test_range(self, renamed: Registry) -> None:
        """A value out of range is refused under the present name, at its place."""
        with pytest.warns(GraphfaceWarning), pytest.raises(DocumentError) as caught:
            load(TEXT.replace("doubt: 2", "doubt: 20"), registry=renamed)
        (problem,) = caught.value.problems
        assert "'softness'" in problem.message
        assert problem.place is not None
        assert problem.place.line == 4

    def test_used_twice(self, renamed: Registry, tmp_path: Path) -> None:
        """A place is warned of once, however many nodes come from it."""
        (tmp_path / "inner.yaml").write_text(TEXT)
        outer = tmp_path / "outer.yaml"
        outer.write_text(
            "graphface: 1\ninputs: {x: float}\nnodes:\n  one: {use: inner.yaml, in: {x: x}}\n"
            "  two: {use: inner.yaml, in: {x: one.y}}\noutputs: {y: two.y}\n"
        )
        graph, said = told(renamed, outer)
        assert (graph.run(x=1.0)["y"], len(said)) == (41, 3)


class TestLaidOver:
    def extended(self, tmp_path: Path, base: str, own: str) -> Path:
        (tmp_path / "base.yaml").write_text(base)
        path = tmp_path / "own.yaml"
        path.write_text(f"graphface: 1\nextends: base.yaml\nnodes: {{b: {own}}}\n")
        return path

    @pytest.mark.parametrize(("below", "above"), [("doubt", "softness"), ("softness", "doubt"), ("doubt", "unsure")])
    def test_either_name(self, renamed: Registry, tmp_path: Path, below: str, above: str) -> None:
        """Whichever name a file uses, it wins over its base."""
        path = self.extended(tmp_path, TEXT.replace("doubt", below), f"{{with: {{{above}: 3}}}}")
        assert told(renamed, path)[0].run(x=1.0)["y"] == 31

    def test_three_layers(self, renamed: Registry, tmp_path: Path) -> None:
        """The strongest layer wins also where the one between uses another name."""
        path = self.extended(tmp_path, TEXT, "{with: {softness: 3}}")
        assert told(renamed, path, set={"b.doubt": 4})[0].run(x=1.0)["y"] == 41

    def test_unplugged(self, renamed: Registry, tmp_path: Path) -> None:
        """Null under an old name unplugs what the base plugged in under the present one."""
        base = TEXT.replace("{picture: x}", "{photo: x, paint: x}")
        path = self.extended(tmp_path, base, "{in: {cover: null}}")
        graph, said = told(renamed, path)
        assert graph.run(x=1.0)["y"] == 21
        assert any("'paint'" in sentence for sentence in said)

    def test_carried(self, renamed: Registry) -> None:
        """What was written for another operator is led to the present name of the one that takes its place."""
        graph, _ = told(renamed, TEXT, replace={"b": "hair.stubble"})
        assert graph.steps[0].parameters == {"softness": 2}


class TestChoices:
    TEXT = TEXT.replace("face.shaved", "hair.beard").replace("picture", "photo").replace(", with: {doubt: 2}", "")

    def test_set(self, renamed: Registry) -> None:
        """`set` takes an old name."""
        graph, said = told(renamed, self.TEXT, set={"b.doubt": 3})
        assert graph.run(x=1.0)["y"] == 31
        assert said == ["--set:1:1: parameter 'doubt' of hair.beard is now called 'softness'"]

    def test_replace(self, renamed: Registry) -> None:
        """`replace` takes an old name."""
        graph, said = told(renamed, self.TEXT.replace("hair.beard", "hair.stubble"), replace={"b": "face.shaved"})
        assert graph.steps[0].operator.name == "hair.beard"
        assert len(said) == 1

    def test_effective_text(self, renamed: Registry) -> None:
        """The effective document has the present names."""
        text = told(renamed, TEXT)[0].effective(origins=False)
        assert told(renamed, text)[1] == []


def test_installed_packs_agree() -> None:
    """What a pack says of old names, operators say too; an operator that changed its family stands in its pack."""
    from graphface.registry import default_registry

    registry = default_registry()
    operators = [registry.operator(name) for name in registry.names()]
    moved = {old: op.name for op in operators for old in op.formerly if old.rpartition(".")[0] != op.family}
    packs = {old: new for pack in registry._packs for old, new in pack.formerly.items()}
    declared = {old: op.name for op in operators for old in op.formerly}
    assert moved.items() <= packs.items()
    assert packs.items() <= declared.items()
    assert not {op.name for op in operators} & declared.keys()
