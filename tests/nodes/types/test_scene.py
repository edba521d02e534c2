"""Scene files: what they may say, and what a wrong one is told."""

from __future__ import annotations

from pathlib import Path

import jsonschema
import numpy as np
import PIL.Image
import pytest
import yaml
from pydantic import ValidationError

import graphface.graphs
from graphface import DocumentError, Evaluator, InputError, Observer, UnreadableFile, read_yaml
from graphface.cli import main
from graphface.document.schema import schema_of
from graphface.nodes.types import DirectionalLight, HarmonicLight, Scene
from graphface.registry import default_registry

SHIPPED = sorted((Path(graphface.graphs.__file__).parent / "scenes").glob("*.yaml"))


def read(path):
    return read_yaml(path, Scene)


def written(tmp_path, text):
    path = tmp_path / "scene.yaml"
    path.write_text(text, encoding="utf-8")
    return path


class TestShippedScenes:
    @pytest.mark.parametrize("path", SHIPPED, ids=lambda p: p.stem)
    def test_are_valid_and_documented(self, path):
        """Every shipped scene loads and says what it is."""
        assert read(path).doc

    @pytest.mark.parametrize("path", SHIPPED, ids=lambda p: p.stem)
    def test_are_read_as_yaml_is(self, path):
        """Reading with positions gives what a plain YAML reader and pydantic give."""
        assert read(path) == Scene.model_validate(yaml.safe_load(path.read_text(encoding="utf-8")))

    def test_there_are_several(self):
        """The folder is found and not empty."""
        assert len(SHIPPED) >= 3


class TestFile:
    def test_reads_lights_by_type(self, tmp_path):
        """`type` chooses the kind of light."""
        text = "lights:\n  - {type: directional, azimuth: 90}\n  - {type: sh, preset: overcast}\n"
        scene = read(written(tmp_path, text))
        assert [type(light) for light in scene.lights] == [DirectionalLight, HarmonicLight]

    @pytest.mark.parametrize(
        ("text", "line", "column", "words"),
        [
            ("ambient: 0.1\nlihgts: []\n", 2, 1, "no entry 'lihgts'"),
            ("mode: replace\nlights:\n  - type: directional\n    intensity: -1\n", 4, 16, "greater than or equal to 0"),
            ("lights:\n  - {type: laser}\n", 2, 12, "unknown type 'laser' (it is one of directional, point, spot"),
            ("lights:\n  - {azimuth: 3}\n", 2, 5, "lights[0] has no 'type'"),
            ("lights:\n  - {type: directional, direction: [0, 0, 0]}\n", 2, 36, "without a length"),
            ("lights:\n  - {type: directional, azimuth: .nan}\n", 2, 34, "finite"),
            ("lights:\n  - {type: directional, kelvin: hot}\n", 2, 33, ".kelvin: input should be a number, got 'hot'"),
            ("lights:\n  - {type: point, color: [1, 2]}\n", 2, 26, "lights[0].color: 3 values are needed, got [1, 2]"),
            ("lights:\n  - {type: point, cone: 3}\n", 2, 19, "lights[0] (point) has no entry 'cone'"),
            ("lights:\n  - {type: sh, coefficients: [1, 2]}\n", 2, 30, "9 or 16 coefficients make a light, got [1, 2]"),
            ("lights:\n  - {type: sh}\n", 2, 5, "lights[0] (sh): give either coefficients or a preset"),
            ("lights: {type: sh, preset: left}\n", 1, 9, "lights: input should be a list"),
            ("doc: ok\nambient: [1, 2]\n", 2, 10, "ambient: 3 values are needed"),
            ("ambient: [1, up, 1]\n", 1, 14, "ambient[1]: input should be a number, got 'up'"),
            ("exposure: 1\nexposure: 2\n", 2, 1, "'exposure' stands twice; the first is at line 1"),
            ("lights:\n\t- {type: sh}\n", 2, 1, "indented by a tab"),
            ("lights: [\n", 2, 1, "not YAML"),
            ("", 1, 1, "Scene: input should be a mapping with doc, mode, mix, ambient, lights,"),
            ("- 1\n", 1, 1, "Scene: input should be a mapping"),
            ("hello\n", 1, 1, "Scene: input should be a mapping"),
        ],
    )  # fmt: skip
    def test_a_mistake_is_shown_where_it_is(self, tmp_path, text, line, column, words):
        """File, line, column and what is wrong; never a traceback of the parser's."""
        path = written(tmp_path, text)
        with pytest.raises(DocumentError) as caught:
            read(path)
        (problem,) = caught.value.problems
        assert str(caught.value).startswith(f"{path}:{line}:{column}: ")
        assert words in problem.message

    def test_all_mistakes_at_once(self, tmp_path):
        """One reading finds them all, each with its line, a caret and the nearest name."""
        text = """\
ambient: 0.2
lights:
  - {type: spott, cone: 400, colour: [1, 0, 0]}
  - {type: directional, kelvin: 900, color: [1, 1, 1], shadow: sfot}
backgruond: 0.5
"""
        path = written(tmp_path, text)
        with pytest.raises(DocumentError) as caught:
            read(path)
        assert [(p.place.line, p.place.column, *p.nearest) for p in caught.value.problems] == [
            (3, 12, "spot"),
            (3, 25),
            (3, 30, "color"),
            (4, 5),
            (4, 33),
            (4, 64, "soft"),
            (5, 1, "background"),
        ]
        assert f"{path}:3:12: lights[0]: unknown type 'spott'" in str(caught.value)
        assert "\n      - {type: spott, cone: 400, colour: [1, 0, 0]}\n               ^\n" in str(caught.value)

    @pytest.mark.parametrize(
        ("light", "words"),
        [
            ("{type: sh, preset: left, kelvin: 5000, color: [1, 1, 1]}", "give either kelvin or color, not both"),
            ("{type: directional, direction: [0, 0, 1], azimuth: 1}", "give either direction or azimuth, not both"),
            (
                "{type: spot, position: [0, 0, 1], elevation: 1, distance: 2, kelvin: 5000, color: [1, 1, 1]}",
                "give either kelvin or color, either position or elevation and distance, not both",
            ),
        ],
    )
    def test_two_ways_to_say_one_thing(self, tmp_path, light, words):
        """What contradicts itself is refused, all of it in one sentence."""
        with pytest.raises(DocumentError, match=words):
            read(written(tmp_path, f"lights:\n  - {light}\n"))

    def test_lights_share_what_they_have_in_common(self, tmp_path):
        """Anchors and merge keys, which YAML files of people's own may hold."""
        text = "lights:\n  - &lamp {type: spot, cone: 9, azimuth: 3}\n  - {<<: *lamp, azimuth: -3}\n  - *lamp\n"
        first, second, third = read(written(tmp_path, text)).lights
        assert first == third
        assert second == first.model_copy(update={"azimuth": -3.0})

    def test_missing_and_binary_files(self, tmp_path):
        """Files that cannot be read as text are refused by name."""
        with pytest.raises(UnreadableFile, match=r"none\.yaml"):
            read(tmp_path / "none.yaml")
        (tmp_path / "photo.yaml").write_bytes(b"\xff\xd8\xff\xe0")
        with pytest.raises(UnreadableFile, match="not UTF-8 text"):
            read(tmp_path / "photo.yaml")

    def test_huge_file(self, tmp_path):
        """A file that nobody wrote by hand is refused before it is parsed."""
        with pytest.raises(UnreadableFile, match="larger than"):
            read(written(tmp_path, "lights: []\n" + "# much\n" * 200_000))


