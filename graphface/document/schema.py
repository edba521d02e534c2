"""JSON Schemas, so that editors complete and check while typing: of graph files, made from the registry, and of files
that are pydantic models.

    graphface schema -o graph.schema.json

In a graph file, above the first line:  # yaml-language-server: $schema=graph.schema.json
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from graphface.document.document import TAKEN
from graphface.errors import UnknownName
from graphface.node import Operator
from graphface.registry import Registry

if TYPE_CHECKING:
    from pydantic import BaseModel

_DRAFT = "https://json-schema.org/draft/2020-12/schema"
_NAME = "^[A-Za-z_][A-Za-z0-9_-]*(/[A-Za-z_][A-Za-z0-9_-]*)*$"
_GRAPH_FILE = r"\.ya?ml$"


class UnknownKind(UnknownName):
    kind = "kind of file"


def schema_of(kind: str, registry: Registry) -> dict[str, Any]:
    """The schema of a kind of file: "graph", or one that a pack describes.

    Raises:
        UnknownKind: with the nearest ones.
    """
    if kind == "graph":
        return graph_schema(registry)
    described = registry.schemas()
    if kind not in described:
        raise UnknownKind(kind, ["graph", *described])
    source = described[kind]
    schema: dict[str, Any] = model_schema(source) if hasattr(source, "model_fields") else source()
    return schema


def graph_schema(registry: Registry) -> dict[str, Any]:
    """The schema (draft 2020-12) of a graph file that uses the registry's operators and types."""
    node = _node_schema(registry.operators())
    return {
        "$schema": _DRAFT,
        "title": "graphface graph",
        "type": "object",
        "required": ["graphface"],
        "additionalProperties": False,
        "properties": {
            "graphface": {"const": 1, "description": "Version of the format."},
            "name": {"type": ["string", "null"]},
            "doc": {"type": ["string", "null"]},
            "extends": {"type": ["string", "null"], "pattern": _GRAPH_FILE, "description": "Graph file to start from."},
            "inputs": _named({"$ref": "#/$defs/input"}, taken=TAKEN),
            "nodes": _named({"$ref": "#/$defs/node"}),
            "outputs": _named({"$ref": "#/$defs/reference"}),
            "variants": _named(_named({"$ref": "#/$defs/node"})),
            "profiles": _named(_named({"type": "object", "description": "Parameters to set."})),
        },
        "$defs": {
            "reference": {"type": "string", "description": "A node or input, and fields of it: face.normals"},
            "type": {"type": "string", "examples": registry.type_names()},
            "input": {
                "anyOf": [
                    {"$ref": "#/$defs/type"},
                    {
                        "type": "object",
                        "required": ["type"],
                        "additionalProperties": False,
                        "properties": {"type": {"$ref": "#/$defs/type"}, "default": {}, "doc": {"type": "string"}},
                    },
                ]
            },
            "node": node,
        },
    }


def model_schema(model: type[BaseModel]) -> dict[str, Any]:
    """The schema (draft 2020-12) of a YAML file that is a pydantic model."""
    schema = model.model_json_schema(schema_generator=_lenient())
    return {"$schema": _DRAFT, **_tagged(schema, schema.get("$defs", {}))}


def _tagged(part: Any, definitions: dict[str, Any]) -> Any:
    """Unions with a discriminator as rules "if `type` is this, then ...".

    Pydantic writes `oneOf`, which holds for a member whose `type` is missing, and of which checkers mark the whole
    value instead of the mistake.
    """
    if isinstance(part, list):
        return [_tagged(item, definitions) for item in part]
    if not isinstance(part, dict):
        return part
    if "propertyName" not in part.get("discriminator", {}):
        return {key: _tagged(item, definitions) for key, item in part.items()}
    key, members = part["discriminator"]["propertyName"], part["discriminator"]["mapping"]
    docs = {tag: definitions[to.rpartition("/")[2]].get("description", "") for tag, to in members.items()}
    tags = [{"const": tag, "description": doc.partition("\n")[0]} for tag, doc in docs.items()]
    said = {"type": "object", "required": [key]}
    rules = [{"if": said | {"properties": {key: {"const": tag}}}, "then": {"$ref": to}} for tag, to in members.items()]
    found = {key: item for key, item in part.items() if key not in ("oneOf", "discriminator")}
    return found | said | {"properties": {key: {"anyOf": tags}}, "allOf": rules}


