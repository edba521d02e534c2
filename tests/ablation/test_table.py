"""The table of an ablation, as CSV and Markdown."""

import csv
import io

from graphface.ablation.running import Ablation
from graphface.ablation.table import as_csv, as_markdown, columns, rows, shown


class TestTable:
    def test_csv(self, numbers: Ablation) -> None:
        """A line for each variant, under one header."""
        lines = list(csv.DictReader(io.StringIO(as_csv(numbers))))
        assert [line["variant"] for line in lines] == ["toy.add", "toy.subtract"]
        assert lines[1]["shared nodes"] == "2 of 3"

    def test_markdown(self, numbers: Ablation) -> None:
        """The same rows, and the sentence on sharing under them."""
        text = as_markdown(numbers)
        assert text.startswith("| " + " | ".join(columns(numbers)) + " |\n| --- | ---: |")
        assert text.endswith(f"{numbers.sharing}.\n")

    def test_times(self, numbers: Ablation) -> None:
        """In milliseconds, the mean over cases."""
        assert [row["alone ms"] for row in rows(numbers)] == [1e3 * cell.alone for cell in numbers.cells]

    def test_shown(self) -> None:
        """Four digits are enough to read."""
        assert (shown(1.23456), shown("2 of 3"), shown(0)) == ("1.235", "2 of 3", "0")
