"""What all figures of pictures promise: the truth is perfect, worse is worse, and what is compared has one size."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes import metrics
from graphface.nodes.color import decode_srgb
from graphface.nodes.metrics.comparison import masked_mean
from graphface.nodes.types import (
    Image,
)

HIGHER = {metrics.psnr: 120, metrics.si_psnr: 120, metrics.ssim: 1, metrics.ms_ssim: 1}


LOWER = {metrics.si_mse: 0, metrics.lmse: 0}


SCALE_FREE = (metrics.si_psnr, metrics.si_mse, metrics.lmse)


@pytest.fixture
def picture(rng):
    return rng.random((60, 50, 3)).astype(np.float32)


class TestEveryFigure:
    @pytest.mark.parametrize("metric", [*HIGHER, *LOWER], ids=lambda m: m.__name__)
    def test_the_truth_is_perfect(self, metric, picture):
        """A picture compared with itself gets the best figure there is."""
        assert metric(picture, picture) == pytest.approx({**HIGHER, **LOWER}[metric], abs=1e-6)

    @pytest.mark.parametrize("metric", [*HIGHER, *LOWER], ids=lambda m: m.__name__)
    def test_more_noise_is_worse(self, metric, picture, rng):
        """Figures order results."""
        noise = rng.normal(size=picture.shape).astype(np.float32)
        little, much = (metric(picture + level * noise, picture) for level in (0.02, 0.2))
        assert little > much if metric in HIGHER else little < much

    @pytest.mark.parametrize("metric", SCALE_FREE, ids=lambda m: m.__name__)
    def test_exposure_does_not_matter(self, metric, picture):
        """A gain on the result leaves scale-invariant figures alone."""
        spoilt = picture + 0.1 * picture[::-1]
        assert metric(3 * spoilt, picture) == pytest.approx(metric(spoilt, picture), rel=1e-4)

    @pytest.mark.parametrize("metric", [*HIGHER, *LOWER], ids=lambda m: m.__name__)
    def test_off_the_mask_nothing_counts(self, metric, picture):
        """Damage far outside of the mask leaves the figure perfect."""
        mask = np.zeros(picture.shape[:2], np.float32)
        mask[:20] = 1
        spoilt = picture.copy()
        spoilt[50:] = 0
        exact = metric is not metrics.ms_ssim  # its coarse scales look further than 30 pixels
        assert metric(spoilt, picture, mask) == pytest.approx({**HIGHER, **LOWER}[metric], abs=1e-6 if exact else 0.2)

    @settings(max_examples=30, deadline=None)
    @given(arrays(np.float32, (13, 9), elements=st.floats(-10, 10, width=32)), st.sampled_from([*HIGHER, *LOWER]))
    def test_finite_on_anything(self, values, metric):
        """Black, flat and wild maps get finite figures, also against black."""
        for truth in (values, np.zeros_like(values)):
            assert np.isfinite(metric(values, truth))


class TestComparableArrays:
    def test_encodings_are_brought_together(self, picture):
        """A linear result is compared with an encoded truth as encoded."""
        linear = Image(decode_srgb(picture), encoding="linear")
        assert metrics.psnr(linear, Image(picture)) > 100

    def test_sizes_must_agree(self, picture):
        """The message shows both."""
        with pytest.raises(ValueError, match=r"60, 50, 3.*30, 50, 3"):
            metrics.ssim(Image(picture), Image(picture[:30]))


class TestMaskedMean:
    def test_weighs_pixels(self):
        """Channels of a pixel count alike."""
        values = np.array([[[1.0, 3.0], [10.0, 20.0]]])
        assert masked_mean(values, np.float32([[1, 0]])) == pytest.approx(2)
        assert masked_mean(values, None) == pytest.approx(8.5)

    def test_an_empty_mask_is_finite(self):
        """There is no error where there is nothing."""
        assert masked_mean(np.ones((2, 2)), np.zeros((2, 2), np.float32)) == 0
