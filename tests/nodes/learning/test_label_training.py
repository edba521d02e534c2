"""Training of the label network."""

from __future__ import annotations

import builtins

import numpy as np
import pytest
from drawn import PICTURE

from graphface import UsageError
from graphface.nodes.learning.label_learning import examples_of
from graphface.nodes.learning.label_training import trained
from graphface.nodes.learning.unet_training import folded, trainable
from graphface.nodes.masks.label_network import WIDTHS, label_scores
from graphface.nodes.masks.network_input import CHANNELS


class TestTrained:
    def test_needs_torch(self, monkeypatch):
        """Without PyTorch the message says what to install."""

        def without(name, *rest, **more):
            if name == "torch":
                raise ImportError(name)
            return imported(name, *rest, **more)

        imported = builtins.__import__
        monkeypatch.setattr(builtins, "__import__", without)
        with pytest.raises(UsageError, match="pip install torch"):
            trained(examples_of([(PICTURE, 1)], [PICTURE], 0), steps=1)

    def test_learns(self):
        """The trained network and the NumPy one give the same scores."""
        torch = pytest.importorskip("torch", reason="training needs PyTorch")
        examples = examples_of([(PICTURE, 16)], [PICTURE], 0)
        state = trained(examples, steps=20)
        net = trainable(CHANNELS, WIDTHS)
        net.load_state_dict(state)
        cells = examples.cells[:1].astype(np.float32)
        expected = net.eval()(torch.from_numpy(cells))[0].detach().numpy().transpose(1, 2, 0)
        weights = {name: values.astype(np.float32) for name, values in folded(state).items()}
        np.testing.assert_allclose(label_scores(cells[0].transpose(1, 2, 0), weights), expected, atol=0.02)
