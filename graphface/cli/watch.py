"""`graphface run --watch`: run again whenever something that the result is made of is edited.

Graph files, inputs and plug-ins are read again in this process, and one memory tier keeps all that an edit does not
reach. When a module of an installed pack changes, the process replaces itself by a fresh one (`os.execv`): reloading
modules in place would leave old classes and functions in those that imported them, and nobody could say which code a
result came from. A child process for every run was rejected, since each would load all libraries and values again. The
fresh process finds the values in a folder that the old one leaves behind, and deletes it.
"""

from __future__ import annotations

import ast
import linecache
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from graphface.cli.changes import ChangingFiles
from graphface.cli.messages import message
from graphface.cli.succession import Succession

if TYPE_CHECKING:
    from graphface.evaluate.evaluator import Evaluator
    from graphface.evaluate.observe import Observer
    from graphface.facade import Graph
    from graphface.graph.request import Request
    from graphface.graph.wired import WiredGraph
    from graphface.node import Operator
    from graphface.record import Record

Once = Callable[["Graph", Sequence["Observer"]], list["Record"]]


def watch_run(
    load: Callable[[], Graph],
    once: Callable[..., list[Record]],
    evaluator: Evaluator,
    named: Iterable[Path],
    plugins: Sequence[Path],
    cache: Path | None,
    times: bool,
) -> None:
    """Run and watch until Ctrl-C; see `Watch`. `once` is `run_once` with what the command line asks for."""
    from graphface.report.terminal import print_times, print_warnings

    def run(graph: Graph, observers: Sequence[Observer]) -> list[Record]:
        records = once(graph, evaluator=evaluator, observers=observers)
        print_warnings([f"{r.name}: {w}" for r in records for w in r.warnings])
        if times:
            print_times(records)
        return records

    Watch(load, run, evaluator, named=named, plugins=plugins, cache=cache).run()


class Watch:
    """One session.

    Args:
        load: reads the graph again. once: runs it and writes its outputs.
        named: what may be files on the command line: the graph, the inputs. plugins: those of `--plugin`.
        cache: the user's cache folder, where the run's history is kept too.
    """

    def __init__(
        self,
        load: Callable[[], Graph],
        once: Once,
        evaluator: Evaluator,
        *,
        named: Iterable[Path],
        plugins: Sequence[Path],
        cache: Path | None,
    ) -> None:
        from graphface.report.history import History

        self._load, self._once, self._evaluator, self._cache = load, once, evaluator, cache
        self._plugins = [path.resolve() for path in plugins]
        self._files = ChangingFiles()
        self._files.watch([*named, *plugins], time.time_ns())
        self._modules: set[Path] = set()
        self._history = History()
        self._succession = Succession(evaluator)
        self._last: Request | None = None

    def run(self) -> None:
        """Run, and again after every change, until Ctrl-C."""
        try:
            self._modules |= self._succession.files
            self._files.watch(self._succession.files, time.time_ns())
            while True:
                self._again()
                while not self._usable(changed := self._files.wait()):
                    pass
                if any(self._needs_fresh_process(path) for path in changed):
                    self._say(f"{', '.join(sorted(p.name for p in changed))} changed: starting afresh")
                    self._succession.hand_over(self._last, self._history, self._modules)
        except KeyboardInterrupt:
            self._say("no longer watching")
        finally:
            self._succession.end()

    def _again(self) -> None:
        """One run. What is wrong is told, and the next change waited for."""
        from graphface.errors import GraphfaceError
        from graphface.report.history import History, Remember
        from graphface.report.rerun import Rerun

        since = time.time_ns()
        linecache.checkcache()
        history = History.beside(self._cache) if self._cache is not None else self._history
        rerun = Rerun(self._evaluator, history)
        observers: list[Observer] = [self._succession.heir(history), rerun]
        if self._cache is None:
            observers.append(Remember(history, None))
        try:
            graph = self._load()
            self._files.watch(graph.composition.files, since)
            self._once(graph, observers)
        except GraphfaceError as error:
            self._watch_places(error, since)
            print(f"error: {message(error)}", file=sys.stderr)
        if rerun.request is not None:
            self._last = rerun.request
            self._watch_request(rerun.request, since)
            self._say(rerun.line)

    def _watch_request(self, request: Request, since: int) -> None:
        """Watch the files of the inputs, and the code of the operators and of what reads the inputs."""
        given = [one for one in (*request.bound, *request.pinned.values()) if one is not None]
        self._files.watch((Path(one.origin) for one in given if one.is_file), since)
        self._modules |= code_files(request.graph) - set(self._plugins)
        self._files.watch(self._modules, since)

    def _watch_places(self, error: Exception, since: int) -> None:
        """Watch the files that an error speaks of: the graph that could not be read may use new ones."""
        places = (problem.place for problem in getattr(error, "problems", ()))
        self._files.watch((p.source.path for p in places if p is not None and p.source.path is not None), since)

    def _needs_fresh_process(self, path: Path) -> bool:
        """Whether a changed file is code that cannot be read again: of a pack, or one whose classes values have."""
        path = path.resolve()
        if path not in self._plugins:
            return path in self._modules
        module = sys.modules.get(f"graphface_plugin_{path.stem}")
        held = vars(module).values() if module is not None else ()
        return any(isinstance(value, type) and value.__module__ == module.__name__ for value in held if module)

    def _usable(self, changed: Sequence[Path]) -> bool:
        """Whether changed Python files can be parsed; what is wrong with one is told."""
        for path in changed:
            try:
                if path.suffix == ".py":
                    ast.parse(path.read_bytes(), str(path))
            except (SyntaxError, ValueError) as error:
                line, column = getattr(error, "lineno", None) or 1, getattr(error, "offset", None) or 1
                print(f"error: {path}:{line}:{column}: {getattr(error, 'msg', error)}", file=sys.stderr)
                return False
            except OSError as error:
                print(f"error: {path}: {error.strerror}", file=sys.stderr)
                return False
        return True

    def _say(self, text: str) -> None:
        print(f"{time.strftime('%H:%M:%S')} {text}", file=sys.stderr, flush=True)


def code_files(graph: WiredGraph) -> set[Path]:
    """The modules behind a graph that count by their content, with the data files that they name."""
    from graphface.fingerprint import fingerprint
    from graphface.fingerprint.loaded import Module

    operators: dict[Operator, None] = dict.fromkeys(step.operator for step in graph.steps)
    functions = [(operator.function, operator.needs) for operator in operators]
    files = (graph.registry.files(entry.type) for entry in graph.inputs.values())
    functions += [(getattr(f.read, "__func__", f.read), None) for f in files if f is not None and f.read is not None]
    names = {name for pair in functions for name in fingerprint(*pair).reached}
    modules = [module for name in names if " " not in name and (module := Module.of(name)) is not None]
    return {path.resolve() for module in modules for path in (module.source.path, *module.source.files)}