def _node_schema(operators: Iterable[Operator]) -> dict[str, Any]:
    """One node; null removes it."""
    known = list(operators)
    names = [{"const": op.name, "description": op.doc.partition("\n")[0]} for op in known]
    names += [{"const": old, **_deprecated(op.name)} for op in known for old in op.formerly]
    return {
        "type": ["object", "null"],
        "additionalProperties": False,
        "properties": {
            "use": {"anyOf": [*names, {"type": "string", "pattern": _GRAPH_FILE}]},
            "in": {"type": ["object", "null"]},
            "with": {"type": ["object", "null"]},
            "doc": {"type": "string"},
        },
        "allOf": [_operator_rule(op) for op in known],
    }


def _operator_rule(operator: Operator) -> dict[str, Any]:
    """If `use` names this operator, then its ports and parameters are these."""
    parameters = operator.parameters.model_json_schema(ref_template="#/$defs/{model}", schema_generator=_lenient())
    wire = {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}, {"type": "null"}]}
    ports = {
        port.name: {**wire, "description": f"{port.type}{' (lazy)' if port.lazy else ''}"}
        for port in operator.inputs.values()
    }
    settings = _inlined(parameters)
    for old, present in operator.renamed.items():
        for properties in (ports, settings):
            if present in properties:
                properties[old] = {**properties[present], **_deprecated(present)}
    rule: dict[str, Any] = {
        "in": {"type": ["object", "null"], "additionalProperties": False, "properties": ports},
        "with": {"type": ["object", "null"], "additionalProperties": False, "properties": settings},
    }
    names = {"enum": [operator.name, *operator.formerly]} if operator.formerly else {"const": operator.name}
    return {
        "if": {"required": ["use"], "properties": {"use": names}},
        "then": {"description": operator.doc, "properties": rule},
    }


def _deprecated(present: str) -> dict[str, Any]:
    """What marks an old name, for editors to strike it through."""
    return {"deprecated": True, "description": f"Now called {present}."}


def _lenient() -> type[Any]:
    """Pydantic's generator, letting pass a parameter that no JSON Schema describes (a callable, say)."""
    from pydantic.json_schema import GenerateJsonSchema, JsonSchemaWarningKind

    class Lenient(GenerateJsonSchema):
        def handle_invalid_for_json_schema(self, schema: Any, error_info: str) -> dict[str, Any]:
            return {}

        def emit_warning(self, kind: JsonSchemaWarningKind, detail: str) -> None:
            """A default that JSON cannot hold is left out; nobody needs to hear of it."""

    return Lenient


def _inlined(schema: dict[str, Any]) -> dict[str, Any]:
    """The properties of a parameter model with its own definitions put in place of references to them."""
    definitions = schema.get("$defs", {})

    def resolve(part: Any, depth: int) -> Any:
        if isinstance(part, list):
            return [resolve(p, depth) for p in part]
        if not isinstance(part, dict):
            return part
        reference = part.get("$ref", "")
        if reference:
            name = reference.rpartition("/")[2]
            return resolve(definitions[name], depth + 1) if depth < 8 and name in definitions else {}
        return {key: resolve(value, depth) for key, value in part.items()}

    properties: dict[str, Any] = resolve(schema.get("properties", {}), 0)
    return properties


def _named(values: dict[str, Any], taken: frozenset[str] = frozenset()) -> dict[str, Any]:
    """A mapping from names to `values`; an empty one may be written as nothing.

    Not an `anyOf` with null: where none of its options fits, checkers mark the whole section instead of the mistake.
    """
    names: dict[str, Any] = {"pattern": _NAME}
    if taken:
        names["not"] = {"enum": sorted(taken)}
    return {"type": ["object", "null"], "propertyNames": names, "additionalProperties": values}
