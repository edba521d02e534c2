"""Training of the normals network."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.normal_training import Pictures, trained
from graphface.nodes.learning.unet_training import folded, trainable
from graphface.nodes.surface.normal_network import CHANNELS, OUTPUTS, WIDTHS, corrections


class TestTrained:
    def test_learns(self, rng):
        """The loss of a few steps is finite, and the NumPy network says what the trained one says."""
        torch = pytest.importorskip("torch", reason="training needs PyTorch: pip install 'graphface[learn]'")
        seen = (rng.normal(size=(13, 128, 128, CHANNELS)) * 0.3).astype(np.float16)
        normals = np.broadcast_to(np.float16([0, 0, 1]), (13, 128, 128, 3)).copy()
        ones = np.ones((13, 128, 128), np.float16)
        pictures = Pictures(seen, normals, ones, 0 * ones, ones)
        state, figures = trained(pictures, minutes=0)
        assert figures["steps"] == 2
        assert np.isfinite(list(figures["degrees_off_kept_back"].values())).all()
        assert figures["shadows_kept_back"]["recall"] == 0
        net = trainable(4 * CHANNELS, WIDTHS, OUTPUTS).eval()
        net.load_state_dict(state)
        cells = torch.nn.functional.pixel_unshuffle(
            torch.from_numpy(seen[:1].astype(np.float32).transpose(0, 3, 1, 2)), 2
        )
        expected = net(cells)[0].detach().numpy().transpose(1, 2, 0)
        weights = {name: values.astype(np.float32) for name, values in folded(state).items()}
        change, shadow = corrections(seen[0].astype(np.float32), weights)
        np.testing.assert_allclose(change, expected[..., :3], atol=0.02)
        np.testing.assert_allclose(shadow, 1 / (1 + np.exp(-expected[..., 3])), atol=0.02)
