"""What all geometries of a face have in common."""

from __future__ import annotations

import numpy as np
from faces import coefficients_of, landmarks_of, rotation_of

from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.types import Landmarks
from graphface.registry import default_registry, interchangeable


class TestFamily:
    def test_members_are_interchangeable(self):
        """Any geometry takes the place of any other in a graph."""
        names = ("geometry.facemesh", "geometry.morphable", "geometry.average")
        operators = [default_registry().operator(name) for name in names]
        assert all(interchangeable(a, b) for a in operators[:1] for b in operators)
        assert interchangeable(operators[1], operators[2])

    def test_all_look_the_same_way(self):
        """Direct, fitted and average mesh of one face have nearly the same normals at the same points."""
        landmarks = landmarks_of(coefficients=coefficients_of(4, 0.3), rotation=rotation_of(10))
        depth = builtin_model().vertices(coefficients_of(4, 0.3)) @ rotation_of(10).T * 150
        points = landmarks.points.copy()
        points[:, 2] = depth[:468, 2]
        direct = facemesh(Landmarks(points, "facemesh468"))
        fitted = morphable(landmarks)
        cosine = np.einsum("vc,vc->v", direct.normals, fitted.normals[:468])
        assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean() < 8
