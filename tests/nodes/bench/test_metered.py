"""What results cost on an evaluator that variants share; seconds are set by hand, so that no clock decides."""

from __future__ import annotations

import pytest
from toys import toy_registry

from graphface import load
from graphface.nodes.bench import metered
from graphface.nodes.bench.metered import MeteredEvaluator

CHAIN = """
graphface: 1
inputs: {x: {type: float, default: 1.0}}
nodes:
  first: {use: toy.add, in: {a: x}, with: {plus: 1}}
  second: {use: toy.add, in: {a: first}, with: {plus: 2}}
  third: {use: toy.add, in: {a: second, b: first}, with: {plus: 3}}
outputs: {third: third}
"""


@pytest.fixture
def evaluator(monkeypatch):
    """Every node takes one millisecond."""
    now = [0.0]

    def clock() -> float:
        now[0] += 1e-3
        return now[0]

    monkeypatch.setattr(metered.time, "process_time", clock)
    return MeteredEvaluator()


def chain(**settings):
    return load(CHAIN, registry=toy_registry(), set=settings)


class TestCost:
    def test_all_that_is_behind(self, evaluator):
        """A node that is needed twice counts once."""
        graph = chain()
        graph.run(evaluator=evaluator, x=1.0)
        assert evaluator.cpu_ms(evaluator.key("third")) == pytest.approx(3)

    def test_what_was_shared_counts_for_every_variant(self, evaluator, ran):
        """The second variant runs one node and is charged for three."""
        for graph in (chain(), chain(**{"third.plus": 9.0})):
            graph.run(evaluator=evaluator, x=1.0)
            assert evaluator.cpu_ms(evaluator.key("third")) == pytest.approx(3)
        assert len(ran) == 4

    def test_without_what_is_at_hand(self, evaluator):
        """Given a result, only what comes after it counts; given the result itself, nothing."""
        graph = chain()
        graph.run(evaluator=evaluator, x=1.0)
        first, second, third = (evaluator.key(name) for name in ("first", "second", "third"))
        assert evaluator.cpu_ms(third, [second]) == pytest.approx(1)
        assert evaluator.cpu_ms(third, [first]) == pytest.approx(2)
        assert evaluator.cpu_ms(third, [third]) == 0

    def test_an_edit(self, evaluator):
        """Beside the result of another input, everything that the input reaches."""
        graph = chain()
        graph.run(evaluator=evaluator, x=1.0)
        before = evaluator.key("third")
        graph.run(evaluator=evaluator, x=2.0)
        assert evaluator.cpu_ms(evaluator.key("third"), [before]) == pytest.approx(3)

    def test_an_input_costs_nothing(self, evaluator):
        """It was given."""
        graph = chain()
        graph.run(["x", "third"], evaluator=evaluator, x=1.0)
        assert evaluator.cpu_ms(evaluator.key("x")) == 0


class TestForget:
    def test_runs_again(self, evaluator, ran):
        """What is forgotten runs once more; what it needs is still there."""
        graph = chain()
        graph.run(evaluator=evaluator, x=1.0)
        ran.clear()
        evaluator.forget(evaluator.key("third"))
        graph.run(evaluator=evaluator, x=1.0)
        assert len(ran) == 1

    def test_the_least_counts(self, evaluator, monkeypatch):
        """A first run that imports is slower and says nothing of the method."""
        graph = chain()
        graph.run(evaluator=evaluator, x=1.0)
        key = evaluator.key("third")
        monkeypatch.setattr(metered.time, "process_time", lambda: 0.0)
        evaluator.forget(key)
        graph.run(evaluator=evaluator, x=1.0)
        assert evaluator.cpu_ms(key) == pytest.approx(2)


DECLINING = """
graphface: 1
inputs: {x: {type: float, default: 1.0}}
nodes:
  extra: {use: toy.add, in: {a: x}, with: {plus: 2}}
  chosen: {use: toy.positive, in: {a: x, extra: extra}}
"""


class TestDeclined:
    @pytest.mark.parametrize(("x", "cost"), [(1.0, 2), (-1.0, 1)])
    def test_what_a_node_declines_is_not_behind_it(self, evaluator, x, cost):
        """Not even where something else had it run."""
        graph = load(DECLINING, registry=toy_registry())
        graph.run(["extra"], evaluator=evaluator, x=x)
        graph.run(["extra", "chosen"], evaluator=evaluator, x=x)
        assert evaluator.cpu_ms(evaluator.key("chosen")) == pytest.approx(cost)
