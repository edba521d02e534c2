"""The table of an ablation, as CSV and Markdown."""

from __future__ import annotations

import csv
import io

from graphface.ablation import ablate
from graphface.ablation.page import write_page
from graphface.ablation.sheet import write_sheet
from graphface.ablation.table import as_csv, as_markdown

GRAPH = """
graphface: 1
name: sum
inputs: {x: float}
nodes:
  start: {use: toy.add, in: {a: x}, with: {plus: 1.0, label: start}}
  middle: {use: toy.add, in: {a: start}, with: {label: middle}}
  last: {use: toy.add, in: {a: middle, b: x}, with: {label: last}}
outputs: {y: last}
"""


class TestReports:
    def test_table(self, registry):
        """CSV has a line for each variant; Markdown the same and the sentence on sharing."""
        done = ablate(GRAPH, ["last=add,subtract"], [{"x": 2.0}], loading={"registry": registry})
        lines = list(csv.DictReader(io.StringIO(as_csv(done))))
        assert [line["variant"] for line in lines] == ["toy.add", "toy.subtract"]
        assert lines[1]["shared nodes"] == "2 of 3"
        assert done.sharing in as_markdown(done)

    def test_page_and_sheet_of_values_without_pictures(self, registry, tmp_path):
        """Numbers have no picture; the page is written with its table, the sheet says so."""
        done = ablate(GRAPH, ["last=add,subtract"], [{"x": 2.0}], loading={"registry": registry})
        write_page(done, tmp_path / "index.html")
        write_sheet(done, tmp_path / "sheet.png")
        text = (tmp_path / "index.html").read_text(encoding="utf-8")
        assert text.count("<tr data-v=") == 2
        assert (tmp_path / "sheet.png").stat().st_size > 0
