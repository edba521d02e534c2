"""The surroundings as light: a panorama projected to spherical harmonics, where a scene asks for it."""

from __future__ import annotations

from graphface import UsageError, node
from graphface.nodes.environment import environment_light
from graphface.nodes.types import Environment, Lighting


@node("light.panorama")
def panorama(environment: Environment | None) -> Lighting:
    """`sh.from_environment` of order 2 for a graph input that may be left out.

    Raises:
        UsageError: it was left out and a scene asks for it.
    """
    if environment is None:
        raise UsageError("the scene has an environment light; give the graph's input `environment` a panorama")
    return environment_light(environment, order=2)
