"""The schema accepts every graph file that loads and marks, while typing, the mistakes that loading would find."""

import json
from collections.abc import Callable
from enum import Enum
from pathlib import Path
from typing import Annotated, Any, Literal

import jsonschema
import pytest
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from toys import toy_registry

from graphface import DocumentError, Formerly, Pack, Registry, load, node
from graphface.cli import main
from graphface.document.located import parse, plain
from graphface.document.schema import graph_schema, model_schema, schema_of
from graphface.errors import UnknownName
from graphface.place import Source
from graphface.registry import default_registry


def problems(schema: dict[str, Any], text: str) -> list[str]:
    """Where the schema finds something wrong in a graph file, as paths."""
    tree, twice = parse(Source("<text>", text))
    assert not twice
    found = jsonschema.Draft202012Validator(schema).iter_errors(plain(tree))
    return [error.json_path for error in found]


@pytest.fixture(scope="module")
def installed() -> dict[str, Any]:
    return graph_schema(default_registry())


@pytest.fixture(scope="module")
def toys() -> dict[str, Any]:
    return graph_schema(toy_registry())


class TestItself:
    def test_valid(self, installed: dict[str, Any]) -> None:
        """It is a JSON Schema, with every installed operator in it."""
        jsonschema.Draft202012Validator.check_schema(installed)
        names = {option.get("const") for option in installed["$defs"]["node"]["properties"]["use"]["anyOf"]}
        assert set(default_registry().names()) <= names

    def test_json(self, installed: dict[str, Any]) -> None:
        """It is strict JSON and refers to nothing that it does not hold."""
        text = json.dumps(installed, allow_nan=False)
        references = {part.split('"')[1] for part in text.split('"$ref": ')[1:]}
        assert references == {f"#/$defs/{name}" for name in ("node", "input", "type", "reference")}

    def test_documented(self, installed: dict[str, Any]) -> None:
        """Editors can show what an operator does and what each of its ports takes."""
        uses = [(rule["if"]["properties"]["use"], rule["then"]) for rule in installed["$defs"]["node"]["allOf"]]
        rules = {use["const"] if "const" in use else use["enum"][0]: then for use, then in uses}
        assert all(rule["description"] for rule in rules.values())
        assert rules["sh.fit"]["properties"]["in"]["properties"]["normals"]["description"] == "Normals"

    def test_any_parameter(self) -> None:
        """Parameters of every kind get a schema, also those that JSON cannot describe."""

        class Mode(Enum):
            SOFT = "soft"
            HARD = "hard"

        class Sub(BaseModel):
            inner: list["Sub"] = []
            size: int = Field(1, ge=0)

        def odd(
            a: float,
            *,
            mode: Mode = Mode.SOFT,
            sub: Sub = Sub(),  # noqa: B008
            choice: Literal["x", 1] = "x",
            pair: tuple[int, float] = (1, 2.0),
            name: Annotated[str, Field(pattern="^a")] = "a",
            rule: Callable[[float], float] = abs,
            path: Path | None = None,
        ) -> float:
            """Does nothing."""
            return a

        registry = Registry()
        odd.__annotations__ |= {"mode": Mode, "sub": Sub}
        registry.add(node("odd.odd")(odd))
        schema = graph_schema(registry)
        jsonschema.Draft202012Validator.check_schema(schema)
        text = "graphface: 1\nnodes: {n: {use: odd.odd, with: {mode: hard, pair: [1, 2], choice: 1, sub: {size: 2}}}}\n"
        assert problems(schema, text) == []
        assert problems(schema, text.replace("hard", "hart")) != []

    def test_old_names(self) -> None:
        """Old names of operators, ports and parameters are allowed, and marked as deprecated."""

        def mine(a: Annotated[float, Formerly("x")], *, b: Annotated[int, Field(ge=0), Formerly("y")] = 1) -> float:
            return a

        registry = Registry()
        registry.add(node("mine.new", formerly=("mine.old",))(mine))
        schema = graph_schema(registry)
        jsonschema.Draft202012Validator.check_schema(schema)
        text = "graphface: 1\ninputs: {p: float}\nnodes: {n: {use: mine.old, in: {x: p}, with: {y: 1}}}\n"
        assert problems(schema, text) == []
        assert problems(schema, text.replace("y: 1", "y: -1")) == ["$.nodes.n.with.y"]
        (rule,) = schema["$defs"]["node"]["allOf"]
        old = rule["then"]["properties"]["with"]["properties"]["y"]
        assert (old["deprecated"], old["description"]) == (True, "Now called b.")
        marked = [use for use in schema["$defs"]["node"]["properties"]["use"]["anyOf"] if use.get("deprecated")]
        assert [use["const"] for use in marked] == ["mine.old"]


