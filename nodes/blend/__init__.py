"""Putting a layer onto a picture: `blend.linear`, `blend.multiband`, `blend.poisson`, with the same ports."""
