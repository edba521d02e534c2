"""The run inside a report is what `--trace` writes."""

from pathlib import Path

import pytest
from toys import toy_registry

from graphface import Evaluator, UnreadableFile, load
from graphface.report.page.html import write_report
from graphface.report.page.read import read_report
from graphface.report.recorder import Recorder


def test_run(tmp_path: Path) -> None:
    """Document, inputs and nodes come back, whatever their texts hold."""
    text = 'graphface: 1\nname: "</script><!--"\nnodes: {n: {use: toy.number}}\n'
    evaluator = Evaluator()
    recorder = Recorder(evaluator.find, 32)
    evaluator.run(load(text, registry=toy_registry()).request({}, ["n"]), [recorder])
    write_report(recorder, tmp_path / "run.html")
    run = read_report(tmp_path / "run.html")
    assert run == recorder.trace.as_json()
    assert load(run["document"], registry=toy_registry()).name == "</script><!--"
    assert run["nodes"][0]["value"] == "1.0"


@pytest.mark.parametrize(
    "content", [b"<p>no report</p>", b"\xff\xfe", b'<script type="application/json" id="run">{</script>']
)
def test_no_report(tmp_path: Path, content: bytes) -> None:
    """Other files are refused, and so is one that is not there."""
    (tmp_path / "page.html").write_bytes(content)
    for name in ("page.html", "absent.html"):
        with pytest.raises(UnreadableFile):
            read_report(tmp_path / name)
