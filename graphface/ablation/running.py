"""Running the variants on one memory tier, so that what they have in common is computed once, and keeping the accounts.

Two times are told of every variant: `alone`, what its nodes take when nothing is memoized (each measured the one time
it ran), and `spent`, what it took here. Their difference, summed, is what sharing saved.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphface.ablation.figures import Metric, measured
from graphface.ablation.swaps import Variant, read_swaps, variants
from graphface.cache.memory import MemoryTier
from graphface.errors import RunFailed, UsageError
from graphface.evaluate.evaluator import Evaluator
from graphface.facade import Graph, load
from graphface.graph.request import Request, request
from graphface.record import Record


@dataclass(frozen=True)
class Cell:
    """One variant on one case.

    `value` is the output, None where the variant failed (`failure` says why). `figures` by metric. `alone` and `spent`
    in seconds. `shared` counts the nodes that another variant had computed already, out of `nodes`.
    """

    variant: Variant
    case: int
    value: Any = field(repr=False)
    figures: Mapping[str, float]
    alone: float
    spent: float
    nodes: int
    shared: int
    slowest: tuple[str, float]
    swapped: float
    """Seconds of the nodes whose operator or parameters are not the same in every variant."""
    warnings: tuple[str, ...] = ()
    failure: str = ""


class Watcher:
    """Sees the values of a variant while they are in memory: base of those who draw them; does nothing."""

    def case_started(self, case: int, requests: Sequence[Request]) -> None:
        """All variants of a case are about to be run."""

    def variant_finished(self, cell: Cell, asked: Request, records: Sequence[Record]) -> None:
        """One of them was run, or failed."""


@dataclass(frozen=True)
class Ablation:
    """Every cell, by case and within it by variant; `truths` are the true outputs by case, None where not given."""

    graph: Graph
    output: str
    variants: list[Variant]
    cases: list[Mapping[str, Any]]
    cells: list[Cell] = field(repr=False)
    truths: list[Any] = field(repr=False)
    metrics: Sequence[Metric] = ()

    def of_case(self, case: int) -> list[Cell]:
        return [cell for cell in self.cells if cell.case == case]

    def of_variant(self, variant: Variant) -> list[Cell]:
        return [cell for cell in self.cells if cell.variant == variant]

    @property
    def sharing(self) -> str:
        """What was shared and what that saved, in a sentence."""
        nodes, shared = sum(c.nodes for c in self.cells), sum(c.shared for c in self.cells)
        alone, spent = sum(c.alone for c in self.cells), sum(c.spent for c in self.cells)
        saved = max(alone - spent, 0)
        share = saved / max(alone, 1e-9)
        return (
            f"{shared} of {nodes} node results were shared between variants; {spent:.2f} s of work instead of "
            f"{alone:.2f} s, {saved:.2f} s ({share:.0%}) saved"
        )


def ablate(
    source: str | Path,
    swaps: Sequence[str],
    cases: Sequence[Mapping[str, Any]],
    *,
    output: str | None = None,
    truths: Sequence[Any] = (),
    metrics: Sequence[Metric] = (),
    one_at_a_time: bool = False,
    evaluator: Evaluator | None = None,
    loading: Mapping[str, Any] | None = None,
    said: Callable[[str], None] = lambda _: None,
    watcher: Watcher | None = None,
) -> Ablation:
    """Run every variant of a graph on every case.

    Args:
        swaps: as on the command line, "intrinsic=intensity,retinex".
        cases: graph inputs by name, one mapping for each case.
        output: which output, or "node.port"; the first declared one by default.
        truths: the true output of each case, or none at all. metrics: what to measure against it.
        evaluator: where to run; by default a new one with a memory tier, one thread (node times are then undisturbed).
        loading: further arguments of `graphface.load`, for every variant.
        said: told the name of each variant as it starts.
        watcher: sees the values of each variant when it is done.

    Raises:
        UsageError: a swap that the graph cannot take. InputError: an input that does not fit.
    """
    given = dict(loading or {})
    base = load(source, **given)
    chosen = variants(read_swaps(swaps, base), one_at_a_time=one_at_a_time)
    name = output or next(iter(base.outputs), None)
    if name is None:
        raise UsageError(f"{base.name} declares no output; name one")
    evaluator = evaluator if evaluator is not None else Evaluator(memory=MemoryTier())
    graphs = [_loaded(source, variant, given) for variant in chosen]
    swapped = differing(graphs)
    known: dict[bytes, float] = {}
    kept = list(truths) if truths else [None] * len(cases)
    cells = []
    watcher = watcher if watcher is not None else Watcher()
    for index, case in enumerate(cases):
        requests = [request(graph, case, [name]) for graph in graphs]
        watcher.case_started(index, requests)
        for variant, asked in zip(chosen, requests, strict=True):
            said(variant.name)
            value, failure, records = _evaluated(evaluator, asked, name)
            figures = measured(metrics, value, kept[index]) if value is not None and kept[index] is not None else {}
            cell = _cell(asked, variant, index, value, failure, figures, records, known, swapped)
            watcher.variant_finished(cell, asked, records)
            cells.append(cell)
    return Ablation(base, name, chosen, list(cases), cells, kept, metrics)


def differing(graphs: Sequence[Graph]) -> frozenset[str]:
    """The nodes that are not the same operator with the same parameters in all of these graphs."""
    seen: dict[str, set[str]] = {}
    for graph in graphs:
        for step in graph.steps:
            seen.setdefault(step.name, set()).add(f"{step.operator.name} {sorted(step.parameters.items())}")
    return frozenset(name for name, forms in seen.items() if len(forms) > 1)


def _loaded(source: str | Path, variant: Variant, given: Mapping[str, Any]) -> Graph:
    both = dict(given)
    both["replace"] = {**given.get("replace", {}), **variant.replace}
    both["set"] = {**given.get("set", {}), **variant.set}
    both["variants"] = [*given.get("variants", ()), *variant.variants]
    both["profiles"] = [*given.get("profiles", ()), *variant.profiles]
    return load(source, **both)


def _cell(
    asked: Request,
    variant: Variant,
    case: int,
    value: Any,
    failure: str,
    figures: Mapping[str, float],
    records: Sequence[Record],
    known: dict[bytes, float],
    swapped: frozenset[str],
) -> Cell:
    """The accounts of one variant; `known` are the seconds of every key that has run so far, and gets those of now."""
    ran = {r.key: r.seconds for r in records if r.state == "ran"}
    known.update(ran)
    needed = {asked.key(step.slot): step for step in asked.steps() if asked.key(step.slot) in known}
    slowest = max(needed, key=lambda key: known[key], default=b"")
    return Cell(
        variant=variant,
        case=case,
        value=value,
        figures=figures,
        alone=sum(known[key] for key in needed),
        spent=sum(seconds for key, seconds in ran.items() if key in needed),
        nodes=len(needed),
        shared=sum(key not in ran for key in needed),
        slowest=(needed[slowest].name, known[slowest]) if needed else ("", 0.0),
        swapped=sum(known[key] for key, step in needed.items() if step.name in swapped),
        warnings=tuple(f"{r.name}: {w}" for r in records for w in r.warnings),
        failure=failure,
    )


def _evaluated(evaluator: Evaluator, asked: Request, output: str) -> tuple[Any, str, list[Record]]:
    """The output, why there is none, and what became of every node."""
    try:
        result = evaluator.run(asked)
    except RunFailed as error:
        return None, "; ".join(f"{failure.node}: {failure.reason}" for failure in error.failures), error.records
    return result[output], "", result.records
