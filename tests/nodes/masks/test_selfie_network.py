"""Running MediaPipe's selfie segmentation."""

from __future__ import annotations

import sys
import threading

import numpy as np
import pytest
from portraits import portrait

from graphface import UsageError
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.masks import selfie_network
from graphface.nodes.masks.selfie_network import class_probabilities


class TestClassProbabilities:
    @pytest.fixture
    def one_sided(self, monkeypatch):
        """A stand-in for the network whose logits of hair grow to the right."""
        logits = np.zeros((256, 256, 6), np.float32)
        logits[..., 1] = np.linspace(-4, 4, 256, dtype=np.float32)
        monkeypatch.setattr(selfie_network, "_logits", lambda pixels: logits)

    @pytest.mark.usefixtures("one_sided")
    def test_mirrored_labels_are_averaged(self):
        """A network that prefers one side gives the same for both."""
        found = class_probabilities(portrait()[0].pixels, mirrored=True)
        np.testing.assert_allclose(found, found[:, ::-1], atol=1e-6)

    @pytest.mark.usefixtures("one_sided")
    def test_inverse_temperature(self):
        """A larger factor makes the probabilities more certain."""
        pixels = portrait()[0].pixels
        soft, hard = (class_probabilities(pixels, False, inverse_temperature=factor) for factor in (1.0, 3.0))
        np.testing.assert_allclose(soft.sum(axis=2), 1, atol=1e-5)
        assert hard[0, -1, 1] > soft[0, -1, 1]
        assert hard[0, 0, 1] < soft[0, 0, 1]

    def test_without_litert(self, monkeypatch):
        """Without the extra the message says what to install."""
        monkeypatch.setattr(selfie_network, "_threads", threading.local())
        monkeypatch.setitem(sys.modules, "ai_edge_litert.interpreter", None)
        with pytest.raises(UsageError, match=r"pip install 'graphface\[network\]'"):
            class_probabilities(portrait()[0].pixels, mirrored=False)

    def test_prints_nothing(self, capfd, monkeypatch):
        """LiteRT's messages do not reach the terminal."""
        pytest.importorskip("ai_edge_litert.interpreter", reason="needs pip install 'graphface[network]'")
        monkeypatch.setattr(selfie_network, "_threads", threading.local())
        try:
            class_probabilities(portrait()[0].pixels, mirrored=False)
        except AssetUnavailable as error:
            pytest.skip(str(error))
        assert capfd.readouterr() == ("", "")
