"""The page is one file that loads nothing, and in which no text becomes markup."""

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from toys import toy_registry

from graphface import Evaluator, UsageError, load
from graphface.report.page.html import check_report, embedded, report_page
from graphface.report.recorder import Recorder

HOSTILE = "</script><img src=x onerror=alert(1)><!--"


def page_of(name: str) -> str:
    graph = load({"graphface": 1, "name": name, "nodes": {"n": {"use": "toy.circle"}}}, registry=toy_registry())
    evaluator = Evaluator()
    recorder = Recorder(evaluator.find, 32)
    evaluator.run(graph.request({}, ["n"]), [recorder])
    return report_page(recorder)


class Tags(HTMLParser):
    """The elements of a page, and what they refer to."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.names: list[str] = []
        self.links: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.append(tag)
        self.links += [value or "" for name, value in attrs if name in ("src", "href") and tag != "image"]


def test_alone() -> None:
    """It refers to nothing outside itself, and its policy forbids loading anything."""
    page = page_of("plain")
    tags = Tags(page)
    assert not tags.links
    assert "link" not in tags.names
    assert "default-src 'none'" in page
    assert not re.search(r"\b(?:https?:)?//(?!www\.w3\.org/)[a-z]", re.sub(r"//.*", "", page.split("<script")[0]))


def test_hostile_name() -> None:
    """A name of tags gives the same elements as a plain one."""
    assert Tags(page_of(HOSTILE)).names == Tags(page_of("plain")).names


@pytest.mark.parametrize("text", [HOSTILE, "&lt;", "<!--<script>", "\u2028]]>"])
def test_embedded(text: str) -> None:
    """JSON inside an element has no character that markup is made of."""
    assert not set(embedded({text: [text]})) & set("<>&")


def test_check(tmp_path: Path) -> None:
    """A report that could not be written is refused before anything runs."""
    check_report(tmp_path / "run.html")
    for path in (tmp_path / "run.txt", tmp_path / ("x" * 300) / "run.html", tmp_path):
        with pytest.raises(UsageError):
            check_report(path)
