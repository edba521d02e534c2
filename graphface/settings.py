"""What a user sets once for everything: a flag wins over the environment, that over the configuration file.

    # ~/.config/graphface/config.toml on Linux; `config_path` says where elsewhere
    memory = "4G"
    cache-size = "20G"

`GRAPHFACE_MEMORY=4G` and `--memory 4G` say the same. Both settings are sizes: bytes, or a number with a unit.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from graphface.errors import UsageError, did_you_mean, nearest_names

DEFAULTS = {"memory": 2 << 30, "cache-size": 10_000_000_000}
"""Bytes of the memory tier, and of a disk cache."""

_SIZE = re.compile(r"\s*(\d+(?:\.\d+)?)\s*(?:([kmgt])(i?)b?|b)?\s*", re.IGNORECASE)
_POWERS = {"k": 1, "m": 2, "g": 3, "t": 4}


def memory_budget(flag: str | None = None) -> int:
    """Bytes that the memory tier may hold: `--memory`, GRAPHFACE_MEMORY, `memory` of the configuration, or 2 GiB.

    Raises:
        UsageError: what is set is no size; the message names the flag, variable or file.
    """
    return _size("memory", flag)


def cache_size(flag: str | None = None) -> int:
    """Bytes that a disk cache may hold: `--cache-size`, GRAPHFACE_CACHE_SIZE, `cache-size` or 10 GB. Raises alike."""
    return _size("cache-size", flag)


def parse_size(text: str) -> int:
    """Bytes: "2G", "500 MB" and "1.5k" in powers of 1000, "2GiB" in powers of 1024, "1000000" as it is.

    Raises:
        ValueError: the text is no size.
    """
    found = _SIZE.fullmatch(text)
    if found is None:
        raise ValueError(f"expected a size such as 2G, 500M or a number of bytes, got {text!r}")
    number, unit, binary = found.groups()
    return int(float(number) * (1024 if binary else 1000) ** _POWERS[unit.lower()]) if unit else int(float(number))


def config_path() -> Path:
    """The user's configuration file, which need not exist."""
    from platformdirs import user_config_path

    return user_config_path("graphface") / "config.toml"


def _size(name: str, flag: str | None) -> int:
    variable = f"GRAPHFACE_{name.upper().replace('-', '_')}"
    if flag is not None:
        source, text = f"--{name}", flag
    elif variable in os.environ:
        source, text = variable, os.environ[variable]
    else:
        source, text = f"{config_path()}: {name}", str(_configured().get(name, DEFAULTS[name]))
    try:
        return parse_size(text)
    except ValueError as error:
        raise UsageError(f"{source}: {error}") from None


def _configured() -> Mapping[str, Any]:
    """The configuration file's settings.

    Raises:
        UsageError: it cannot be read, is not TOML, or sets something unknown.
    """
    import tomllib

    from graphface.fallback import warn

    path = config_path()
    try:
        settings = tomllib.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        return {}
    except PermissionError:
        warn(f"{path} may not be read: the defaults are used")
        return {}
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: {error}") from None
    for name in settings:
        if name not in DEFAULTS:
            near = did_you_mean(nearest_names(name, DEFAULTS))
            raise UsageError(f"{path}: there is no setting {name!r} (there are {', '.join(DEFAULTS)}){near}")
    return settings