class TestAccepts:
    @pytest.mark.parametrize(
        "path", [p for f in default_registry().graph_folders() for p in sorted(f.glob("*.yaml"))], ids=lambda p: p.name
    )
    def test_shipped(self, installed: dict[str, Any], path: Path) -> None:
        """Every shipped graph."""
        assert problems(installed, path.read_text(encoding="utf-8")) == []

    @pytest.mark.parametrize(
        "text",
        [
            "graphface: 1",
            "{graphface: 1, name: null, inputs: null, nodes: null, outputs: null, variants: null, profiles: null}",
            "{graphface: 1, inputs: {a: float, b: {type: 'float | None', default: null, doc: why}}}",
            "{graphface: 1, nodes: {a/b: {use: toy.number, in: null, with: null}}}",
            "{graphface: 1, inputs: {x: float}, nodes: {t: {use: toy.total, in: {values: [x, x]}}}, outputs: {t: t}}",
            "{graphface: 1, nodes: {n: {use: toy.number}}, variants: {v: {n: null}, w: null}}",
            "{graphface: 1, nodes: {n: {use: toy.number}}, profiles: {p: {n: {value: 2}}, q: null}}",
            "{graphface: 1, nodes: {n: {use: toy.takes_none, in: {grid: null}}}}",
            "{graphface: 1, nodes: {n: {use: toy.gate, in: {a: m}, with: {open: false}}, m: {use: toy.number}}}",
        ],
    )
    def test_whatever_loads(self, toys: dict[str, Any], text: str) -> None:
        """Forms that loading allows are not marked."""
        load(text + "\n", registry=toy_registry())
        assert problems(toys, text) == []

    def test_nested(self, toys: dict[str, Any]) -> None:
        """A node may be a graph file, with what that file takes."""
        assert problems(toys, "{graphface: 1, nodes: {n: {use: sub/inner.yaml, in: {any: x}, with: {a.b: 1}}}}") == []


class TestRejects:
    @pytest.mark.parametrize(
        "text",
        [
            "{}",
            "{graphface: 2}",
            "{graphface: 1, node: {}}",
            "{graphface: 1, nodes: {n: {use: toy.nummber}}}",
            "{graphface: 1, nodes: {n: {use: toy.number, with: {valu: 1}}}}",
            "{graphface: 1, nodes: {n: {use: toy.number, with: {value: much}}}}",
            "{graphface: 1, nodes: {n: {use: toy.ranged, in: {a: x}, with: {count: 9, must: 1}}}}",
            "{graphface: 1, nodes: {n: {use: toy.add, in: {c: x}}}}",
            "{graphface: 1, nodes: {n: {use: toy.add, in: {a: 1.5}}}}",
            "{graphface: 1, nodes: {n: {use: toy.number, where: {}}}}",
            "{graphface: 1, nodes: {2 n: {use: toy.number}}}",
            "{graphface: 1, nodes: [1]}",
            "{graphface: 1, inputs: {x: {default: 1}}}",
            "{graphface: 1, inputs: {evaluator: Image}}",
            "{graphface: 1, outputs: {y: [a]}}",
            "{graphface: 1, extends: 3}",
        ],
    )
    def test_mistake(self, toys: dict[str, Any], text: str) -> None:
        """What loading refuses for its form, names, types and ranges is marked."""
        with pytest.raises(DocumentError):
            load(text + "\n", registry=toy_registry())
        assert problems(toys, text) != []

    def test_place(self, toys: dict[str, Any]) -> None:
        """The mark is on the value that is wrong."""
        text = "{graphface: 1, nodes: {n: {use: toy.ranged, in: {a: x}, with: {count: 9, must: 1}}}}"
        assert problems(toys, text) == ["$.nodes.n.with.count"]


class Square(BaseModel):
    """A square.

    With four sides.
    """

    model_config = ConfigDict(extra="forbid")

    kind: Literal["square"]
    side: Annotated[float, Field(gt=0, description="In meters.")] = 1.0


