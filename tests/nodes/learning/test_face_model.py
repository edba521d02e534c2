"""A face model from folders of photographs."""

from __future__ import annotations

import pytest

from graphface import UnreadableFile
from graphface.nodes.learning.face_model import points_in, read_card


class TestPointsIn:
    def test_no_photograph(self, tmp_path):
        """A folder without a photograph is refused by name."""
        (tmp_path / "notes.txt").write_text("none")
        with pytest.raises(UnreadableFile, match="holds no photograph"):
            points_in(tmp_path)


class TestReadCard:
    def test_one_object(self, tmp_path):
        """A card is one JSON object; no card is an empty one."""
        path = tmp_path / "card.json"
        path.write_text('{"license": "none"}')
        assert read_card(path) == {"license": "none"}
        assert read_card(None) == {}

    @pytest.mark.parametrize(("text", "reason"), [("[1]", "one JSON object"), ("{", "not a JSON card")])
    def test_anything_else_is_refused(self, tmp_path, text, reason):
        """A list and a damaged file are refused."""
        path = tmp_path / "card.json"
        path.write_text(text)
        with pytest.raises(UnreadableFile, match=reason):
            read_card(path)
