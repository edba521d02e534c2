"""The albedo of the painted face."""

import numpy as np

from graphface.nodes.makeup.albedo import albedo


class TestAlbedo:
    def test_full_tone_is_the_reference(self, face, rng):
        """At tone 1 the albedo is the reference's except in the openings, where it is the input's."""
        of_input, of_reference = (rng.random((200, 200, 3), np.float32) for _ in range(2))
        painted = albedo(of_input, of_reference, face.everywhere, face.features)
        opening = face.features.openings
        np.testing.assert_array_equal(painted[opening == 0], of_reference[opening == 0])
        assert np.abs(painted - of_input)[opening > 0.99].max(initial=0) < 0.05

    def test_openings_may_be_painted(self, face, rng):
        """With openings 1 all of it is the reference's."""
        of_input, of_reference = (rng.random((200, 200, 3), np.float32) for _ in range(2))
        painted = albedo(of_input, of_reference, face.everywhere, face.features, openings=1)
        np.testing.assert_array_equal(painted, of_reference)

    def test_no_tone_keeps_the_color_of_the_skin(self, face):
        """At tone 0 skin has the input's color, and a stripe twice as red as its skin stays twice as red."""
        of_input = np.full((200, 200, 3), (1.2, 0.9, 0.9), np.float32)
        of_reference = np.full((200, 200, 3), (1.0, 1.0, 1.0), np.float32)
        of_reference[150:155, :, 0] = 2
        painted = albedo(of_input, of_reference, face.everywhere, face.features, tone=0)
        np.testing.assert_allclose(painted[190, 5], of_input[190, 5], rtol=1e-4)
        np.testing.assert_allclose(painted[152, 5, 0], 2 * of_input[152, 5, 0], rtol=1e-4)

    def test_without_a_face_the_tone_changes_nothing(self, face, rng):
        """Where there is no skin to compare, tone 0 is as tone 1."""
        of_input, of_reference = (rng.random((200, 200, 3), np.float32) for _ in range(2))
        both = (albedo(of_input, of_reference, face.nowhere, face.features, tone=tone) for tone in (0, 1))
        np.testing.assert_array_equal(*both)
