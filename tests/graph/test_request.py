"""What can be asked of a graph: outputs, nodes, fields, inputs."""

import numpy as np
import pytest
from graph_texts import SUMS

from graphface import Graph, Registry, load
from graphface.errors import InputError
from graphface.values.digest import digest_value


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(SUMS, registry=registry)


class TestRequests:
    def test_all_outputs(self, graph: Graph) -> None:
        """By default all declared outputs are computed."""
        assert set(graph.run(g=np.ones((2, 2)))) == {"y", "low"}

    def test_any_node(self, graph: Graph) -> None:
        """Any node, field or input can be asked for."""
        result = graph.run(["m", "p.high", "x"], g=np.ones((2, 2)))
        assert result["m"] == 1
        assert result["p.high"].max() == 2
        assert result["x"] == 2

    @pytest.mark.parametrize("name", ["mm", "p.hihg", "m.low", "", ".", "y.low"])
    def test_unknown(self, graph: Graph, name: str) -> None:
        """What the graph does not have is refused by name."""
        with pytest.raises(InputError) as caught:
            graph.targets([name])
        assert caught.value.name == name

    def test_missing(self, graph: Graph) -> None:
        """Inputs that a request needs and nobody gave are known before running."""
        assert graph.missing({}, graph.targets(["m"]).values()) == ["g"]
        assert graph.missing({}, graph.targets(["y"]).values()) == []

    def test_type(self, graph: Graph) -> None:
        """The type behind a target is known before running."""
        assert str(graph.type_of(graph.targets(["p.high"])["p.high"])) == "Grid | None"


class TestNumbersGivenAgain:
    @pytest.mark.parametrize(("one", "other"), [(0.0, -0.0), (1, 1.0), (1.0, 2.0)])
    def test_never_taken_for_another(self, graph: Graph, one: object, other: object) -> None:
        """A number is recognised by being the same object: equal ones of another type or sign have their own keys."""
        keys = [graph.request({"x": x}, ["y"]).key(0) for x in (one, other, one, other)]
        assert keys[0] == keys[2] != keys[1] == keys[3]

    def test_not_hashed_again(self, graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
        """The same number again costs no hash; an array is looked at every time, since its owner may write to it."""
        hashed: list[object] = []
        monkeypatch.setattr("graphface.graph.inputs.digest_value", lambda v: (hashed.append(v), digest_value(v))[1])
        number, grid = 12345.678, np.ones((2, 2))
        graph.request({"x": number, "g": grid})
        assert len(hashed) == 2
        graph.request({"x": number, "g": grid})
        assert len(hashed) == 3

    def test_default_after_number(self, graph: Graph) -> None:
        """An input that is left out has its default again."""
        assert [graph.run("y", **given)["y"] for given in ({"x": 5.0}, {}, {"x": 5.0})] == [6, 3, 6]
