"""Subsurface scattering in skin, simulated by smoothing the rendered shading (paper, section 4.1, "Scattering").

Only the change of light is smoothed. The photo already contains the scattering of its own light, and an unchanged light
must change nothing.
"""
