"""`@node`: a plain typed function becomes an operator.

The signature is the declaration, so nothing is written twice. Positional arguments are input ports, keyword-only
arguments are parameters that pydantic validates, the return annotation is the output. The decorator hands the function
back untouched: a notebook or a test calls it without the engine.

    @node("intrinsic.intensity")
    def intensity(photo: Image, *, floor: Annotated[float, Field(gt=0, le=0.1)] = 1 / 255) -> Intrinsic: ...

Annotations are resolved and the parameter model is built when an operator is first used, not when its module is
imported: listing names must not pay for pydantic.
"""

from __future__ import annotations

import inspect
import typing
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from graphface.declaration import Signature, parameter_model, read_signature
from graphface.values.port_types import PortType, is_lazy, output_fields, port_type

if TYPE_CHECKING:
    from pydantic import BaseModel

F = TypeVar("F", bound=Callable[..., Any])

Needs = Mapping[str, bool | str]
"""A `needs` rule's answer: for each lazy port, True where it is wanted, or the reason why not."""


class Cosmetic:
    """Put into a parameter's `Annotated` where it cannot change the result (a label, a thread count): no key has it."""


class Formerly:
    """Put into the `Annotated` of a port or parameter that was renamed: its old names go on working, with a warning.

    @node("makeup.beard", formerly=("makeup.shaved",))
    def beard(photo: Image, *, softness: Annotated[float, Field(gt=0), Formerly("doubt")] = 0.1) -> Mask: ...
    """

    def __init__(self, *names: str) -> None:
        self.names = names


@dataclass(frozen=True)
class Figure:
    """Put into the `Annotated` of an operator's output where the number is a figure of merit.

    @node("metrics.psnr")
    def psnr(result: Image, truth: Image) -> Annotated[float, Figure(better="higher", unit="dB")]: ...

    Args:
        better: which of two figures is the better one.
        unit: what stands behind it: "dB", "°".
    """

    better: Literal["higher", "lower"]
    unit: str = ""


def node(
    name: str, *, version: int = 1, needs: Callable[..., Needs] | None = None, formerly: tuple[str, ...] = ()
) -> Callable[[F], F]:
    """Declare a function as the operator `name` ("family.method").

    Args:
        name: dotted name; operators with the same prefix and agreeing ports are interchangeable.
        version: raise it to invalidate memoized results where the change is not in the code (a data file, say).
        needs: for functions with `Lazy` ports. Called with those of the eager inputs and parameters that it names;
            returns for each lazy port True, or a sentence saying why it is not wanted.
        formerly: names that the operator had before. Graph files that use them still work, with a warning. One of
            another family must stand in the pack's `formerly` too, so that it is found without importing every family.
    """

    def declare(function: F) -> F:
        operator = Operator(name, function, version, needs, tuple(formerly))
        function.__graphface_operator__ = operator  # type: ignore[attr-defined]
        return function

    return declare


@dataclass(frozen=True)
class InputPort:
    name: str
    type: PortType
    required: bool
    lazy: bool


@dataclass(frozen=True, eq=False)
class Operator:
    """A declared function and what its signature says; see `node`."""

    name: str
    function: Callable[..., Any]
    version: int = 1
    needs: Callable[..., Needs] | None = None
    formerly: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"Operator({self.name!r})"

    @property
    def doc(self) -> str:
        return inspect.getdoc(self.function) or ""

    @property
    def family(self) -> str:
        return self.name.rpartition(".")[0]

    @cached_property
    def inputs(self) -> dict[str, InputPort]:
        """The input ports, in the order of the signature."""
        ports = {}
        for argument in self._signature.parameters.values():
            if argument.kind is not argument.POSITIONAL_OR_KEYWORD:
                continue
            annotation = self._hints[argument.name]
            declared, lazy = port_type(annotation), is_lazy(annotation)
            required = argument.default is argument.empty and not declared.optional
            ports[argument.name] = InputPort(argument.name, declared, required, lazy)
        return ports

    @cached_property
    def needs_none(self) -> tuple[str, ...]:
        """The optional ports without a default in the signature: given None where nothing is plugged in."""
        arguments = self._signature.parameters
        optional = (name for name, port in self.inputs.items() if not port.required)
        return tuple(name for name in optional if arguments[name].default is inspect.Parameter.empty)

    @cached_property
    def output(self) -> PortType:
        return port_type(self._hints["return"])

    @cached_property
    def outputs(self) -> dict[str, PortType]:
        """The fields of a dataclass output: the ports reached as `node.field`."""
        return output_fields(self._hints["return"])

    @cached_property
    def plain_outputs(self) -> frozenset[type]:
        """The classes whose instances are certainly of the output's type; others are checked in full."""
        return frozenset(a for a in self.output.alternatives if isinstance(a, type) and a is not object)

    @property
    def output_annotation(self) -> Any:
        return self._hints["return"]

    @property
    def figure(self) -> Figure | None:
        """What the output is as a figure of merit; None where it is none, or does not say."""
        return next((m for m in getattr(self.output_annotation, "__metadata__", ()) if isinstance(m, Figure)), None)

    def annotation(self, name: str) -> Any:
        """The annotation of a port or parameter."""
        return self._hints[name]

    @cached_property
    def parameters(self) -> type[BaseModel]:
        """The pydantic model of the keyword-only arguments; unknown names are refused."""
        fields: dict[str, Any] = {}
        for argument in self._signature.parameters.values():
            if argument.kind is argument.KEYWORD_ONLY:
                default = ... if argument.default is argument.empty else argument.default
                fields[argument.name] = (self._hints[argument.name], default)
        return parameter_model(self.name, self.function, fields)

    @cached_property
    def cosmetic(self) -> frozenset[str]:
        """The parameters that no key has."""
        marked = (name for name, hint in self._hints.items() if Cosmetic in getattr(hint, "__metadata__", ()))
        return frozenset(marked)

    @cached_property
    def renamed(self) -> dict[str, str]:
        """Old names of ports and parameters, each with the present one."""
        arguments = {name: self._hints[name] for name in self._signature.parameters}
        return {old: name for name, hint in arguments.items() for old in _former_names(hint) if old not in arguments}

    @cached_property
    def rule_arguments(self) -> tuple[str, ...]:
        """The inputs and parameters that the `needs` rule asks to see."""
        return () if self.needs is None else tuple(inspect.signature(self.needs).parameters)

    def check(self) -> None:
        """Read the declaration, as everything else here does when it is first asked for.

        Raises:
            DeclarationError: the function cannot be an operator as it is.
        """
        _ = self._declaration, self.parameters

    @property
    def _signature(self) -> inspect.Signature:
        return self._declaration[0]

    @property
    def _hints(self) -> dict[str, Any]:
        return self._declaration[1]

    @cached_property
    def _declaration(self) -> Signature:
        return read_signature(self.name, self.function, self.needs)


def _former_names(annotation: Any) -> Iterator[str]:
    """The names in the `Formerly` of an annotation, also of one that stands inside another ("Lazy[Annotated[...]]")."""
    for mark in getattr(annotation, "__metadata__", ()):
        if isinstance(mark, Formerly):
            yield from mark.names
    for inner in typing.get_args(annotation):
        yield from _former_names(inner)


def operator_of(function: object) -> Operator | None:
    """The operator that `@node` declared on a function, if it did."""
    return getattr(function, "__graphface_operator__", None)
