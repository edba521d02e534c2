"""What a step needs of the slots above it: the one rule that run, plan, history and explain go by.

Eager ports are always needed. Of the lazy ones a step's `needs` rule says which it declines. Where all inputs that the
rule names are graph inputs it is asked before anything runs: the plan is then exact, and what is declined has no part
in the node's key. Otherwise it is asked when the step's eager inputs are there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from graphface.graph.inputs import Bound
from graphface.graph.keys import Declined
from graphface.graph.structure import Step


def demanded(step: Step, declined: Declined | None) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """The slots that a step needs, and those that it may need besides, each once.

    Args:
        declined: the lazy ports that its rule declines; None where the rule has not been asked yet.
    """
    if not step.lazy:
        return step.eager, ()
    if declined is None:
        return step.eager, step.lazy
    wanted = (r.slot for a in step.arguments if a.lazy and a.port not in declined for r in a.refs)
    return tuple(dict.fromkeys((*step.eager, *wanted))), ()


def refused(step: Step, declined: Declined) -> dict[int, str]:
    """The slots behind the ports that a step declines, with the reason."""
    return {r.slot: declined[a.port] for a in step.arguments if a.port in declined for r in a.refs}


def reached(starts: Iterable[int], above: Callable[[int], Iterable[int]]) -> set[int]:
    """Every slot reached from `starts`, which are among them; `above` says what stands above one."""
    seen: set[int] = set()
    stack = list(starts)
    while stack:
        slot = stack.pop()
        if slot not in seen:
            seen.add(slot)
            stack.extend(above(slot))
    return seen


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


def declined_before(step: Step, bound: Sequence[Bound | None]) -> dict[str, str] | None:
    """As `declined_with`, from graph inputs alone; None where the rule must wait for a value to be computed.

    A rule that fails here waits too: asked again in the run, its failure is that of a node with a name and a place.
    """
    if step.operator.needs is None:
        return {}
    plugged = {a.port: a for a in step.arguments}
    eager: dict[str, Any] = {}
    try:
        for name in step.operator.rule_arguments:
            argument = plugged.get(name)
            if argument is None:
                continue
            inputs = [bound[ref.slot] if ref.slot < len(bound) else None for ref in argument.refs]
            if argument.is_list or inputs[0] is None:
                return None
            eager[name] = take(inputs[0].value, argument.refs[0].fields)
        return declined_with(step, eager)
    except Exception:
        return None


def take(value: Any, fields: Sequence[str]) -> Any:
    """`value.field.field...`; None where one on the way is None, as the type of such a reference says."""
    for name in fields:
        if value is None:
            return None
        value = getattr(value, name)
    return value
