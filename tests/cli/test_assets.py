"""`graphface assets`: pinned files."""

from collections.abc import Callable


class TestAssets:
    def test_unknown(self, graphface: Callable[..., object]) -> None:
        """An unknown asset is a wrong request."""
        said = graphface("assets", "path", "none")
        assert said.code == 2
        assert "there is no asset 'none' (there are " in said.err
