"""Bytes as text that may stand in an element."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.report.page.seven_bit import seven_bit


def back(text: str) -> bytes:
    """As the page reads it."""
    symbols = [ord(c) if ord(c) < 128 else b"\0\n\r<"[ord(c) - 128] for c in text]
    bits = "".join(f"{symbol:07b}" for symbol in symbols)
    return bytes(int(bits[i : i + 8], 2) for i in range(0, len(bits) // 8 * 8, 8))


@given(st.binary(max_size=200))
def test_round_trip(content: bytes) -> None:
    """Every byte comes back, and no character could end the text or the element."""
    text = seven_bit(content)
    assert back(text) == content
    assert not set(text) & set("\0\n\r<")


@pytest.mark.parametrize("content", [b"", b"\0" * 100, b"<" * 100, b"\r\n" * 50])
def test_unsafe(content: bytes) -> None:
    """The four characters that may not stand there are never in it."""
    assert back(seven_bit(content)) == content
