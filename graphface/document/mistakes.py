"""What keeps a YAML tree from being a pydantic model: every mistake, with its place and the names that may be meant.

Pydantic names a wrong value by the keys that lead to it, and the tree knows where each of them stands. Two kinds of
mistakes pydantic finds only once others are gone: it looks into a member of a union when its `type` is right, and asks
a model's own rules ("either a color or kelvin") when all its fields are. So in a copy of the tree what is wrong is
replaced by something right (a misspelt `type` by the nearest, a number out of range by the bound, any other value by
the default; an unknown key is left out), and the copy is checked again, until nothing new is found.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel, ValidationError

from graphface.document.located import plain
from graphface.document.typed_value import Keys, TypedValue, choices_of, fields, holds_models
from graphface.errors import Problem, nearest_names
from graphface.place import Place

_KINDS = {
    **dict.fromkeys(("float_type", "float_parsing"), "a number"),
    **dict.fromkeys(("int_type", "int_parsing", "int_from_float"), "a whole number"),
    **dict.fromkeys(("bool_type", "bool_parsing"), "true or false"),
    "string_type": "a text",
    **dict.fromkeys(("list_type", "tuple_type", "set_type", "frozen_set_type"), "a list"),
    **dict.fromkeys(("dict_type", "mapping_type", "model_type", "model_attributes_type"), "a mapping"),
}
"""Pydantic's errors about the kind of a value, and what a user of YAML calls that kind."""

_MOST = 100
"""Mistakes after which no more are looked for: whoever has so many does not read them."""

_SHOWN = 60
"""Characters of a wrong value that a message shows."""


def mistakes(tree: Any, model: type[BaseModel], place: Place | None = None) -> list[Problem]:
    """Every mistake in a tree that is to be a `model`, in the order of the text; none where it is valid.

    Args:
        tree: as `parse` returns it; or plain data, whose problems have no place.
        place: of the tree, where it is neither a mapping nor a list.
    """
    top = TypedValue(tree, place or getattr(tree, "place", None), (model,))
    copied = _copied(tree)
    found: dict[tuple[Keys, str], _Mistake] = {}
    while len(found) < _MOST:
        try:
            model.model_validate(copied)
            break
        except ValidationError as error:
            read = _read(error, top)
        new = {identity: mistake for identity, mistake in read.items() if identity not in found}
        if not new:
            break
        found |= new
        for mistake in new.values():
            mistake.put_right(copied)
    return [mistake.problem for mistake in sorted(found.values(), key=_in_text)]


def reason(detail: Mapping[str, Any]) -> str:
    """An error of pydantic's as the second half of a sentence: what was expected, and what was found."""
    if detail["type"] == "value_error" and isinstance(detail["input"], Mapping):
        return _expected(detail)  # a rule between fields: repeating them all says nothing
    return f"{_expected(detail)}, got {_shown(detail['input'])}"


def choices(detail: Mapping[str, Any]) -> list[str]:
    """The words of which an error of pydantic's says that one was expected: "'hard', 'soft' or 'none'"."""
    return re.findall(r"'([^']*)'", detail.get("ctx", {}).get("expected", ""))


@dataclass(frozen=True)
class _Mistake:
    """One mistake, and what puts the copy right: another value for `wrong`, or leaving it out where that is None."""

    problem: Problem
    wrong: Keys = ()
    right: Any = None

    def put_right(self, data: Any) -> None:
        if self.wrong:
            *way, last = self.wrong
            for key in way:
                data = data[key]
            if self.right is None:
                del data[last]
            else:
                data[last] = self.right


@dataclass(frozen=True)
class _Error:
    """One of pydantic's errors and where it leads.

    Attributes:
        at: the wrong value; where a value is missing, what should hold it. holder: what holds the wrong value.
    """

    detail: Mapping[str, Any]
    at: TypedValue
    holder: TypedValue

    @property
    def kind(self) -> str:
        return str(self.detail["type"])

    @property
    def identity(self) -> tuple[Keys, str]:
        """Equal for errors that are one mistake."""
        if self.kind == "missing" and isinstance(self.at.value, Mapping):
            return (*self.at.keys, self.detail["loc"][-1]), self.kind
        return self.at.keys, "kind" if self.kind in _KINDS else self.kind

    @property
    def fit(self) -> tuple[int, bool]:
        """Higher where more of a value is as a member of a union wants it: its outside, its kind."""
        return len(self.at.keys) + (self.kind == "missing"), self.kind not in _KINDS


def _read(error: ValidationError, top: TypedValue) -> dict[tuple[Keys, str], _Mistake]:
    """Pydantic's errors as mistakes; of a union those of the members that come nearest to what is written."""
    errors = [_led_to(detail, top) for detail in error.errors(include_url=False)[:_MOST]]
    fits: dict[tuple[Keys, str], tuple[int, bool]] = {}
    for found in errors:
        for member in found.at.members:
            fits[member] = max(found.fit, fits.get(member, found.fit))
    best: dict[Keys, tuple[int, bool]] = {}
    for (keys, _), fit in fits.items():
        best[keys] = max(fit, best.get(keys, fit))
    kept = [e for e in errors if all(fits[member] == best[member[0]] for member in e.at.members)]
    kinds: dict[Keys, list[str]] = {}
    for found in kept:
        if found.kind in _KINDS and _KINDS[found.kind] not in kinds.setdefault(found.at.keys, []):
            kinds[found.at.keys].append(_KINDS[found.kind])
    return {e.identity: _mistake(e, kinds.get(e.at.keys, [])) for e in kept}