class Disc(BaseModel):
    """Round."""

    model_config = ConfigDict(extra="forbid")

    kind: Literal["disc"] = "disc"
    inside: "Square | None" = None


class Shapes(BaseModel):
    shapes: list[Annotated[Square | Disc, Field(discriminator="kind")]] = []
    margin: int | list[int] = 0


class TestModel:
    @pytest.fixture
    def marks(self) -> Callable[[Any], list[str]]:
        schema = model_schema(Shapes)
        jsonschema.Draft202012Validator.check_schema(schema)
        return lambda content: [e.json_path for e in jsonschema.Draft202012Validator(schema).iter_errors(content)]

    @pytest.mark.parametrize(
        "content",
        [
            {},
            {"shapes": [{"kind": "square", "side": 2}, {"kind": "disc", "inside": {"kind": "square"}}]},
            {"margin": 1},
            {"margin": [1]},
        ],
    )
    def test_accepts(self, marks: Callable[[Any], list[str]], content: Any) -> None:
        """What the model takes."""
        Shapes.model_validate(content)
        assert marks(content) == []

    @pytest.mark.parametrize(
        ("content", "place"),
        [
            ({"shapes": [{"kind": "square", "side": -2}]}, "$.shapes[0].side"),
            ({"shapes": [{"kind": "sqare"}]}, "$.shapes[0].kind"),
            ({"shapes": [{"side": 2}]}, "$.shapes[0]"),
            ({"shapes": [{"kind": "disc", "side": 2}]}, "$.shapes[0]"),
            ({"shapes": [3]}, "$.shapes[0]"),
            ({"margin": "x"}, "$.margin"),
        ],
    )
    def test_rejects(self, marks: Callable[[Any], list[str]], content: Any, place: str) -> None:
        """What it refuses is marked where it is wrong, also inside a union."""
        with pytest.raises(ValidationError):
            Shapes.model_validate(content)
        assert marks(content) == [place]

    def test_documented(self) -> None:
        """Members of a union are shown with the first line of what they are."""
        kinds = model_schema(Shapes)["properties"]["shapes"]["items"]["properties"]["kind"]["anyOf"]
        assert kinds == [{"const": "disc", "description": "Round."}, {"const": "square", "description": "A square."}]


def made_schema() -> dict[str, Any]:
    return {"type": "string"}


class TestKinds:
    def test_of_packs(self) -> None:
        """A pack describes its files by a model, or by a function that makes the schema itself."""
        kinds = {"shapes": f"{__name__}:Shapes", "word": f"{__name__}:made_schema"}
        registry = Registry([Pack("p", {}, schemas=kinds)])
        assert schema_of("shapes", registry) == model_schema(Shapes)
        assert schema_of("word", registry) == {"type": "string"}
        assert schema_of("graph", registry) == graph_schema(registry)
        with pytest.raises(UnknownName, match="unknown kind of file 'shape'; did you mean 'shapes'"):
            schema_of("shape", registry)


class TestCommand:
    def test_kind(self, capsys: pytest.CaptureFixture[str]) -> None:
        """`--kind` asks for the schema of another kind of file."""
        with pytest.raises(SystemExit) as left:
            main(["schema", "--kind", "scene"])
        assert left.value.code == 0
        assert json.loads(capsys.readouterr().out)["title"] == "Scene"
        with pytest.raises(SystemExit) as left:
            main(["schema", "--kind", "scnee"])
        assert left.value.code == 2
        assert "'scene'" in capsys.readouterr().err

    def test_output(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        """`graphface schema` prints it, or writes it to a file; plug-ins are in it."""
        plugin = tmp_path / "mine.py"
        plugin.write_text(
            "from graphface import node\n@node('mine.same')\ndef same(a: float) -> float:\n    return a\n"
        )
        with pytest.raises(SystemExit) as left:
            main(["schema", "--plugin", str(plugin)])
        assert left.value.code == 0
        printed = json.loads(capsys.readouterr().out)
        with pytest.raises(SystemExit):
            main(["schema", "--plugin", str(plugin), "-o", str(tmp_path / "schema.json")])
        assert json.loads((tmp_path / "schema.json").read_text()) == printed
        assert '"mine.same"' in json.dumps(printed)
