"""Light that spreads beneath the skin, simulated by smoothing the rendered shading (paper, section 3.1, "Scattering").

Only the change of light is smoothed: what the photo's own light did beneath the skin is in the photo already, and an
unchanged light must change nothing.
"""
