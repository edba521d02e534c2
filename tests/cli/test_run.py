"""`graphface run` writes what was asked for, or says in a line why not, and leaves nothing half-written."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from interrupts import HEARD
from PIL import Image

Run = Callable[..., object]


@pytest.fixture
def run(graphface: Callable[..., object], graph: Path, plugin: list[str]) -> Run:
    return lambda *arguments: graphface("run", graph, *plugin, *arguments)


class TestWriting:
    def test_first_output(self, run: Run, tmp_path: Path) -> None:
        """A bare file is the graph's first output."""
        assert run("-o", tmp_path / "a.npy").code == 0
        np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), np.full((4, 4), 3.0))

    def test_any_node(self, run: Run, tmp_path: Path) -> None:
        """Any node can be asked for by name, several at once."""
        assert run("-o", f"g={tmp_path / 'g.npy'}", "-o", f"scaled={tmp_path / 's.npy'}").code == 0
        assert np.load(tmp_path / "g.npy").max() == 1

    def test_settings(self, run: Run, tmp_path: Path) -> None:
        """Flags reach the graph."""
        run("-o", tmp_path / "a.npy", "--profile", "draft", "--set", "s.by=7")
        np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), np.full((2, 2), 7.0))

    def test_replaces_a_file(self, run: Run, tmp_path: Path) -> None:
        """A file that is there is replaced as a whole."""
        (tmp_path / "a.npy").write_text("old")
        assert run("-o", tmp_path / "a.npy").code == 0
        assert np.load(tmp_path / "a.npy").shape == (4, 4)

    def test_nothing_beside(self, run: Run, tmp_path: Path) -> None:
        """No temporary file is left."""
        run("-o", tmp_path / "a.npy")
        assert sorted(p.name for p in tmp_path.iterdir()) == ["a.npy", "g.yaml"]

    def test_times(self, run: Run, tmp_path: Path) -> None:
        """`--times` tells every node that ran, and no other."""
        said = run("-o", tmp_path / "a.npy", "--times")
        assert "toy.scale" in said.out
        assert "toy.add" not in said.out

    def test_guard_warn(self, run: Run, tmp_path: Path) -> None:
        """With `--guard warn` the value is written and a warning said."""
        said = run("-o", f"nan={tmp_path / 'n.npy'}", "--guard", "warn")
        assert said.code == 0
        assert "warning: nan" in said.err

    def test_name_from_an_input(self, run: Run, tmp_path: Path) -> None:
        """{x} in a file name is an input's name, and cannot lead out of the folder."""
        assert run("-i", "x=3", "-o", tmp_path / "out" / "{x}.npy").code == 0
        assert (tmp_path / "out" / "3.npy").is_file()


