"""From `--swap intrinsic=intensity,retinex` to the variants of a graph.

A swap has a subject and values. The subject is a node ("intrinsic", or its path "face/intrinsic" where two nodes share
the name), a parameter ("light.order"), "variant" or "profile". Values of a node are operators of its family, with or
without the family's name. "all" stands for every value there is: the operators of the family that fit, the choices of a
parameter, the declared variants or profiles after "none" of them.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from graphface.document.scalars import scalar
from graphface.errors import UsageError, did_you_mean, nearest_names

if TYPE_CHECKING:
    from graphface.facade import Graph
    from graphface.graph.structure import Step

OVERLAYS = ("variant", "profile")
ALL = "all"
NONE = "none"
"""In place of a variant or profile: the graph without one, unless it declares one of that name."""


@dataclass(frozen=True)
class Swap:
    """What is swapped (`subject`, a path) and for what; `kind` is "operator", "parameter", "variant" or "profile"."""

    kind: str
    subject: str
    values: tuple[Any, ...]
    text: str


@dataclass(frozen=True)
class Variant:
    """One setting of every swap, as `graphface.load` takes it."""

    name: str
    replace: Mapping[str, str] = field(default_factory=dict)
    set: Mapping[str, Any] = field(default_factory=dict)
    variants: tuple[str, ...] = ()
    profiles: tuple[str, ...] = ()


def read_swaps(texts: Sequence[str], graph: Graph) -> list[Swap]:
    """Parse swaps against the graph they are for.

    Raises:
        UsageError: not of the form NAME=VALUE,VALUE, or a node, parameter or operator that is not there.
    """
    return [_read(text, graph) for text in texts]


def variants(swaps: Sequence[Swap], *, one_at_a_time: bool = False) -> list[Variant]:
    """Every combination of the swaps' values; the first has all first values.

    Args:
        one_at_a_time: instead of the product, the first combination and those that differ from it in one swap.
    """
    if one_at_a_time:
        first = tuple(swap.values[0] for swap in swaps)
        combinations = [first]
        for place, swap in enumerate(swaps):
            combinations += [(*first[:place], value, *first[place + 1 :]) for value in swap.values[1:]]
    else:
        combinations = list(itertools.product(*(swap.values for swap in swaps)))
    return [_variant(swaps, values) for values in dict.fromkeys(combinations)]


def _read(text: str, graph: Graph) -> Swap:
    subject, equals, listed = text.partition("=")
    values = [value.strip() for value in listed.split(",") if value.strip()]
    if not equals or not subject or not values:
        raise UsageError(f"--swap {text!r}: expected NODE=METHOD,METHOD or NODE.PARAMETER=VALUE,VALUE")
    if subject in OVERLAYS:
        return Swap(subject, subject, _overlays(subject, values, graph), text)
    step = _step(subject, graph)
    if step is not None:
        named = _expanded(
            values, lambda: [o.name for o in (step.operator, *graph.registry.alternatives(step.operator))]
        )
        return Swap("operator", step.name, tuple(_operator(value, step, graph, text) for value in named), text)
    return _parameter_swap(subject, values, text, graph)


def _overlays(kind: str, values: Sequence[str], graph: Graph) -> tuple[str | None, ...]:
    """Names of variants or profiles; None for the graph without one."""
    declared = graph.composition.variants if kind == "variant" else graph.composition.profiles
    named = _expanded(values, lambda: [NONE, *declared])
    return tuple(None if name == NONE and NONE not in declared else name for name in named)


def _expanded(values: Sequence[Any], everything: Callable[[], Sequence[Any]]) -> list[Any]:
    """The values, with "all" replaced by every value there is; each once."""
    return list(dict.fromkeys(v for value in values for v in (everything() if value == ALL else [value])))


def _parameter_swap(subject: str, values: Sequence[str], text: str, graph: Graph) -> Swap:
    name, _, parameter = subject.rpartition(".")
    step = _step(name, graph) if name else None
    if step is None:
        wanted = name or subject
        near = did_you_mean(nearest_names(wanted, [s.name.rpartition("/")[2] for s in graph.steps]))
        raise UsageError(f"--swap {text!r}: no node {wanted!r}{near}")
    parameters = [*step.operator.parameters.model_fields, *step.operator.renamed]
    if parameter not in parameters:
        near = did_you_mean(nearest_names(parameter, parameters))
        raise UsageError(f"--swap {text!r}: {step.operator.name} has no parameter {parameter!r}{near}")
    present = step.operator.renamed.get(parameter, parameter)
    named = _expanded([scalar(value) for value in values], lambda: _choices(step, present, text))
    return Swap("parameter", f"{step.name}.{parameter}", tuple(named), text)


def _choices(step: Step, parameter: str, text: str) -> list[Any]:
    """Everything that a parameter can be, where those are few: the choices of a Literal, both of a flag."""
    described = step.operator.parameters.model_json_schema()["properties"][parameter]
    if described.get("type") == "boolean":
        return [False, True]
    if "enum" not in described:
        raise UsageError(f"--swap {text!r}: {parameter!r} can be more than a list says; name its values")
    return list(described["enum"])


def _step(name: str, graph: Graph) -> Step | None:
    """The node of this path, or the only one whose path ends in it."""
    exact = [step for step in graph.steps if step.name == name]
    found = exact or [step for step in graph.steps if step.name.endswith(f"/{name}")]
    if len(found) > 1:
        raise UsageError(f"--swap {name}=...: several nodes have this name: {', '.join(s.name for s in found)}")
    return found[0] if found else None


def _operator(value: str, step: Step, graph: Graph, text: str) -> str:
    """The full name, present or old, of an operator that may take the node's place."""
    operators = [step.operator, *graph.registry.alternatives(step.operator)]
    fitting = [name for operator in operators for name in (operator.name, *operator.formerly)]
    for name in (value, f"{step.operator.family}.{value}"):
        if name in fitting:
            return name
    near = did_you_mean(nearest_names(f"{step.operator.family}.{value}", fitting))
    raise UsageError(
        f"--swap {text!r}: {value!r} cannot take the place of {step.operator.name} (node {step.name!r}){near}"
    )


def _variant(swaps: Sequence[Swap], values: Sequence[Any]) -> Variant:
    pairs = list(zip(swaps, values, strict=True))
    return Variant(
        name=" · ".join(_label(swap, value) for swap, value in pairs) or "as it is",
        replace={s.subject: v for s, v in pairs if s.kind == "operator"},
        set={s.subject: v for s, v in pairs if s.kind == "parameter"},
        variants=tuple(v for s, v in pairs if s.kind == "variant" and v is not None),
        profiles=tuple(v for s, v in pairs if s.kind == "profile" and v is not None),
    )


def _label(swap: Swap, value: Any) -> str:
    shown = NONE if value is None and swap.kind in OVERLAYS else value
    return str(shown) if swap.kind == "operator" else f"{swap.subject.rpartition('/')[2]}={shown}"
