"""Lazy ports: what a node may decline is computed only when it wants it."""

import pytest
from evaluator_lab import Lab

from graphface import RunFailed


class TestLazyPorts:
    GATE = """
        a: {use: toy.number, with: {value: 1}}
        costly: {use: toy.slow, in: {a: a}, with: {label: costly}}
        gate: {use: toy.gate, in: {a: a, extra: costly}, with: {open: false}}
    """
    POSITIVE = """
        a: {use: toy.number, with: {value: -1}}
        costly: {use: toy.slow, in: {a: a}, with: {label: costly}}
        gate: {use: toy.positive, in: {a: a, extra: costly}}
    """

    def test_declined_before_the_run(self, lab: Lab) -> None:
        """What is declined by a parameter alone never runs."""
        assert lab.run(lab.load(self.GATE), ["gate"])["gate"] == 1
        assert "costly" not in lab.ran

    def test_wanted_before_the_run(self, lab: Lab) -> None:
        """What the rule wants runs."""
        assert lab.run(lab.load(self.GATE.replace("false", "true")), ["gate"])["gate"] == 2
        assert "costly" in lab.ran

    def test_declined_after_a_value(self, lab: Lab) -> None:
        """A rule may look at a computed value."""
        assert lab.run(lab.load(self.POSITIVE), ["gate"])["gate"] == -1
        assert "costly" not in lab.ran

    def test_wanted_after_a_value(self, lab: Lab) -> None:
        """What a rule wants after seeing a value runs then, and what it shares with others is not run again."""
        assert lab.run(lab.load(self.POSITIVE.replace("-1", "2")), ["gate"])["gate"] == 4
        assert sorted(lab.ran) == ["costly", "number", "positive"]

    def test_value_used_before_and_after_the_decision(self, lab: Lab) -> None:
        """A value whose other users are done by the time a rule wants it was not computed twice."""
        graph = lab.load("""
            base: {use: toy.number, with: {value: 1, label: base}}
            shared: {use: toy.add, in: {a: base}, with: {plus: 5, label: shared}}
            early: {use: toy.add, in: {a: shared}, with: {label: early}}
            late: {use: toy.add, in: {a: shared}, with: {plus: 1, label: late}}
            gate: {use: toy.positive, in: {a: early, extra: late}, with: {label: gate}}
        """)
        assert lab.run(graph, ["gate"])["gate"] == 13
        assert sorted(lab.ran) == ["base", "early", "gate", "late", "shared"]

    def test_reason(self, quick: Lab) -> None:
        """The reason stands in the records."""
        declined = [r for r in quick.run(quick.load(self.GATE), ["gate"]).records if r.state == "declined"]
        assert [(r.name, r.reason) for r in declined] == [("gate.extra", "the gate is shut")]

    def test_unplugged(self, lab: Lab) -> None:
        """A lazy port that nothing is plugged into is None."""
        assert lab.run(lab.load("a: {use: toy.number}\ngate: {use: toy.gate, in: {a: a}}"), ["gate"])["gate"] == 1

    def test_rule_on_an_input(self, lab: Lab) -> None:
        """A rule that looks at a graph input decides before the run, anew for every input."""
        nodes = (
            "costly: {use: toy.slow, in: {a: x}, with: {label: costly}}\n"
            "gate: {use: toy.positive, in: {a: x, extra: costly}}"
        )
        graph = lab.load(nodes, inputs="x: float")
        assert [lab.run(graph, ["gate"], x=x)["gate"] for x in (1.0, -1.0, 2.0, -1.0)] == [2, -1, 4, -1]

    def test_numpy_answer(self, quick: Lab) -> None:
        """A rule may answer with NumPy's bool."""
        graph = quick.load("g: {use: toy.numpy_gate, in: {a: x, extra: x}}", inputs="x: float")
        assert [quick.run(graph, ["g"], x=x)["g"] for x in (1.0, -1.0)] == [2, -1]

    def test_declined_value_does_not_count(self, lab: Lab) -> None:
        """What is declined before the run has no part in the key."""
        lab.run(lab.load(self.GATE), ["gate"])
        lab.run(lab.load(self.GATE.replace("label: costly", "seconds: 0.001")), ["gate"])
        assert (lab.ran == []) == lab.keeps

    def test_long_chain(self, quick: Lab) -> None:
        """Thousands of lazy ports behind each other need no recursion."""
        nodes = ["n0: {use: toy.number}"]
        nodes += [f"n{i}: {{use: toy.positive, in: {{a: x, extra: n{i - 1}}}}}" for i in range(1, 2000)]
        graph = quick.load("\n".join(nodes), inputs="x: float")
        quick.run(graph, ["n0"], x=0.5)
        assert quick.run(graph, ["n1999"], x=0.5)["n1999"] == 1 + 1999 * 0.5
        assert quick.run(graph, ["n1999"], x=0.25)["n1999"] == 1 + 1999 * 0.25

    @pytest.mark.parametrize("a", ["x", "n"], ids=["before the run", "in the run"])
    def test_failing_rule(self, quick: Lab, a: str) -> None:
        """A rule that raises is that node's failure."""
        nodes = f"n: {{use: toy.number}}\ng: {{use: toy.broken_rule, in: {{a: {a}, extra: n}}}}"
        graph = quick.load(nodes, inputs="x: {type: float, default: 1}")
        for _ in range(2):
            with pytest.raises(RunFailed) as caught:
                quick.run(graph, ["g"])
            assert caught.value.failures[0].node == "g"
            assert isinstance(caught.value.failures[0].__cause__, LookupError)
        assert quick.run(graph, ["n"])["n"] == 1
