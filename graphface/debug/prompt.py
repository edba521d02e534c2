"""What can be asked while a run stands at a node: a prompt in the terminal, or commands read from a pipe."""

from __future__ import annotations

import cmd
import os
import shlex
import shutil
import sys
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, ClassVar

from graphface.debug.stepping import step_through
from graphface.debug.stop import Stop
from graphface.errors import GraphfaceError, UsageError, did_you_mean, nearest_names
from graphface.evaluate.calling import reason_of
from graphface.evaluate.observe import StopRun
from graphface.graph.demand import take
from graphface.graph.structure import Argument, Ref, field_type
from graphface.values.frozen import describe
from graphface.values.parts import Named, rule_of
from graphface.values.picture import View
from graphface.values.port_types import ArrayType, Atom, ListOf, PortType
from graphface.values.value_file import write_value
from graphface.values.writing import beside, check_folder, check_output, write_output

_SHORT = {"c": "continue", "n": "next", "q": "quit", "h": "help", "graph": "where", "EOF": "quit"}
_HINT = "\nhelp lists what can be asked, continue runs on"


def ask(stop: Stop) -> None:
    """Ask until the run is to go on.

    Raises:
        StopRun: it is to end, or to begin again with another value.
    """
    Prompt(stop).cmdloop()


class Prompt(cmd.Cmd):
    """The commands; each docstring is its help. Errors are a line, never a traceback."""

    _introduced: ClassVar[bool] = False

    def __init__(self, stop: Stop) -> None:
        super().__init__()
        self._stop = stop
        self._typed = sys.stdin.isatty()
        self.use_rawinput = self._typed
        self.prompt = f"({stop.name}) "
        self.intro = f"\n{self._headline()}{'' if Prompt._introduced else _HINT}"
        Prompt._introduced = True

    # --- how cmd.Cmd is used ----------------------------------------------------------------------

    def onecmd(self, line: str) -> bool:
        word, _, rest = line.strip().partition(" ")
        try:
            return bool(super().onecmd(f"{_SHORT.get(word, word)} {rest}".strip()))
        except Exception as error:  # StopRun and Ctrl-C are none
            self._say(f"error: {error if isinstance(error, GraphfaceError) else reason_of(error)}")
            return False

    def precmd(self, line: str) -> str:
        if not self._typed:
            self._say(line if line != "EOF" else "")
        return line

    def emptyline(self) -> bool:
        return False

    def default(self, line: str) -> None:
        word = line.split()[0]
        raise UsageError(f"no command {word!r}{did_you_mean(nearest_names(word, self._commands()))}; help lists them")

    def do_help(self, arg: str) -> None:
        """help [COMMAND]: what there is, or what one command does."""
        name = _SHORT.get(arg.strip(), arg.strip())
        for command in [name] if name else self._commands():
            method = getattr(self, f"do_{command}", None)
            if method is None:
                raise UsageError(f"no command {arg!r}{did_you_mean(nearest_names(arg, self._commands()))}")
            usage, _, does = (method.__doc__ or "").partition(": ")
            width = max(60, shutil.get_terminal_size().columns)
            self._say(textwrap.fill(f"  {usage:22} {' '.join(does.split())}", width, subsequent_indent=" " * 25))

    def completedefault(self, text: str, *_: Any) -> list[str]:
        return [name for name in self._names() if name.startswith(text)]

    # --- looking ----------------------------------------------------------------------------------

    def do_inputs(self, arg: str) -> None:
        """inputs: the values of its ports, and where each comes from."""
        for argument in self._stop.step.arguments:
            value = (self._stop.arguments or {}).get(argument.port)
            if self._stop.arguments is None:
                self._say(f"  {argument.port} <- {self._wire(argument)}")
            else:
                self._show_lines(f"{argument.port} <- {self._wire(argument)}", value)
        if self._stop.arguments is None:
            self._say("its value was memoized, so its inputs are not at hand")
        elif not self._stop.step.arguments:
            self._say("  it has none")

    def do_value(self, arg: str) -> None:
        """value: what the node gave (after it)."""
        self._show_lines(self._stop.name, self._named("value")[0])

    def do_params(self, arg: str) -> None:
        """params: its parameters; who set those that are not the operator's own."""
        step = self._stop.step
        for name, value in step.parameters.items():
            setting = step.settings.get(name)
            place = setting.place if setting is not None else None
            self._say(f"  {name:20} {value!r}{f'   {place}' if place is not None else ''}")
        if not step.parameters:
            self._say("  it has none")

    def do_where(self, arg: str) -> None:
        """where: the place of the node in its file, its wires, and who uses it."""
        step, graph = self._stop.step, self._stop.request.graph
        self._say(self._headline())
        if step.place.excerpt:
            self._say(step.place.excerpt)
        for argument in step.arguments:
            self._say(f"  {argument.port} <- {self._wire(argument)}")
        users = [(s.name, a.port) for s in graph.steps for a in s.arguments if any(r.slot == step.slot for r in a.refs)]
        for name, port in users:
            self._say(f"  -> {name}.{port}")
        for name, ref in self._stop.request.targets.items():
            if ref.slot == step.slot:
                self._say(f"  -> output {name}")

    def do_show(self, arg: str) -> None:
        """show NAME [FILE]: draw a port, a field of one (PORT.FIELD) or value: into FILE, or on the screen."""
        from PIL import Image

        from graphface.pictures import draw

        words = self._words("show", arg, 1, 2)
        value, declared = self._named(words[0])
        path = Path(words[1]) if len(words) > 1 else _temporary(self._stop.name, words[0])
        check_folder(path)
        if path.suffix.lower() not in Image.registered_extensions():
            raise UsageError(f"{path}: a picture's name ends in .png or .jpg")
        picture = draw(value, declared, self._stop.request.graph.registry, View(above=self._above))
        with beside(path) as unfinished:
            Image.fromarray(picture.pixels).save(unfinished)
        self._say(f"{path}{f': {picture.note}' if picture.note else ''}")
        if self._typed and len(words) == 1 and _has_screen():
            import typer

            typer.launch(str(path))

    def do_save(self, arg: str) -> None:
        """save NAME FILE: write a port, a field of one or value: all of it to .npz, which replace reads; else as -o
        would."""
        name, file = self._words("save", arg, 2, 2)
        value, declared = self._named(name)
        files = self._stop.request.graph.registry.files
        check_output(Path(file), declared, files)
        if Path(file).suffix == ".npz":
            write_value(value, Path(file))
        else:
            write_output(value, declared, Path(file), files)
        self._say(f"wrote {file}")

    # --- going on ---------------------------------------------------------------------------------

    def do_replace(self, arg: str) -> None:
        """replace [NAME] FILE: go on with the value in FILE instead: of this node, of what is plugged into the port
        NAME, or of any node NAME."""
        words = self._words("replace", arg, 1, 2)
        try:
            self._stop.replace(words[-1], words[0] if len(words) > 1 else "")
        except StopRun as again:
            self._say(f"{again} by {words[-1]}; what depends on it runs again")
            raise

    def do_pdb(self, arg: str) -> None:
        """pdb: step through the operator's function, called with these arguments."""
        if self._stop.arguments is None:
            raise UsageError("its value was memoized, so its arguments are not at hand")
        operator = self._stop.step.operator
        step_through(operator.function, {**self._stop.arguments, **self._stop.step.parameters})

    def do_next(self, arg: str) -> bool:
        """next: stop again before the next node that runs."""
        self._stop.steps = True
        return True

    def do_continue(self, arg: str) -> bool:
        """continue: run on, to the next stop or the end."""
        return True

    def do_quit(self, arg: str) -> None:
        """quit: end the run; no output is written."""
        self._stop.quit()

    # --- names ------------------------------------------------------------------------------------

    def _named(self, name: str) -> tuple[Any, PortType]:
        """A value by "value", "PORT" or "PORT.FIELD", with its declared type."""
        head, *fields = name.split(".")
        operator, arguments = self._stop.step.operator, self._stop.arguments or {}
        if head == "value":
            if self._stop.error:
                raise UsageError(f"it has no value: {self._stop.error}")
            if self._stop.at == "before":
                raise UsageError(f"it has no value yet; --break {self._stop.name}:after stops when it has")
            value, declared = self._stop.value, operator.output
        elif head in arguments:
            value, declared = arguments[head], operator.inputs[head].type
        else:
            raise UsageError(f"nothing here is called {head!r} (there is {', '.join(self._names())})")
        found = field_type(declared, tuple(fields))
        if found is None:
            raise UsageError(f"{head!r} ({declared}) has no field {'.'.join(fields)!r}")
        return take(value, fields), found

    def _names(self) -> list[str]:
        return [*(self._stop.arguments or {}), *(["value"] if self._stop.at == "after" else [])]

    def _commands(self) -> list[str]:
        order = ("inputs", "value", "params", "where", "show", "save", "replace", "pdb", "next", "continue", "quit")
        return [*order, "help"]

    def _above(self, kind: Atom) -> Any:
        """The first argument of a type: what a drawing of the value may stand on."""
        if isinstance(kind, ListOf):
            return None
        for value in (self._stop.arguments or {}).values():
            if kind.problem(value) is None if isinstance(kind, ArrayType) else isinstance(value, kind):
                return value
        return None

    # --- words ------------------------------------------------------------------------------------

    def _headline(self) -> str:
        step = self._stop.step
        failed = f"\nit failed: {self._stop.error}" if self._stop.error else ""
        return f"{self._stop.at} {step.name} ({step.operator.name}), {step.place}{failed}"

    def _wire(self, argument: Argument) -> str:
        return ", ".join(self._ref(ref) for ref in argument.refs)

    def _ref(self, ref: Ref) -> str:
        pinned = " (pinned)" if ref.slot in self._stop.request.pinned else ""
        return ".".join((self._stop.request.graph.names[ref.slot], *ref.fields)) + pinned

    def _show_lines(self, label: str, value: Any) -> None:
        """A value in a line; the parts of a record in lines of their own."""
        rule = rule_of(type(value))
        if not isinstance(rule, Named):
            self._say(f"  {label}: {describe(value)}")
            return
        self._say(f"  {label}: {type(value).__name__}")
        for name, part in rule.items(value):
            self._say(f"      .{name} {describe(part)}")

    def _words(self, command: str, arg: str, least: int, most: int) -> Sequence[str]:
        words = list(_split(arg))
        if not least <= len(words) <= most:
            raise UsageError(f"say it as: {(getattr(self, f'do_{command}').__doc__ or '').partition(':')[0]}")
        return words

    def _say(self, text: str) -> None:
        print(text, file=self.stdout, flush=True)


def _split(text: str) -> Iterator[str]:
    """Words as a shell has them.

    Raises:
        UsageError: a quote has no end.
    """
    try:
        yield from shlex.split(text)
    except ValueError as error:
        raise UsageError(str(error).lower()) from None


def _has_screen() -> bool:
    return sys.platform != "linux" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _temporary(node: str, name: str) -> Path:
    import tempfile

    return Path(tempfile.mkdtemp(prefix="graphface-")) / f"{node.replace('/', '-')}.{name}.png"
