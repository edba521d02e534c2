"""Scene files: what they may say, and what a wrong one is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import graphface.graphs
from graphface import UnreadableFile
from graphface.nodes.types import DirectionalLight, HarmonicLight, Scene

SHIPPED = sorted((Path(graphface.graphs.__file__).parent / "scenes").glob("*.yaml"))


def written(tmp_path, text):
    path = tmp_path / "scene.yaml"
    path.write_text(text, encoding="utf-8")
    return path


class TestShippedScenes:
    @pytest.mark.parametrize("path", SHIPPED, ids=lambda p: p.stem)
    def test_are_valid_and_documented(self, path):
        """Every shipped scene loads and says what it is."""
        assert Scene.from_file(path).doc

    def test_there_are_several(self):
        """The folder is found and not empty."""
        assert len(SHIPPED) >= 3


class TestFromFile:
    def test_reads_lights_by_type(self, tmp_path):
        """`type` chooses the kind of light."""
        text = "lights:\n  - {type: directional, azimuth: 90}\n  - {type: sh, preset: overcast}\n"
        scene = Scene.from_file(written(tmp_path, text))
        assert [type(light) for light in scene.lights] == [DirectionalLight, HarmonicLight]

    @pytest.mark.parametrize(
        ("text", "line", "words"),
        [
            ("ambient: 0.1\nlihgts: []\n", 2, "lihgts: unknown key"),
            ("mode: replace\nlights:\n  - type: directional\n    intensity: -1\n", 4, "greater than or equal to 0"),
            ("lights:\n  - {type: laser}\n", 2, "laser"),
            ("lights:\n  - {type: directional, direction: [0, 0, 0]}\n", 2, "no length"),
            ("lights:\n  - {type: directional, azimuth: .nan}\n", 2, "finite"),
            ("lights:\n  - {type: sh, coefficients: [1, 2]}\n", 2, "got 2"),
            ("lights:\n  - {type: sh}\n", 2, "either coefficients or a preset"),
            ("doc: ok\nambient: [1, 2]\n", 2, "ambient"),
            ("lights: [\n", 2, "not YAML"),
        ],
    )
    def test_a_mistake_is_named_with_its_line(self, tmp_path, text, line, words):
        """File, line and what is wrong; never a traceback of the parser's."""
        path = written(tmp_path, text)
        with pytest.raises(UnreadableFile) as caught:
            Scene.from_file(path)
        assert str(caught.value).startswith(f"{path}:{line}:")
        assert words in str(caught.value)

    @pytest.mark.parametrize("text", ["", "- 1\n", "hello\n"])
    def test_not_a_mapping(self, tmp_path, text):
        """An empty file, a list and a word are no scenes."""
        with pytest.raises(UnreadableFile, match="a scene is a mapping"):
            Scene.from_file(written(tmp_path, text))

    def test_missing_and_binary_files(self, tmp_path):
        """Files that cannot be read as text are refused by name."""
        with pytest.raises(UnreadableFile, match=r"none\.yaml"):
            Scene.from_file(tmp_path / "none.yaml")
        (tmp_path / "photo.yaml").write_bytes(b"\xff\xd8\xff\xe0")
        with pytest.raises(UnreadableFile, match="not a text file"):
            Scene.from_file(tmp_path / "photo.yaml")


class TestCoerce:
    def test_takes_scenes_mappings_and_paths(self, tmp_path):
        """What people have at hand in a notebook."""
        scene = Scene(ambient=0.5)
        assert Scene.coerce(scene) is scene
        assert Scene.coerce({"ambient": 0.5}) == scene
        assert Scene.coerce(str(written(tmp_path, "ambient: 0.5\n"))) == scene

    def test_names_the_wrong_key(self):
        """A wrong mapping is a ValueError that says where."""
        with pytest.raises(ValueError, match="ambience: unknown key"):
            Scene.coerce({"ambience": 1})


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
