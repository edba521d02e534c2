"""Pages that need no other file, in which words stay words."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

from graphface.report.blobs import Blobs
from graphface.report.compare.embed import inert, layer, message, page, texts
from graphface.values.picture import Picture


class TestInert:
    @pytest.mark.parametrize("text", ["</script>", "<!--", "\u2028", "]]>", "<SCRIPT>", "\\", '"'])
    def test_comes_back(self, text: str) -> None:
        """No "<" stands in it, and JSON reads what was written."""
        written = inert({"text": text})
        assert "<" not in written
        assert json.loads(written)["text"] == text

    def test_numbers_that_json_has_not(self) -> None:
        """NaN would make a page that no browser reads: it is refused."""
        with pytest.raises(ValueError, match="JSON compliant"):
            inert(float("nan"))


def test_page_loads_nothing() -> None:
    """The policy names the one script by its hash and forbids all else."""
    text = page("<title>", "<p></p>", styles=[], scripts=["1;"], data={"held": [1]})
    assert "<title>&lt;title&gt;</title>" in text
    assert re.search(r"default-src 'none'; img-src data:; .*script-src 'sha256-[\w+/=]+'\"", text)
    assert json.loads(re.findall(r'id="held">(.*?)</script>', text)[0]) == [1]


def test_layer() -> None:
    """A picture with its values is described so that the viewer can read them; a drawing without has none."""
    blobs = Blobs()
    pixels = np.zeros((2, 3, 3), np.uint8)
    made = layer(blobs.sheet("", "Grid", Picture(pixels, "note", np.ones((2, 3)), full=(20, 30))), "A")
    assert (made["label"], made["note"], made["width"], made["full"]) == ("A", "note", 3, [20, 30])
    assert [len(texts(blobs)[index]) > 0 for index in made["data"]["planes"]] == [True]
    assert "data" not in layer(blobs.sheet("", "Grid", Picture(pixels)), "B")
    assert message("C", "why")["message"] == "why"