class TestCoerce:
    def test_takes_scenes_and_mappings(self):
        """What people have at hand in a notebook."""
        scene = Scene(ambient=0.5)
        assert Scene.coerce(scene) is scene
        assert Scene.coerce({"ambient": 0.5}) == scene

    def test_names_the_wrong_keys(self):
        """A wrong mapping is told all that is wrong, by the keys that lead there."""
        with pytest.raises(DocumentError) as caught:
            Scene.coerce({"ambience": 1, "lights": [{"type": "spot", "cone": "wide"}]})
        assert [p.message.partition(" (")[0] for p in caught.value.problems] == [
            "lights[0].cone: input should be a number, got 'wide'",
            "Scene has no entry 'ambience'",
        ]


class Started(Observer):
    """The nodes that ran."""

    def __init__(self) -> None:
        self.names: list[str] = []

    def node_started(self, name, step) -> None:
        self.names.append(name)


class TestInARun:
    @pytest.fixture
    def photo(self, tmp_path):
        path = tmp_path / "photo.png"
        PIL.Image.fromarray(np.full((40, 40, 3), 120, np.uint8)).save(path)
        return str(path)

    def test_is_checked_before_anything_runs(self, tmp_path, photo):
        """No node has started when a wrong scene is refused, from a file or in a mapping."""
        started = Started()
        evaluator = Evaluator(observers=[started])
        bad = written(tmp_path, "mode: repl\n")
        with pytest.raises(DocumentError, match="replace"):
            graphface.load("relight").run(photo=photo, scene=str(bad), evaluator=evaluator)
        with pytest.raises(InputError, match="'scene': mode: input should be"):
            graphface.load("relight").run(photo=photo, scene={"mode": "repl"}, evaluator=evaluator)
        assert started.names == []

    @pytest.mark.parametrize("more", [["-i", "photo={photo}"], ["--map", "photo={photos}"]])
    def test_exit_code(self, tmp_path, photo, capsys, more):
        """On the command line it is a mistake in what was asked: exit code 2, file, line and caret, no traceback."""
        bad = written(tmp_path, "lights:\n  - {type: spott}\n")
        flags = [flag.format(photo=photo, photos=tmp_path / "*.png") for flag in more]
        with pytest.raises(SystemExit) as left:
            main(["run", "relight", *flags, "-i", f"scene={bad}", "-o", str(tmp_path / "out-{photo}.png")])
        assert left.value.code == 2
        error = capsys.readouterr().err
        assert error.startswith(f"error: {bad}:2:12: lights[0]: unknown type 'spott'")
        assert "did you mean 'spot'?\n      - {type: spott}\n               ^\n" in error
        assert not list(tmp_path.glob("out*"))

    def test_in_a_graph_file(self, tmp_path):
        """A default that a graph file writes out is checked like a scene file, with places in the graph file."""
        graph = tmp_path / "graph.yaml"
        graph.write_text(
            "graphface: 1\ninputs:\n  scene:\n    type: Scene\n    default:\n      lights: [{type: laser}]\n"
        )
        with pytest.raises(DocumentError) as caught:
            graphface.load(graph).bind({})
        (problem,) = caught.value.problems
        assert str(problem.place) == f"{graph}:6:23"
        graph.write_text(graph.read_text().replace("laser", "spot"))
        assert graphface.load(graph).bind({})["scene"].value == Scene(lights=({"type": "spot"},))


