"""The small U-Net in PyTorch, and its weights for NumPy."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.learning.unet_training import folded, trainable
from graphface.nodes.unet import unet


class TestFolded:
    def test_numpy_says_the_same(self, rng):
        """With batch normalization folded in, the weights give what the network in PyTorch gives."""
        torch = pytest.importorskip("torch", reason="training needs PyTorch: pip install 'graphface[learn]'")
        net = trainable(8, (4, 6, 8))
        cells = rng.normal(size=(2, 8, 16, 12)).astype(np.float32)
        net.train()(torch.from_numpy(cells))  # moves the running means away from 0
        expected = net.eval()(torch.from_numpy(cells))[0].detach().numpy().transpose(1, 2, 0)
        weights = {name: values.astype(np.float32) for name, values in folded(net.state_dict()).items()}
        found = unet(np.ascontiguousarray(cells[0].transpose(1, 2, 0)), weights, 3)
        np.testing.assert_allclose(found, expected, atol=5e-3)
