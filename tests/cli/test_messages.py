"""What is told of an error: as much as helps, and no more."""

from graphface.cli.messages import message
from graphface.errors import NodeError, RunFailed, UsageError


def failed(*names: str, cause: Exception | None = None) -> RunFailed:
    failures = []
    for name in names:
        failure = NodeError(name, "toy.fail", None, "it broke", {"a": "float32[2]"}, ["p.png"])
        failure.__cause__ = cause
        failures.append(failure)
    return RunFailed(failures, {})


def test_explained() -> None:
    """A failure that the node explained itself has no array shapes beside it."""
    assert message(failed("a", cause=UsageError("it broke"))) == "p.png: node 'a': it broke"


def test_unexplained() -> None:
    """Any other has what the node was given."""
    assert "a: float32[2]" in message(failed("a"))


def test_many() -> None:
    """Of many the first five are told."""
    assert message(failed(*"abcdefgh", cause=UsageError("it broke"))).endswith("and 3 more")
