"""A panorama as light, for scenes that ask for it."""

from __future__ import annotations

from graphface import UsageError, node
from graphface.nodes.environment import environment_light
from graphface.nodes.types import Environment, Lighting


@node("light.panorama")
def panorama(environment: Environment | None) -> Lighting:
    """The second-order irradiance of a panorama (see `sh.from_environment`), from a graph input that may be missing.

    Raises:
        UsageError: it is missing, and a scene asks for it.
    """
    if environment is None:
        raise UsageError("the scene has an environment light; give the graph's input `environment` a panorama")
    return environment_light(environment, order=2)
