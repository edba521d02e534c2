"""One graph over many inputs: every combination, what they share computed once, failures told and survived."""

from pathlib import Path

import numpy as np
import pytest
import toys

from graphface import Evaluator, MemoryTier, Registry, load
from graphface.cli import main
from graphface.errors import InputError, UnreadableFile, UsageError
from graphface.evaluate.mapping import read_map, read_maps, run_over

PAIRS = """graphface: 1
inputs: {x: float, y: float}
nodes:
  left: {use: toy.add, in: {a: x}, with: {label: left}}
  right: {use: toy.add, in: {a: y}, with: {label: right}}
  both: {use: toy.add, in: {a: left, b: right}, with: {label: both}}
outputs: {sum: both}
"""


GRID = """graphface: 1
inputs: {a: Path, b: Path}
nodes:
  first: {use: toy.same, in: {value: a}}
  second: {use: toy.same, in: {value: b}}
  grid: {use: toy.grid}
  number: {use: toy.number}
  broken: {use: toy.fail, in: {a: number}}
outputs: {grid: grid}
"""


@pytest.fixture
def pairs(registry: Registry):
    return load(PAIRS, registry=registry)


class TestRunOver:
    def test_every_combination(self, pairs):
        """The last input varies fastest, and every combination is made."""
        made = run_over(pairs, Evaluator(), {"x": [1.0, 2.0], "y": [10.0, 20.0]}, {}, pairs.outputs)
        assert [m.result["sum"] for m in made] == [11, 21, 12, 22]

    def test_what_is_common_is_computed_once(self, pairs, ran: list[str]):
        """Ten values by ten values compute ten and ten halves and a hundred sums."""
        values = [float(n) for n in range(10)]
        others = [n + 100 for n in values]
        made = list(run_over(pairs, Evaluator(memory=MemoryTier()), {"x": values, "y": others}, {}, pairs.outputs))
        assert len(made) == 100
        assert {label: ran.count(label) for label in ("left", "right", "both")} == {
            "left": 10,
            "right": 10,
            "both": 100,
        }

    def test_no_map_is_one_run(self, pairs):
        """Without anything to map over there is one combination: the given inputs."""
        made = list(run_over(pairs, Evaluator(), {}, {"x": 1.0, "y": 2.0}, pairs.outputs))
        assert [m.result["sum"] for m in made] == [3]

    def test_a_failure_does_not_stop_the_others(self, pairs):
        """A value that does not fit fails its own combinations alone."""
        made = list(run_over(pairs, Evaluator(), {"x": [1.0, "one"], "y": [2.0]}, {}, pairs.outputs))
        assert made[0].result["sum"] == 3
        assert isinstance(made[1].error, InputError)
        assert made[1].result is None

    def test_unknown_input(self, pairs):
        """Mapping over an input that is not there names the nearest one."""
        with pytest.raises(InputError) as caught:
            list(run_over(pairs, Evaluator(), {"xx": [1.0]}, {}, pairs.outputs))
        assert caught.value.nearest == ["x"]

    def test_both_given_and_mapped(self, pairs):
        """An input is either given or mapped over."""
        with pytest.raises(InputError, match="both"):
            list(run_over(pairs, Evaluator(), {"x": [1.0]}, {"x": 2.0, "y": 1.0}, pairs.outputs))


class TestReadMap:
    @pytest.fixture
    def folder(self, tmp_path: Path) -> Path:
        for name in ("b.png", "a.jpg", ".hidden", "c.png"):
            (tmp_path / name).touch()
        (tmp_path / "inner").mkdir()
        return tmp_path

    def test_a_folder(self, folder: Path):
        """Files by name; folders and hidden files are left out."""
        name, files = read_map(f"photo={folder}")
        assert name == "photo"
        assert [Path(f).name for f in files] == ["a.jpg", "b.png", "c.png"]

    def test_a_pattern(self, folder: Path):
        """A pattern picks among a folder's files."""
        assert [Path(f).name for f in read_map(f"photo={folder}/*.png")[1]] == ["b.png", "c.png"]

    @pytest.mark.parametrize("text", ["photo", "photo=", "=there"])
    def test_another_form(self, text: str):
        """What is not NAME=WHERE is refused."""
        with pytest.raises(UsageError, match="NAME=FOLDER"):
            read_map(text)

    @pytest.mark.parametrize("where", ["missing", "inner", "*.gif"])
    def test_nothing_there(self, folder: Path, where: str):
        """A missing or empty folder and a pattern without a match name the place."""
        with pytest.raises(UnreadableFile, match="photo"):
            read_map(f"photo={folder / where}")

    def test_twice(self, folder: Path):
        """An input is mapped once."""
        with pytest.raises(UsageError, match="twice"):
            read_maps([f"x={folder}", f"x={folder}"])

    @pytest.mark.parametrize("where", ["", "/*.png"])
    def test_may_not_be_looked_into(self, folder: Path, where: str, monkeypatch: pytest.MonkeyPatch) -> None:
        """A folder that the operating system closes is told as such."""

        def denied(path: Path, *_: object) -> None:
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr(Path, "iterdir", denied)
        monkeypatch.setattr(Path, "glob", denied)
        with pytest.raises(UnreadableFile, match="Permission denied"):
            read_map(f"photo={folder}{where}")


class TestCommand:
    """`graphface run --map NAME=FOLDER`."""

    @pytest.fixture
    def run(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
        for folder, names in (("lefts", "ab"), ("rights", "xyz")):
            (tmp_path / folder).mkdir()
            for name in names:
                np.save(tmp_path / folder / f"{name}.npy", np.zeros(1))
        (tmp_path / "g.yaml").write_text(GRID)

        def command(*arguments: str) -> tuple[int, str]:
            maps = ["--map", f"a={tmp_path / 'lefts'}", "--map", f"b={tmp_path / 'rights'}"]
            with pytest.raises(SystemExit) as left:
                main(["run", str(tmp_path / "g.yaml"), "--plugin", toys.__file__, *maps, *arguments])
            return int(left.value.code or 0), capsys.readouterr().err

        return command

    def test_a_file_for_each(self, run, tmp_path: Path):
        """Every combination is written under the names of its inputs."""
        code, _ = run("-o", f"{tmp_path}/{{a}}-{{b}}.npz")
        assert code == 0
        assert {p.stem for p in tmp_path.glob("*.npz")} == {"a-x", "a-y", "a-z", "b-x", "b-y", "b-z"}

    def test_the_same_file_twice(self, run, tmp_path: Path):
        """An output that does not name every mapped input is refused before anything runs."""
        code, said = run("-o", f"{tmp_path}/{{a}}.npz")
        assert code == 2
        assert "{a} {b}" in said
        assert not list(tmp_path.glob("*.npz"))

    def test_failures_are_told_at_the_end(self, run, tmp_path: Path):
        """The exit code says that some failed, and how many."""
        code, said = run(
            "-o",
            f"{tmp_path}/{{a}}-{{b}}.npz",
            "--set",
            "broken.message=no",
            "-o",
            f"broken={tmp_path}/f{{a}}{{b}}.npz",
        )
        assert code == 1
        assert "6 of 6" in said

    def test_no_trace(self, run, tmp_path: Path):
        """A trace follows a single run."""
        assert run("-o", f"{tmp_path}/{{a}}-{{b}}.npz", "--trace", f"{tmp_path}/t.json")[0] == 2
