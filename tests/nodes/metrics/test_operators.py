"""Figures: each says 'perfect' of the truth, and ranks a worse result as worse."""

from __future__ import annotations

import json
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import graphface
from graphface.nodes import metrics
from graphface.nodes.io.judgements import read_judgements
from graphface.nodes.metrics import operators
from graphface.nodes.types import Image, Landmarks

HIGHER = {metrics.psnr: 120, metrics.si_psnr: 120, metrics.ssim: 1, metrics.ms_ssim: 1}
LOWER = {metrics.si_mse: 0, metrics.lmse: 0}
SCALE_FREE = (metrics.si_psnr, metrics.si_mse, metrics.lmse)


@pytest.fixture
def picture(rng):
    return rng.random((60, 50, 3)).astype(np.float32)


class TestPictures:
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

    def test_local_error_looks_past_slow_shading(self, picture):
        """A slow gain costs `si_mse` more than `lmse`."""
        slow = picture * np.linspace(0.5, 1.5, 50, dtype=np.float32)[None, :, None]
        assert metrics.lmse(slow, picture) < 0.5 * metrics.si_mse(slow, picture)


class TestGeometry:
    def test_iou_of_soft_masks(self):
        """Minima over maxima; two empty masks agree."""
        half = np.full((2, 2), 0.5, np.float32)
        assert metrics.iou(half, np.ones((2, 2), np.float32)) == pytest.approx(0.5)
        assert metrics.iou(half * 0, half * 0) == 1

    def test_angle_of_directions(self):
        """In degrees; nowhere is at right angles to everything."""
        x, y = np.float32([1, 0, 0]), np.float32([1, 1, 0])
        assert metrics.direction_angle(x, y) == pytest.approx(45)
        assert metrics.direction_angle(x, 0 * x) == 90

    def test_landmark_error_is_relative_to_the_eyes(self):
        """A shift of a tenth of the inter-ocular distance is 0.1; other schemes are refused."""
        points = np.zeros((68, 3), np.float32)
        points[45, 0] = 50
        shifted = points + np.float32([3, 4, 100])
        assert metrics.landmark_error(Landmarks(shifted, "ibug68"), Landmarks(points, "ibug68")) == pytest.approx(0.1)
        with pytest.raises(ValueError, match="facemesh468"):
            metrics.landmark_error(Landmarks(points, "facemesh468"), Landmarks(points, "ibug68"))


class TestWhdr:
    def test_counts_weighted_disagreement(self):
        """Right judgements cost nothing, wrong ones their weight."""
        albedo = np.ones((2, 2, 3), np.float32)
        albedo[:, 0] = 0.5
        left, right = (0.1, 0.5), (0.9, 0.5)
        right_one = metrics.Judgement(left, right, "1", weight=3)
        wrong_one = metrics.Judgement(left, right, "E", weight=1)
        assert metrics.whdr(albedo, [right_one, wrong_one]) == pytest.approx(0.25)

    def test_needs_a_judgement(self):
        """Without any there is no rate."""
        with pytest.raises(ValueError, match="no judgement"):
            metrics.whdr(np.ones((2, 2, 3), np.float32), [])


class TestJudgements:
    STORED: ClassVar[dict[str, object]] = {
        "intrinsic_points": [{"id": 7, "x": 0.1, "y": 0.5}, {"id": 8, "x": 0.9, "y": 0.5}],
        "intrinsic_comparisons": [
            {"point1": 7, "point2": 8, "darker": "1", "darker_score": 0.75},
            {"point1": 7, "point2": 8, "darker": "E", "darker_score": 0.25},
            {"point1": 7, "point2": 8, "darker": None, "darker_score": None},
        ],
    }

    def test_read_and_measured_in_a_graph(self, tmp_path):
        """The form of Intrinsic Images in the Wild; what people did not settle has no say."""
        (tmp_path / "judged.json").write_text(json.dumps(self.STORED))
        albedo = np.ones((2, 2, 3), np.float32)
        albedo[:, 0] = 0.5
        graph = graphface.load(
            {
                "graphface": 1,
                "inputs": {"albedo": "Albedo", "said": "Judgements"},
                "nodes": {"rate": {"use": "metrics.whdr", "in": {"albedo": "albedo", "judgements": "said"}}},
                "outputs": {"rate": "rate"},
            }
        )
        assert graph.run(albedo=albedo, said=tmp_path / "judged.json")["rate"] == pytest.approx(0.25)

    @pytest.mark.parametrize("text", ["", "[]", "{}", '{"intrinsic_points": 3, "intrinsic_comparisons": []}'])
    def test_another_file(self, tmp_path, text):
        """What has not that form is refused by name."""
        path = tmp_path / "other.json"
        path.write_text(text)
        with pytest.raises(graphface.UnreadableFile, match=r"other\.json"):
            read_judgements(path)


class TestOperators:
    def test_encodings_are_brought_together(self, picture):
        """A linear result is compared with an encoded truth as encoded."""
        from graphface.nodes.color import decode_srgb

        linear = Image(decode_srgb(picture), encoding="linear")
        assert operators.psnr(linear, Image(picture)) > 100

    def test_sizes_must_agree(self, picture):
        """The message shows both."""
        with pytest.raises(ValueError, match=r"60, 50, 3.*30, 50, 3"):
            operators.ssim(Image(picture), Image(picture[:30]))
