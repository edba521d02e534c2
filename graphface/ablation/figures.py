"""Figures: the operators of the family `metrics` that can compare two values of the output's type."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from graphface.errors import UsageError, did_you_mean, nearest_names

if TYPE_CHECKING:
    from graphface.node import Operator
    from graphface.registry import Registry
    from graphface.values.port_types import PortType

FAMILY = "metrics"


@dataclass(frozen=True)
class Metric:
    """A named comparison of a result with the truth."""

    name: str
    operator: Operator

    @property
    def better(self) -> Literal["higher", "lower"] | None:
        """Which of two figures is the better one; None where the operator does not say (`graphface.Figure`)."""
        return self.operator.figure.better if self.operator.figure is not None else None

    @property
    def unit(self) -> str:
        return self.operator.figure.unit if self.operator.figure is not None else ""


def metrics_for(declared: PortType, registry: Registry, asked: Sequence[str] = ()) -> list[Metric]:
    """The metrics whose first two ports take values of this type, and that need nothing else.

    Args:
        asked: their names, with or without the family; all that fit by default.

    Raises:
        UsageError: a metric that is not there or does not fit.
    """
    found = {}
    for operator in registry.operators():
        if operator.family == FAMILY and _fits(operator, declared):
            short = operator.name.removeprefix(f"{FAMILY}.")
            found[short] = Metric(short, operator)
    if not asked:
        return list(found.values())
    chosen = []
    for name in asked:
        short = name.removeprefix(f"{FAMILY}.")
        if short not in found:
            raise UsageError(f"no metric {name!r} for {declared}{did_you_mean(nearest_names(short, found))}")
        chosen.append(found[short])
    return chosen


def measured(metrics: Sequence[Metric], value: Any, truth: Any) -> dict[str, float]:
    """Every metric of a value against the truth; one that refuses the pair (another size, say) is left out."""
    figures = {}
    for metric in metrics:
        first, second = list(metric.operator.inputs)[:2]
        try:
            figures[metric.name] = float(metric.operator.function(**{first: value, second: truth}, **_absent(metric)))
        except ValueError:
            continue
    return figures


def _fits(operator: Operator, declared: PortType) -> bool:
    ports = list(operator.inputs.values())
    return (
        len(ports) >= 2
        and all(port.type.accepts(declared) for port in ports[:2])
        and not any(port.required for port in ports[2:])
        and float in operator.output.alternatives
    )


def _absent(metric: Metric) -> dict[str, None]:
    ports = list(metric.operator.inputs)[2:]
    return {name: None for name in metric.operator.needs_none if name in ports}
