"""Asking a node's `needs` rule which of its lazy ports it wants.

The rule is a plain function of some eager inputs and parameters. Where all inputs it names are graph inputs it is asked
before anything runs: the plan is then exact, and what is declined has no part in the node's key.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from graphface.graph.wiring import Step

if TYPE_CHECKING:
    from graphface.graph.inputs import Bound


def declined_with(step: Step, eager: Mapping[str, Any]) -> dict[str, str]:
    """Lazy ports that the rule declines, each with its reason, given the values of the eager ports.

    Raises:
        Exception: whatever the rule raises.
    """
    rule = step.operator.needs
    if rule is None:
        return {}
    known = {**{p.name: None for p in step.operator.inputs.values() if not p.lazy}, **eager, **step.parameters}
    answers = rule(**{name: known[name] for name in step.operator.rule_arguments})
    return {
        port: answer if isinstance(answer, str) else "its rule does not want it"
        for port, answer in answers.items()
        if isinstance(answer, str) or not answer
    }


def declined_now(step: Step, bound: Sequence[Bound | None]) -> dict[str, str] | None:
    """As `declined_with` from graph inputs alone; None where the rule must wait for a value to be computed."""
    if step.operator.needs is None:
        return {}
    plugged = {a.port: a for a in step.arguments}
    eager: dict[str, Any] = {}
    for name in step.operator.rule_arguments:
        argument = plugged.get(name)
        if argument is None:
            continue
        inputs = [bound[ref.slot] if ref.slot < len(bound) else None for ref in argument.refs]
        if argument.is_list or inputs[0] is None:
            return None
        value = inputs[0].value
        for field in argument.refs[0].fields:
            value = getattr(value, field)
        eager[name] = value
    return declined_with(step, eager)
