"""`graphface bench scenes`: what each scene makes the graph run, and that it is timed."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.commands.gallery import shipped_scenes
from graphface.nodes.commands.scene_cost import PLAIN, scene_costs
from graphface.nodes.image import write_picture
from graphface.nodes.render.scene import Scene


@pytest.fixture(scope="module")
def costs(face, tmp_path_factory):
    """Of every scene, on the smallest picture in which the face is found."""
    path = tmp_path_factory.mktemp("scenes") / "me.png"
    write_picture(face, path)
    return {cost.scene: cost for cost in scene_costs(path, 0.0164, 1)}


def called_for(scene):
    """The effects that a scene asks for, by its own words."""
    if scene.unchanged:
        return set()
    found = {
        "shadows": bool(scene.casting),
        "scattering": scene.scatter > 0,
        "highlights": scene.specular > 0,
        "labels": scene.background != 1 or scene.hair != 0,
    }
    return {effect for effect, asked in found.items() if asked}


class TestSceneCosts:
    def test_a_row_for_each(self, costs):
        """The plain edits first, then every shipped scene."""
        assert list(costs) == [*PLAIN, *(path.stem for path in shipped_scenes())]

    def test_effects_are_those_that_the_scene_calls_for(self, costs):
        """No more and no fewer."""
        scenes = {name: Scene.coerce(given) for name, given in PLAIN.items()}
        scenes |= {path.stem: Scene.from_file(path) for path in shipped_scenes()}
        told = {name: set(cost.effects.split(", ")) - {"none"} for name, cost in costs.items()}
        assert told == {name: called_for(scene) for name, scene in scenes.items()}

    def test_more_effects_run_more_nodes(self, costs):
        """The photo's own light runs least, harmonics more, a shadow more than that."""
        assert costs["as-photographed"].nodes < costs["harmonics only"].nodes < costs["soft-shadowed spot"].nodes

    def test_times_are_times(self, costs):
        """Positive and finite, and an edit costs more than copying what it reads."""
        spent = np.array([(c.milliseconds, c.copy) for c in costs.values()])
        assert np.isfinite(spent).all()
        assert (spent > 0).all()
        assert costs["soft-shadowed spot"].milliseconds > costs["soft-shadowed spot"].copy


class TestBenchScenes:
    def test_table(self, command, face, tmp_path):
        """One line for each, with nodes, effects, milliseconds and copies."""
        write_picture(face, tmp_path / "me.png")
        said = command("bench", "scenes", "--photo", tmp_path / "me.png", "--megapixels", 0.0164, "--repeats", 1)
        assert said.code == 0, said.err
        assert len(said.out.splitlines()) == 1 + len(PLAIN) + len(shipped_scenes())
        nodes, *effects, milliseconds, copies = said.figures("soft-shadowed spot")
        assert int(nodes) > 3
        assert "shadows," in effects
        assert float(milliseconds) > 0
        assert float(copies) > 0

    def test_missing_photo(self, command, tmp_path):
        """A photo that does not exist is named."""
        said = command("bench", "scenes", "--photo", tmp_path / "none.png")
        assert said.code == 2
        assert "none.png" in said.err