def _led_to(detail: Any, top: TypedValue) -> _Error:
    """Follow pydantic's path: keys, and the names that it gives to members of unions."""
    at = holder = top
    for key in detail["loc"][:-1] if detail["type"] == "missing" else detail["loc"]:
        if at.holds(key):
            holder, at = at, at.inside(key)
        else:
            at = at.as_member(str(key))
    return _Error(detail, at, holder)


def _mistake(error: _Error, kinds: Sequence[str]) -> _Mistake:
    detail, at, holder = error.detail, error.at, error.holder
    if error.kind == "extra_forbidden":
        key = str(at.keys[-1])
        message = f"{holder} has no entry {key!r} (it has {', '.join(holder.names)})"
        nearest = nearest_names(key, holder.names, 1)
        return _Mistake(Problem(message, holder.key_place(key), tuple(nearest)), at.keys)
    if error.kind in ("union_tag_invalid", "union_tag_not_found"):
        return _wrong_tag(detail, at)
    if error.kind == "missing":
        missing = detail["loc"][-1]
        if isinstance(missing, int):
            return _Mistake(Problem(f"{at}: {missing + 1} values are needed, got {_shown(at.value)}", at.place))
        return _Mistake(Problem(f"{at}: {missing!r} is required", at.place))
    if kinds:
        what = f" with {', '.join(at.names)}" if kinds == ["a mapping"] and len(at.models) == 1 else ""
        expected = f"input should be {' or '.join(kinds)}{what}, got {_shown(detail['input'])}"
    else:
        expected = reason(detail)
    nearest = nearest_names(str(at.value), choices(detail), 1)
    return _Mistake(Problem(f"{at}: {expected}", at.place, tuple(nearest)), *_right_value(error))


def _wrong_tag(detail: Mapping[str, Any], at: TypedValue) -> _Mistake:
    """A union's member that is misspelt or not said; the likely one is then read as if it were said."""
    key = detail["ctx"]["discriminator"].strip("'")
    members = {str(tag): model for model in at.models for tag in choices_of(model, key)}
    known = ", ".join(members)
    if key in at.value:
        tag, place = at.value[key], at.inside(key).place
        nearest = nearest_names(str(tag), members, 1)
        problem = Problem(f"{at}: unknown {key} {tag!r} (it is one of {known})", place, tuple(nearest))
    else:
        for misspelt in nearest_names(key, (k for k in at.value if isinstance(k, str) and k not in at.names), 1):
            if str(at.value[misspelt]) in members:
                problem = Problem(f"{at} has no entry {misspelt!r}", at.key_place(misspelt), (key,))
                right = {key if k == misspelt else k: v for k, v in _copied(at.value).items()}
                return _Mistake(problem, at.keys, right)
        nearest = _likely(members, at.value)
        problem = Problem(f"{at} has no {key!r} (it is one of {known})", at.place, tuple(nearest))
    return _Mistake(problem, (*at.keys, key), nearest[0]) if nearest else _Mistake(problem)


def _likely(members: Mapping[str, type[BaseModel]], value: Mapping[str, Any]) -> list[str]:
    """The members of a union that have most of the keys written; none where those are many, or have none of them."""
    counts = {tag: len(fields(model).keys() & value.keys()) for tag, model in members.items()}
    likely = [tag for tag, count in counts.items() if count == max(counts.values()) > 0]
    return likely if len(likely) <= 3 else []


def _right_value(error: _Error) -> tuple[Keys, Any]:
    """A value that is right in place of a wrong one, and where to put it; no keys where none is known."""
    context = error.detail.get("ctx", {})
    for right in (context.get("ge"), context.get("le"), *choices(error.detail)):
        if right is not None:
            return error.at.keys, right
    if error.at.field is None or holds_models(error.at.field[1].annotation):
        return (), None
    keys, field = error.at.field
    default = None if field.is_required() else field.get_default()
    return (keys, default) if default is not None else ((), None)


def _expected(detail: Mapping[str, Any]) -> str:
    if detail["type"] in _KINDS:
        return f"input should be {_KINDS[detail['type']]}"
    if detail["type"] == "too_long":
        return f"at most {detail['ctx']['max_length']} values fit"
    text = str(detail["msg"]).removeprefix("Value error, ")
    return f"{text[:1].lower()}{text[1:]}"


def _shown(value: Any) -> str:
    text = "nothing" if value is None else repr(plain(value))
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 3]}..."


def _copied(value: Any) -> Any:
    """A copy whose mappings and lists can be changed."""
    if isinstance(value, Mapping):
        return {key: _copied(item) for key, item in value.items()}
    return [_copied(item) for item in value] if isinstance(value, list | tuple) else value


def _in_text(mistake: _Mistake) -> tuple[int, int]:
    place = mistake.problem.place
    return (place.line, place.column) if place is not None else (0, 0)
