"""What the user is told of an error."""

from __future__ import annotations


def message(error: Exception) -> str:
    """What to tell the user: a failure that the node itself explained needs no array shapes beside it."""
    from graphface.errors import GraphfaceError, RunFailed

    if not isinstance(error, RunFailed):
        return str(error)
    told = []
    for failure in error.failures[:5]:
        explained = isinstance(failure.__cause__, GraphfaceError)
        files = f"{', '.join(failure.files)}: " if failure.files else ""
        told.append(f"{files}node {failure.node!r}: {failure.reason}" if explained else str(failure))
    if len(error.failures) > 5:
        told.append(f"and {len(error.failures) - 5} more")
    return "\n".join(told)
