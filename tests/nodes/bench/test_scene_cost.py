"""`graphface bench scenes`: what each scene makes the graph run, and that it is timed."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.bench import scene_cost
from graphface.nodes.io.image_write import write_picture

ON_ITS_OWN = "background: 1\nhair: 0\nspecular: 0\n"
SUN = "lights: [{type: directional, azimuth: 30, shadow: %s}]\n"

CALLED_FOR = {
    "own": ("mode: add\n", "none"),
    "plain": (ON_ITS_OWN + SUN % "none", "none"),
    "casting": (ON_ITS_OWN + SUN % "hard", "shadows"),
    "behind": (ON_ITS_OWN + SUN.replace("30", "180") % "soft", "none"),
    "skin": (ON_ITS_OWN + "scatter: 0.03\n" + SUN % "none", "scattering"),
    "shiny": ("background: 1\nhair: 0\nspecular: 1\n" + SUN % "none", "highlights"),
    "hair": ("background: 1\nhair: 0.5\nspecular: 0\n" + SUN % "none", "labels"),
    "backdrop": ("background: 0.5\nhair: 0\nspecular: 0\n" + SUN % "none", "labels"),
    "everything": ("scatter: 0.03\nspecular: 1\n" + SUN % "soft", "shadows, scattering, highlights, labels"),
}
"""Scenes, and the effects that they ask for."""


@pytest.fixture(scope="module")
def scenes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scenes")
    for name, (text, _) in CALLED_FOR.items():
        (folder / f"{name}.yaml").write_text(text)
    return [folder / f"{name}.yaml" for name in CALLED_FOR]


@pytest.fixture(scope="module")
def costs(face, scenes):
    """Of every scene, on the smallest picture in which the face is found."""
    photo = scenes[0].with_name("me.png")
    write_picture(face, photo)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scene_cost, "shipped_scenes", lambda: scenes)
        return {cost.scene: cost for cost in scene_cost.scene_costs(photo, 0.0164, 1)}


class TestSceneCosts:
    def test_a_row_for_each(self, costs):
        """The plain edits first, then every scene that is shipped."""
        assert list(costs) == [*scene_cost.PLAIN, *CALLED_FOR]

    @pytest.mark.parametrize("name", CALLED_FOR)
    def test_effects_are_those_that_the_scene_calls_for(self, costs, name):
        """No more and no fewer."""
        assert costs[name].effects == CALLED_FOR[name][1]

    def test_more_effects_run_more_nodes(self, costs):
        """The photo's own light runs least, plain light more, one effect more than that, all of them most."""
        assert costs["own"].nodes < costs["plain"].nodes < costs["casting"].nodes < costs["everything"].nodes

    def test_times_are_times(self, costs):
        """Positive and finite."""
        spent = np.array([(c.milliseconds, c.cpu_ms, c.copy) for c in costs.values()])
        assert np.isfinite(spent).all()
        assert (spent > 0).all()
