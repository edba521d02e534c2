"""A face model fitted to several photographs of one person."""

from __future__ import annotations

import numpy as np
import pytest
from faces import coefficients_of, landmarks_of, rotation_of

from graphface import UsageError
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.person.morphable import person


class TestPerson:
    def test_photographs_share_identity_and_not_expression(self):
        """Two expressions of one person: one identity, two expressions, each photo explained."""
        one, two = coefficients_of(1), coefficients_of(2)
        two[:15] = one[:15]
        faces = [landmarks_of(coefficients=c, rotation=rotation_of(y)) for c, y in ((one, -20), (two, 20))]
        first, second = person(faces, noise=0.01)
        np.testing.assert_allclose(first.fit.identity, second.fit.identity, atol=1e-5)
        assert np.abs(first.fit.expression - second.fit.expression).max() > 0.1
        assert max(first.fit.residual, second.fit.residual) < 0.02 * 150

    def test_one_photograph_is_the_single_fit(self):
        """A list of one gives what geometry.morphable gives."""
        landmarks = landmarks_of(coefficients=coefficients_of(3))
        np.testing.assert_allclose(person([landmarks])[0].vertices, morphable(landmarks).vertices, atol=1e-2)

    def test_nobody_is_an_error(self):
        """An empty list is the user's mistake."""
        with pytest.raises(UsageError, match="at least one"):
            person([])
