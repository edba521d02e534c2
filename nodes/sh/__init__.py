"""Illumination as real spherical harmonics: fit it to a shading, render it, turn it, take it from a panorama.

Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001: the irradiance of
distant light on a convex Lambertian surface is, to within a percent, a second-order polynomial in the normal. The paper
fits the first order (section 2, "Face illumination").
"""

from graphface.nodes.sh.ball import ball
from graphface.nodes.sh.environment import from_environment, to_environment
from graphface.nodes.sh.fitting import fit
from graphface.nodes.sh.harmonics import ambient, basis, has_surface
from graphface.nodes.sh.rendering import render
from graphface.nodes.sh.rotation import rotate

__all__ = ["ambient", "ball", "basis", "fit", "from_environment", "has_surface", "render", "rotate", "to_environment"]