class TestRefused:
    """Exit code 2: the request is wrong, and nothing was run."""

    @pytest.mark.parametrize(
        ("arguments", "said"),
        [
            ((), "no output"),
            (("-o", "g.yaml/a.npy"), "a file has the name of one of its folders"),
            (("-o", "scaled=a.npy", "-o", "s=a.npy"), "would be written to this one file"),
            (("-o", "g.yaml"), "no Grid can be written as '.yaml'"),
            (("-o", "a"), "has no suffix"),
            (("-o", "image="), "NAME=FILE"),
            (("-o", ""), "NAME=FILE"),
            (("-o", "a.npy", "-o", "a.npy"), "twice"),
            (("-o", "a.npy", "-i", "x=1", "-i", "x=2"), "given twice"),
            (("-o", "zzz=a.npy"), "zzz"),
            (("-o", "a.npy", "-i", "y=1"), "'y'"),
            (("-o", "a.npy", "-i", "x"), "NAME=VALUE"),
            (("-o", "unused=a.npz", "-i", "x=red"), "'x'"),
            (("-o", "a.npy", "--set", "s.byy=1"), "did you mean 'by'"),
            (("-o", "a.npy", "--set", "s.by=red"), "'by'"),
            (("-o", "a.npy", "--set", "sby"), "--set"),
            (("-o", "a.npy", "--replace", "s"), "--replace"),
            (("-o", "a.npy", "--profile", "draf"), "did you mean 'draft'"),
            (("-o", "a.npy", "--variant", "v"), "'v'"),
            (("-o", "a.npy", "--guard", "maybe"), "--guard"),
            (("-o", "a.npy", "--plugin", "none.py"), "none.py"),
            (
                (
                    "-o",
                    "{zz}.npy",
                ),
                "'zz'",
            ),
            (("--threads", "-1", "-o", "a.npy"), "--threads"),
            (("--nonsense",), "--nonsense"),
        ],
    )
    def test_request(
        self, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], said: str
    ) -> None:
        """What is wrong with it is said in few lines."""
        monkeypatch.chdir(tmp_path)
        answer = run(*arguments)
        assert answer.code == 2
        assert said in answer.err
        assert sorted(p.name for p in tmp_path.iterdir()) == ["g.yaml"]

    def test_unknown_graph(self, graphface: Callable[..., object], tmp_path: Path) -> None:
        """A graph that is not there is named, in one line."""
        answer = graphface("run", tmp_path / "none.yaml", "-o", "a.npy")
        assert answer.code == 2
        assert "none.yaml" in answer.err
        assert len(answer.err.strip().splitlines()) == 1

    def test_nearly_a_shipped_graph(self, graphface: Callable[..., object]) -> None:
        """A shipped graph that may have been meant is named."""
        assert "did you mean 'relight'" in graphface("run", "relihgt", "-o", "a.npy").err

    def test_a_mapped_file_is_kept(self, run: Run, tmp_path: Path) -> None:
        """Nor is a result written over one of the files that a graph is mapped over."""
        for name in ("1.npy", "2.npy"):
            (tmp_path / name).write_bytes(b"photo")
        answer = run("--map", f"x={tmp_path / '*.npy'}", "-o", tmp_path / "{x}.npy")
        assert answer.code == 2
        assert (tmp_path / "1.npy").read_bytes() == b"photo"

    def test_folder_as_file(self, run: Run, tmp_path: Path) -> None:
        """A folder cannot be the output."""
        answer = run("-o", tmp_path)
        assert answer.code == 2
        assert "is a folder" in answer.err

    @pytest.mark.skipif(os.geteuid() == 0, reason="root may write into read-only folders")
    def test_read_only_folder(self, run: Run, tmp_path: Path) -> None:
        """Nor can a file in a folder that cannot be written to."""
        folder = tmp_path / "locked"
        folder.mkdir(mode=0o500)
        answer = run("-o", folder / "a.npy")
        assert answer.code == 2
        assert "cannot be written" in answer.err

    @pytest.mark.parametrize(
        "content", [b"\xff\xfe\x00", b"\x00" * 50, b"a: [", b"[]", b"graphface: 1\nnodes: {x: {use: y.z}}"]
    )
    def test_no_graph(self, graphface: Callable[..., object], tmp_path: Path, content: bytes) -> None:
        """A file that is no graph is told with its place."""
        path = tmp_path / "bad.yaml"
        path.write_bytes(content)
        answer = graphface("run", path, "-o", "a.npy")
        assert answer.code == 2
        assert "bad.yaml" in answer.err

    def test_place_and_caret(self, graphface: Callable[..., object], tmp_path: Path, plugin: list[str]) -> None:
        """A mistake in a graph is shown with file, line, column, the line and a caret."""
        path = tmp_path / "bad.yaml"
        path.write_text("graphface: 1\nnodes:\n  x: {use: toy.number, with: {valeu: 1}}\n")
        answer = graphface("run", path, "-o", "x=a.npy", *plugin)
        assert f"{path}:3:31" in answer.err
        assert "did you mean 'value'" in answer.err
        lines = answer.err.splitlines()
        caret = next(i for i, line in enumerate(lines) if line.strip() == "^")
        assert lines[caret - 1][lines[caret].index("^") :].startswith("valeu")


class TestFailed:
    """Exit code 1: the request was understood and failed on the way."""

    def test_node(self, run: Run, tmp_path: Path) -> None:
        """A node that fails is named with its operator, place, inputs and reason."""
        answer = run("-o", f"bad={tmp_path / 'a.npz'}")
        assert answer.code == 1
        for part in ("g.yaml:8:3", "'bad'", "toy.fail", "it broke", "a: 2"):
            assert part in answer.err
        assert not (tmp_path / "a.npz").exists()

    def test_not_finite(self, run: Run, tmp_path: Path) -> None:
        """So is one that gives NaN."""
        answer = run("-o", f"nan={tmp_path / 'a.npy'}")
        assert answer.code == 1
        assert "1 non-finite of 16" in answer.err


class TestInterrupted:
    @pytest.mark.parametrize("threads", [1, 2])
    def test_control_c(self, tmp_path: Path, plugin: list[str], threads: int) -> None:
        """Ctrl-C ends with 130 and a line, after the node under way; what was computed is in the cache."""
        path, cache = tmp_path / "slow.yaml", tmp_path / "cache"
        nodes = ["  n0: {use: toy.slow, in: {a: x}}"]
        nodes += [f"  n{i}: {{use: toy.slow, in: {{a: n{i - 1}}}, with: {{seconds: 0.05}}}}" for i in range(1, 400)]
        path.write_text("graphface: 1\ninputs: {x: {type: float, default: 1}}\nnodes:\n" + "\n".join(nodes) + "\n")
        program = f"{HEARD}; import sys; from graphface.cli import main; main(sys.argv[1:])"
        arguments = ["run", str(path), *plugin, "-o", f"n399={tmp_path / 'a.npz'}", "--cache", str(cache)]
        running = subprocess.Popen(
            [sys.executable, "-c", program, *arguments, "--threads", str(threads)], stderr=subprocess.PIPE, text=True
        )
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline and len(list(cache.rglob("*"))) < 8:
            time.sleep(0.02)
        running.send_signal(signal.SIGINT)
        _, err = running.communicate(timeout=30)
        assert running.returncode == 130
        assert "Traceback" not in err
        assert "interrupted" in err
        assert sorted(p.name for p in tmp_path.iterdir()) == ["cache", "slow.yaml"]


