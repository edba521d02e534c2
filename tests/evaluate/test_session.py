"""Sessions: an edit costs what it reaches, inputs are looked at once, previews are small."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import load
from graphface.errors import InputError
from graphface.evaluate.session import Session


@pytest.fixture
def relight():
    return load(
        {
            "graphface": 1,
            "name": "two",
            "inputs": {"photo": "Image", "other": "Image"},
            "nodes": {
                "a": {"use": "image.encode", "in": {"photo": "photo"}, "with": {"encoding": "linear"}},
                "b": {"use": "image.encode", "in": {"photo": "other"}, "with": {"encoding": "linear"}},
            },
            "outputs": {"a": "a", "b": "b"},
        }
    )


def picture(value, side=8):
    return np.full((side, side, 3), value, np.float32)


def ran(result):
    return {record.name for record in result.records if record.state == "ran"}


def halved(image):
    return image.with_pixels(np.ascontiguousarray(image.pixels[::2, ::2]))


class TestSession:
    def test_an_edit_reaches_what_depends_on_it(self, relight):
        """The branch of the other input is not run again."""
        from graphface.nodes.types.image import image_from_array

        photo, other, third = (image_from_array(picture(v)) for v in (0.1, 0.2, 0.3))
        session = Session(relight, {"photo": photo, "other": other})
        assert {"a", "b"} <= ran(session.render())
        session.edit(other=third)
        again = ran(session.render())
        assert "b" in again
        assert "a" not in again

    def test_an_input_may_have_the_name_of_a_setting(self):
        """`history`, `graph` and `draft` are inputs like any other, when the session begins and when it is edited."""
        names = ["draft", "graph", "history", "inputs", "self"]
        encode = {"use": "image.encode", "with": {"encoding": "srgb"}}
        nodes = {f"of_{name}": encode | {"in": {"photo": name}} for name in names}
        outputs = {name: name for name in nodes}
        inputs = dict.fromkeys(names, "Image")
        graph = load({"graphface": 1, "name": "named", "inputs": inputs, "nodes": nodes, "outputs": outputs})
        session = Session(graph, dict.fromkeys(names, picture(0.1)))
        session.edit(**dict.fromkeys(names, picture(0.2)))
        result = session.render()
        assert all((result[name].pixels == np.float32(0.2)).all() for name in outputs)

    def test_unedited_inputs_are_not_bound_again(self, relight, tmp_path):
        """A file that was deleted meanwhile is not missed."""
        from graphface.nodes.io.image_write import write_picture

        path = tmp_path / "photo.png"
        write_picture(np.zeros((4, 4, 3), np.uint8), path)
        session = Session(relight, {"photo": path, "other": picture(0.2)})
        session.render()
        path.unlink()
        session.edit(other=picture(0.3))
        assert session.render()["a"].pixels.shape == (4, 4, 3)

    def test_the_preview_is_reduced(self, relight):
        """Half the side where asked, the full size elsewhere."""
        session = Session(relight, {"photo": picture(0.1), "other": picture(0.2)}, shrink={"photo": halved})
        small = session.preview()
        assert small["a"].pixels.shape == (4, 4, 3)
        assert small["b"].pixels.shape == (8, 8, 3)
        assert session.render()["a"].pixels.shape == (8, 8, 3)

    def test_the_preview_follows_edits(self, relight):
        """It shows the input as it is now."""
        session = Session(relight, {"photo": picture(0.1), "other": picture(0.2)}, shrink={"photo": halved})
        before = session.preview()["a"].pixels[0, 0, 0]
        session.edit(photo=picture(0.9))
        assert session.preview()["a"].pixels[0, 0, 0] > before

    def test_a_wrong_edit_changes_nothing(self, relight):
        """The session stays as it was."""
        session = Session(relight, {"photo": picture(0.1), "other": picture(0.2)})
        with pytest.raises(InputError):
            session.edit(phtoo=picture(0.5))
        assert session.edits == 1
        assert session.render()["a"].pixels.shape == (8, 8, 3)

    def test_the_plan_is_that_of_the_edit(self, relight):
        """Memoized nodes and nodes to run, before anything runs."""
        from graphface.nodes.types.image import image_from_array

        photo, other, third = (image_from_array(picture(v)) for v in (0.1, 0.2, 0.3))
        session = Session(relight, {"photo": photo, "other": other})
        session.render()
        session.edit(other=third)
        fates = {node.name: node.fate for node in session.plan()}
        assert fates == {"a": "memory", "b": "run"}


class TestHistory:
    def edits(self, relight, count, **settings):
        """A session whose input `other` was edited so many times, rendering each."""
        session = Session(relight, {"photo": picture(0.1), "other": picture(0)}, **settings)
        for turn in range(count):
            session.edit(other=picture(turn / 100))
            session.render()
        return session

    def test_the_last_states_are_remembered(self, relight):
        """Going back a step runs nothing."""
        session = self.edits(relight, 3)
        session.edit(other=picture(0.01))
        assert not ran(session.render()) - {"other"}

    def test_older_states_are_forgotten(self, relight):
        """Hours of edits hold no more memory than a few, and what no edit reaches is never lost."""
        few, many = self.edits(relight, 4, history=2), self.edits(relight, 40, history=2)
        assert many.evaluator.memory.held_bytes == few.evaluator.memory.held_bytes
        many.edit(other=picture(0.9))
        assert "a" not in ran(many.render())

    def test_a_state_gone_back_to_is_young_again(self, relight):
        """It is what was used longest ago that goes."""
        session = self.edits(relight, 2, history=2)
        for value in (0.0, 0.5, 0.0):
            session.edit(other=picture(value))
            result = session.render()
        assert "b" not in ran(result)
