"""Detail maps (paper, section 3): what the photo has and the rendering of albedo, geometry and light lacks.

The methods `detail.*` have the same ports and differ in how a detail map answers a change of light; `detail.edit.*`
change a map that is finished. `graphface.nodes.rendering.applied` puts any of them onto a rendering.
"""