class TestSizes:
    @pytest.mark.parametrize(("flag", "more"), [("--memory", ["--map", "x={folder}"]), ("--cache-size", [])])
    def test_no_size(self, run: Run, tmp_path: Path, flag: str, more: list[str]) -> None:
        """A size that is none names the flag; nothing is run."""
        (tmp_path / "1").write_text("")
        more = [part.format(folder=tmp_path) for part in more]
        said = run("-o", tmp_path / "{x}.npy" if more else tmp_path / "a.npy", flag, "much", "--cache", tmp_path, *more)
        assert said.code == 2
        assert said.err == f"error: {flag}: expected a size such as 2G, 500M or a number of bytes, got 'much'\n"

    def test_variable(self, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """Or the variable."""
        monkeypatch.setenv("GRAPHFACE_CACHE_SIZE", "much")
        said = run("-o", tmp_path / "a.npy", "--cache", tmp_path / "cache")
        assert (said.code, said.err.partition(":")[2].partition(":")[0].strip()) == (2, "GRAPHFACE_CACHE_SIZE")

    def test_cache_size(self, run: Run, graphface: Callable[..., object], tmp_path: Path) -> None:
        """A disk cache keeps no more than it may."""
        cache = tmp_path / "cache"
        assert run("-o", tmp_path / "a.npy", "--cache", cache, "--cache-size", "10").code == 0
        said = graphface("cache", "stats", "--cache", cache, "--cache-size", "5M")
        assert said.out.endswith("0 entries, 0.0 of 5 MB\n")

    def test_memory_without_map(self, run: Run, tmp_path: Path) -> None:
        """One run keeps nothing in memory beyond itself, so the flag would do nothing."""
        said = run("-o", tmp_path / "a.npy", "--memory", "1G")
        assert said.code == 2
        assert "--map" in said.err


class TestReport:
    def test_beside_a_trace(self, run: Run, tmp_path: Path) -> None:
        """`--report` and `--trace` tell of the same run."""
        import json

        from graphface.report.page.read import read_report

        page, trace = tmp_path / "run.html", tmp_path / "run.json"
        said = run("-o", f"{tmp_path}/s.npy", "--report", page, "--report-size", 64, "--trace", trace)
        assert said.code == 0
        assert [n["key"] for n in read_report(page)["nodes"]] == [
            n["key"] for n in json.loads(trace.read_text())["nodes"]
        ]

    def test_failed_run(self, run: Run, tmp_path: Path) -> None:
        """A run that fails writes its report, with the failure and where it is."""
        page = tmp_path / "run.html"
        assert run("-o", f"bad={tmp_path}/s.npz", "--report", page).code == 1
        assert "raise ValueError(message)" in page.read_text(encoding="utf-8")

    def test_refused(self, run: Run, tmp_path: Path) -> None:
        """A report under another suffix, or of a --map, is refused before anything runs."""
        other = run("-o", f"{tmp_path}/s.npy", "--report", tmp_path / "run.txt")
        mapped = run("-o", f"{tmp_path}/{{x}}.npy", "--map", f"x={tmp_path}", "--report", tmp_path / "run.html")
        assert (other.code, mapped.code) == (2, 2)
        assert "name it .html" in other.err
        assert "follows one run" in mapped.err
        assert not list(tmp_path.glob("*.npy"))


class TestPictures:
    def test_any_node(self, run: Run, tmp_path: Path) -> None:
        """A value whose type writes no picture is drawn."""
        assert run("-o", f"g={tmp_path / 'g.png'}").code == 0
        with Image.open(tmp_path / "g.png") as opened:
            assert opened.size == (4, 4)

    def test_number(self, run: Run, tmp_path: Path) -> None:
        """Numbers are pictures too."""
        assert run("-o", f"unused={tmp_path / 'n.webp'}").code == 0
        assert (tmp_path / "n.webp").stat().st_size

    def test_other_suffix(self, run: Run, tmp_path: Path) -> None:
        """Another suffix is refused before anything runs, and pictures are named among what can be written."""
        said = run("-o", f"g={tmp_path / 'g.bmp'}")
        assert said.code == 2
        assert "as its picture: .png" in said.err


class TestDump:
    def test_folder(self, run: Run, tmp_path: Path) -> None:
        """Every value of the run beside the outputs."""
        assert run("-o", f"scaled={tmp_path / 's.npy'}", "--dump", tmp_path / "d").code == 0
        assert {"g.npz", "g.png", "run.json"} <= {p.name for p in (tmp_path / "d").iterdir()}

    def test_with_map(self, run: Run, tmp_path: Path) -> None:
        """One run has a dump, many have none."""
        assert run("-o", tmp_path / "a.npy", "--map", f"x={tmp_path}", "--dump", tmp_path / "d").code == 2
