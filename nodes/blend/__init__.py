"""Blending a layer onto a picture: `linear`, `multiband` and `poisson` have the same ports; `recombine` puts a picture
together from albedo, shading and detail."""
