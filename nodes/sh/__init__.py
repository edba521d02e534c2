"""Illumination as real spherical harmonics: fit it to a shading, render it, turn it, take it from a panorama.

Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001: the irradiance of
distant light on a convex Lambertian surface is, to within a percent, a second-order polynomial in the normal. The paper
fits the first order (section 2, "Face illumination").
"""
