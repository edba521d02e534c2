"""`graphface models relief`: a flattened model gets back what heads with known normals show, unseen ones included."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.storage import load_model, save_model


def flat_model(folder: Path) -> Path:
    """The built-in face, as coarse as it is in its file, with four fifths of its depth."""
    from graphface.nodes.morphable import builtin

    coarse = load_model(Path(builtin.__file__).with_name("builtin.safetensors"), refine=False)
    path = folder / "flat.safetensors"
    save_model(replace(coarse, mean=coarse.mean * np.float32([1, 1, 0.8])), path)
    return path


class TestRelief:
    def test_no_heads(self, command, tmp_path):
        """A folder without them is named, and nothing is written."""
        said = command(
            "models", "relief", flat_model(tmp_path), "--data", tmp_path, "--out", tmp_path / "out.safetensors"
        )
        assert said.code == 2
        assert "holds no heads" in said.err
        assert not (tmp_path / "out.safetensors").exists()

    def test_heads_that_took_no_part_gain(self, command, networks, shared, tmp_path):
        """Learned from the others, the relief brings each head's normals nearer to the truth."""
        out = tmp_path / "out.safetensors"
        said = command("models", "relief", flat_model(tmp_path), "--data", shared, "--out", out)
        before, after, unseen = (float(n) for n in re.findall(r"([\d.]+) degrees", said.out))
        assert after < unseen < before - 1
        assert len(load_model(out).mean) == len(builtin_model().mean)
