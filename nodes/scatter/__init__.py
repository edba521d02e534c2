"""Light that spreads beneath the skin, simulated by smoothing the rendered shading (paper, section 3.1, "Scattering").

Only the change of light is smoothed: what the photo's own light did beneath the skin is in the photo already, and an
unchanged light must change nothing.
"""

from graphface.nodes.scatter.gaussian import gaussian
from graphface.nodes.scatter.none import none
from graphface.nodes.scatter.screen_space import screen_space

__all__ = ["gaussian", "none", "screen_space"]
