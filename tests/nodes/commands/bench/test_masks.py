"""`graphface bench masks` on one small head and photo."""

from __future__ import annotations

import pytest

from graphface.nodes.io.image_write import write_picture


class TestBenchMasks:
    @pytest.mark.parametrize(
        ("options", "words"),
        [
            (("--labels", "clasify"), "--labels 'clasify': expected classify"),
            (("--matting", "nothing"), "--matting 'nothing': expected none"),
            (("--light", "left54"), "--light 'left54': expected frontal"),
            (("--labels", "cue", "--weights", "x"), "--weights goes with"),
            (("--data", "nowhere"), "holds no heads"),
        ],
    )
    def test_wrong_request(self, command, options, words):
        """Nothing is run, and the message says what there is."""
        said = command("bench", "masks", *options)
        assert said.code == 2
        assert words in said.err

    @pytest.mark.parametrize("labels", ["classify", "cue", "detector"])
    def test_heads(self, command, heads, labels):
        """For the head and on average: overlap and edge of each label, memory, time, and its ratio to the labels'."""
        said = command("bench", "masks", "--data", heads, "--matting", "guided", "--labels", labels)
        assert said.code == 0, said.err
        head, mean = (line.split() for line in said.out.splitlines()[1:3])
        assert head[:2] == ["guided", "gt01"]
        assert head[2:9] == mean[2:9]
        assert all(0 <= float(overlap) <= 1 for overlap in head[2:8:2])
        assert float(head[9]) > 0
        assert "labels before matting" in said.out

    def test_noise(self, command, face, tmp_path):
        """Overlap of each label with itself, the worst, and the time."""
        write_picture(face, tmp_path / "me.png")
        said = command("bench", "masks", "--noise", tmp_path / "me.png")
        assert said.code == 0, said.err
        *overlaps, worst, spent = map(float, said.figures("me"))
        assert min(overlaps) == worst
        assert float(spent) > 0
        assert "of 1 photos below 0.98" in said.out
