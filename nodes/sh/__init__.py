"""Illumination as real spherical harmonics: fit it to a shading, render it, rotate it, project a panorama to it.

Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001: within a percent,
the irradiance of distant light on a convex Lambertian surface is a second-order polynomial of the normal. The paper
fits the first order (section 3, "Face illumination").
"""
