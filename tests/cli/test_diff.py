"""`graphface diff` says which node differs first, writes a page, and has the exit codes of diff."""

from collections.abc import Callable
from pathlib import Path

import pytest
from toys import toy_registry

from graphface import Evaluator, MemoryTier, load
from graphface.report.difference.side import Side
from graphface.report.trace import Trace
from graphface.values.value_file import write_value

Run = Callable[..., object]


@pytest.fixture
def diff(graphface: Callable[..., object], plugin: list[str]) -> Run:
    return lambda *arguments: graphface("diff", *plugin, "--output", "scaled", *arguments)


@pytest.fixture
def golden(graph: Path, tmp_path: Path) -> Path:
    """Known-good values of output `scaled`, as `run --dump` writes them."""
    folder = tmp_path / "good"
    folder.mkdir()
    trace, evaluator = Trace(), Evaluator(memory=MemoryTier())
    asked = load(graph, registry=toy_registry()).request({}, ["scaled"])
    evaluator.run(asked, [trace])
    side = Side(asked, evaluator, trace.records)
    for name in side.needed:
        write_value(side.value(name), folder / f"{name}.npz")
    trace.write_to(folder / "run.json")
    return folder


class TestTwoGraphs:
    def test_equal(self, diff: Run, graph: Path) -> None:
        """Exit code 0, and a sentence."""
        said = diff(graph, graph)
        assert said.code == 0
        assert "no node of 2 differs" in said.out

    def test_differing(self, diff: Run, graph: Path) -> None:
        """Exit code 1; the node that was changed, by what, by how much, and the table."""
        said = diff(graph, f"{graph} --set s.by=4")
        assert said.code == 1
        assert "first difference: s (toy.scale)" in said.out
        assert "parameter by changed from 3.0 to 4.0" in said.out
        assert "by up to 1 of a range of 3" in said.out

    def test_flags_outside_are_for_both(self, diff: Run, graph: Path) -> None:
        """As --set here."""
        assert diff(graph, graph, "--set", "s.by=4").code == 0
        assert diff(graph, f"{graph} --profile draft").code == 1

    def test_page(self, diff: Run, graph: Path, tmp_path: Path) -> None:
        """-o writes it."""
        said = diff(graph, f"{graph} --set s.by=4", "-o", tmp_path / "d.html")
        assert f"wrote {tmp_path / 'd.html'}" in said.out
        assert "parameter by changed" in (tmp_path / "d.html").read_text(encoding="utf-8")

    def test_inputs(self, graphface: Callable[..., object], plugin: list[str], graph: Path) -> None:
        """-i is for both sides, in the quotes for one: the other keeps its default."""
        asked = ("diff", *plugin, "--output", "unused")
        assert graphface(*asked, graph, graph, "-i", "x=3").code == 0
        assert graphface(*asked, graph, f"{graph} -i x=2").code == 0
        assert graphface(*asked, graph, f"{graph} -i x=3").code == 1
        said = graphface(*asked, f"{graph} -i x=2", f"{graph} -i x=3")
        assert (said.code, "input x changed" in said.out) == (1, True)

    def test_failure(self, graphface: Callable[..., object], plugin: list[str], graph: Path) -> None:
        """A node that fails on one side is a difference, with its message; on both it is no success either."""
        asked = ("diff", *plugin, "--output", "bad")
        said = graphface(*asked, graph, f"{graph} --replace bad=toy.add")
        assert (said.code, "A: ValueError: it broke" in said.out) == (1, True)
        both = graphface(*asked, graph, graph)
        assert (both.code, "fails on both sides: ValueError: it broke" in both.out) == (1, True)


class TestEarlierRuns:
    def test_trace(
        self, graphface: Callable[..., object], diff: Run, graph: Path, plugin: list[str], tmp_path: Path
    ) -> None:
        """A run.json stands for its graph and inputs."""
        where = tmp_path / "run.json"
        graphface("run", graph, *plugin, "-o", f"scaled={tmp_path / 's.npy'}", "--trace", where)
        assert diff(where, graph).code == 0
        said = diff(where, f"{graph} --set s.by=4")
        assert (said.code, "parameter by changed from 3.0 to 4.0" in said.out) == (1, True)


class TestGolden:
    def test_round_trip(self, diff: Run, graph: Path, golden: Path) -> None:
        """Exit code 0 where nothing is beyond the tolerance."""
        said = diff(graph, "--golden", golden)
        assert (said.code, "no node of 2 differs" in said.out) == (0, True)

    def test_beyond(self, diff: Run, graph: Path, golden: Path, tmp_path: Path) -> None:
        """Exit code 1 and the first that goes wrong; a page has both pictures."""
        said = diff(f"{graph} --set s.by=3.1", "--golden", golden, "-o", tmp_path / "g.html")
        assert (said.code, "first difference: s (toy.scale)" in said.out) == (1, True)
        assert "known good" in (tmp_path / "g.html").read_text(encoding="utf-8")

    def test_tolerances(self, diff: Run, graph: Path, golden: Path) -> None:
        """A share of the range, or an absolute one."""
        asked = (f"{graph} --set s.by=3.1", "--golden", golden)
        assert diff(*asked, "--tolerance", "0.5").code == 0
        assert diff(*asked, "--absolute", "0.11").code == 0
        assert diff(*asked, "--absolute", "0.09").code == 1


class TestMistakes:
    @pytest.mark.parametrize(
        ("arguments", "said"),
        [
            (["{graph}"], "expected two sides"),
            (["{graph}", "{graph}", "{graph}"], "expected two sides"),
            (["{graph}", "{graph}", "--golden", "x"], "expected one graph beside --golden"),
            (["{graph}", "{graph} --sett s.by=1"], "unrecognized arguments: --sett"),
            (["{graph}", "{graph} 'open"], "No closing quotation"),
            (["{graph}", "nowhere.json"], "nowhere.json"),
            (["{graph}", "nowhere.yaml"], "nowhere.yaml"),
            (["{graph}", "{graph}", "-i", "z=1"], "no side has such an input"),
            (["{graph}", "--golden", "nowhere"], "nowhere"),
            (["{graph}", "{graph}", "-o", "{graph}/d.html"], "cannot be written"),
            (["{graph}", "{graph}", "--tolerance", "1", "--absolute", "1"], "give one of them"),
            (["{graph}", "{graph}", "--guard", "maybe"], "expected off, warn or error"),
        ],
    )
    def test_are_answered_in_a_sentence(self, diff: Run, graph: Path, arguments: list[str], said: str) -> None:
        """Exit code 2 and what was expected."""
        answer = diff(*(text.replace("{graph}", str(graph)) for text in arguments))
        assert answer.code == 2
        assert said in answer.err