@pytest.fixture(scope="module")
def checker():
    schema = schema_of("scene", default_registry())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


class TestSchema:
    def test_documented(self, checker):
        """Every field says what it is, with its unit."""
        parts = [checker.schema, *checker.schema["$defs"].values()]
        fields = [(name, field) for part in parts for name, field in part["properties"].items() if name != "type"]
        assert len(fields) > 40
        assert [name for name, field in fields if not field.get("description")] == []

    @pytest.mark.parametrize("path", SHIPPED, ids=lambda p: p.stem)
    def test_takes_shipped_scenes(self, checker, path):
        """Every shipped scene is valid."""
        assert list(checker.iter_errors(yaml.safe_load(path.read_text(encoding="utf-8")))) == []

    @pytest.mark.parametrize(
        ("text", "place"),
        [
            ("lihgts: []", "$"),
            ("mode: repl", "$.mode"),
            ("ambient: -1", "$.ambient"),
            ("lights: {type: sh}", "$.lights"),
            ("lights: [{type: laser}]", "$.lights[0].type"),
            ("lights: [{cone: 3}]", "$.lights[0]"),
            ("lights: [{type: spot, cone: 400}]", "$.lights[0].cone"),
            ("lights: [{type: point, cone: 4}]", "$.lights[0]"),
            ("lights: [{type: point, color: [1, 2]}]", "$.lights[0].color"),
            ("lights: [{type: directional, shadow: sfot}]", "$.lights[0].shadow"),
            ("lights: [{type: point, position: [1, x, 2]}]", "$.lights[0].position"),
        ],
    )
    def test_marks_mistakes(self, checker, text, place):
        """A wrong scene is marked where it is wrong, and reading refuses it too."""
        content = yaml.safe_load(text)
        with pytest.raises(ValidationError):
            Scene.model_validate(content)
        assert {error.json_path for error in checker.iter_errors(content)} == {place}


class TestDirectionalLight:
    @pytest.mark.parametrize(
        ("azimuth", "elevation", "expected"),
        [(0, 0, (0, 0, 1)), (90, 0, (1, 0, 0)), (-90, 0, (-1, 0, 0)), (0, 90, (0, 1, 0)), (180, 0, (0, 0, -1))],
    )
    def test_angles(self, azimuth, elevation, expected):
        """Azimuth turns to the picture's right, elevation up."""
        light = DirectionalLight(azimuth=azimuth, elevation=elevation)
        np.testing.assert_allclose(light.towards, expected, atol=1e-6)

    def test_a_vector_is_normalized(self):
        """Any length will do."""
        np.testing.assert_allclose(DirectionalLight(direction=(0, 3, 4)).towards, (0, 0.6, 0.8), atol=1e-6)

    def test_angles_and_vector_exclude_each_other(self):
        """Two directions for one light are a mistake."""
        with pytest.raises(ValueError, match="not both"):
            DirectionalLight(direction=(0, 0, 1), azimuth=10)


class TestColored:
    def test_only_where_channels_differ(self):
        """Grey light, however bright, needs one channel of shading."""
        grey = DirectionalLight(color=(0.5, 0.5, 0.5))
        assert not Scene(ambient=(1, 1, 1), lights=(grey,)).colored
        assert Scene(ambient=(1, 1, 0.9)).colored
        assert Scene(lights=(DirectionalLight(color=(1, 0, 0)),)).colored
