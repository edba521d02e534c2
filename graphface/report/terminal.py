"""What the command line shows: tables, a progress bar, warnings. Results go to standard output, all else to error."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from types import TracebackType
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table

from graphface.evaluate.observe import Observer
from graphface.evaluate.plan import Planned
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.node import Operator
from graphface.record import Record
from graphface.report.explain import Explained
from graphface.report.timings import Timings

_FATE_STYLES = {
    "run": "green",
    "memory": "cyan",
    "disk": "cyan",
    "maybe": "yellow",
    "pinned": "magenta",
    "skipped": "dim",
    "ran": "green",
}


class ProgressBar(Observer):
    """A bar that grows with time, naming the node that runs; silent where standard error is not a terminal, or where
    something else writes there.

    A node's share of the bar is what its operator took in earlier runs (`graphface.report.timings`), so that the time
    left means something when one node takes as long as all others.
    """

    def __init__(self, title: str = "", *, silent: bool = False) -> None:
        columns = (TextColumn("{task.description:32}"), BarColumn(), TimeElapsedColumn(), TimeRemainingColumn())
        self._progress = Progress(
            *columns, console=Console(stderr=True), transient=True, disable=silent or not sys.stderr.isatty()
        )
        self._title = title
        self._timings = Timings.load()
        self._task: TaskID | None = None

    def __enter__(self) -> ProgressBar:
        self._progress.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._progress.stop()

    def run_started(self, request: Request) -> None:
        if self._task is not None:
            self._progress.remove_task(self._task)
        total = sum(self._timings.expected(step.operator.name) for step in request.steps())
        self._task = self._progress.add_task(self._title, total=total)

    def node_started(self, name: str, step: Step | None) -> None:
        if self._task is not None:
            self._progress.update(self._task, description=f"{self._title} {name}".strip())

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if self._task is not None and step is not None:
            self._progress.advance(self._task, self._timings.expected(step.operator.name))

    def run_finished(self, records: Sequence[Record]) -> None:
        self._timings.learn(records)


def print_times(records: Sequence[Record], title: str = "") -> None:
    """Time by node, slowest first, with its share; over several runs the sum, and how often it ran."""
    spent: dict[tuple[str, str], list[float]] = {}
    for record in records:
        if record.state == "ran":
            spent.setdefault((record.name, record.operator), []).append(record.seconds)
    total = sum(sum(seconds) for seconds in spent.values()) or 1.0
    table = _table("node", "operator", ">ran", ">ms", ">share", title=title)
    for (name, operator), seconds in sorted(spent.items(), key=lambda entry: -sum(entry[1])):
        share = f"{sum(seconds) / total:.0%}"
        table.add_row(name, operator, str(len(seconds)), f"{sum(seconds) * 1e3:.1f}", share)
    table.add_row("sum", "", "", f"{total * 1e3:.1f}", "", style="bold")
    _console().print(table)


def print_plan(planned: Sequence[Planned]) -> None:
    table = _table("node", "operator", "fate", "key", "why")
    for entry in planned:
        style = _FATE_STYLES[entry.fate]
        table.add_row(entry.name, entry.operator, f"[{style}]{entry.fate}[/]", entry.key, escape(str(entry.reason)))
    _console().print(table)


def print_operators(operators: Sequence[Operator]) -> None:
    table = _table("operator", "takes", "gives", "")
    for operator in operators:
        takes = ", ".join(operator.inputs)
        table.add_row(operator.name, takes, escape(str(operator.output)), escape(operator.doc.partition("\n")[0]))
    _console().print(table)


def print_operator(operator: Operator, alternatives: Sequence[str]) -> None:
    console = _console()
    console.print(f"[bold]{operator.name}[/bold] -> {escape(str(operator.output))}")
    console.print(operator.doc, markup=False, highlight=False)
    ports = _table("port", "type", "")
    for port in operator.inputs.values():
        kind = "lazy" if port.lazy else "" if port.required else "optional"
        ports.add_row(port.name, escape(str(port.type)), kind)
    if operator.inputs:
        console.print(ports)
    if operator.outputs:
        fields = _table("output", "type")
        for name, declared in operator.outputs.items():
            fields.add_row(f".{name}", escape(str(declared)))
        console.print(fields)
    _print_parameters(console, operator)
    old = [*operator.formerly, *(f"{old} (now {present})" for old, present in operator.renamed.items())]
    if old:
        console.print(f"old names: {', '.join(old)}", highlight=False)
    if alternatives:
        console.print(f"may be replaced by: {', '.join(alternatives)}", highlight=False)


def print_explained(explained: Sequence[Explained]) -> None:
    table = _table("node", "operator", "fate", ">ms", ">MB", "key", "why")
    for entry in explained:
        style = _FATE_STYLES.get(entry.fate, "")
        fate = f"[{style}]{entry.fate}[/]" if style else entry.fate
        ms = f"{entry.milliseconds:.1f}" if entry.milliseconds is not None else ""
        size = f"{entry.bytes / 1e6:.2f}" if entry.bytes else ""
        table.add_row(entry.name, entry.operator, fate, ms, size, entry.key, escape(str(entry.reason)))
    _console().print(table)


def print_warnings(warnings: Sequence[str]) -> None:
    """Each warning once, in the order of its first mention."""
    console = Console(stderr=True)
    for warning in dict.fromkeys(warnings):
        console.print(f"warning: {warning}", style="yellow", markup=False, highlight=False, soft_wrap=True)


def print_table(headers: Sequence[str], rows: Sequence[Sequence[str]], title: str = "") -> None:
    """Any table of texts; a header beginning with ">" is right-aligned."""
    table = _table(*headers, title=title)
    for row in rows:
        table.add_row(*row)
    _console().print(table)


def _print_parameters(console: Console, operator: Operator) -> None:
    schema = operator.parameters.model_json_schema()
    properties = schema.get("properties", {})
    if not properties:
        return
    table = _table("parameter", "type", "default", "allowed")
    for name, described in properties.items():
        default = str(described.get("default", "required"))
        table.add_row(name, _schema_type(described), escape(default), escape(_allowed(described)))
    console.print(table)


def _schema_type(described: dict[str, Any]) -> str:
    if "anyOf" in described:
        return " | ".join(_schema_type(option) for option in described["anyOf"])
    return str(described.get("type", "one of" if "enum" in described else "any"))


def _allowed(described: dict[str, Any]) -> str:
    if "enum" in described:
        return ", ".join(str(v) for v in described["enum"])
    signs = {"minimum": ">=", "exclusiveMinimum": ">", "maximum": "<=", "exclusiveMaximum": "<"}
    limits = [f"{sign} {described[key]:g}" for key, sign in signs.items() if key in described]
    options = [_allowed(option) for option in described.get("anyOf", ())]
    return " or ".join(o for o in [", ".join(limits), *options] if o)


def _table(*headers: str, title: str = "") -> Table:
    """A plain table; a header beginning with ">" is right-aligned."""
    table = Table(box=None, pad_edge=False, title=title or None, title_justify="left", header_style="bold")
    for header in headers:
        right = header.startswith(">")
        table.add_column(header.lstrip(">"), justify="right" if right else "left", overflow="fold")
    return table


def _console() -> Console:
    """Standard output; not wrapped to 80 columns where it is a file."""
    return Console(width=None if sys.stdout.isatty() else 160)
