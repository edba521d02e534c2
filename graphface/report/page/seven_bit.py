"""Bytes inside a UTF-8 page, seven bits a character: an eighth smaller than base64.

Nearly all of the 128 ASCII characters may stand in an element that holds no markup. The four that may not (NUL and CR,
which browsers change; LF, which ends a text here; <, which could end the element) go as U+0080..U+0083, in two bytes.
Random bytes take 1.18 bytes each, 1.33 in base64. A page in a one-byte encoding would take 1.02; it was rejected, since
a server that calls every page UTF-8 would garble it. See also Albertson, *Base-122 Encoding*, 2016.
"""

from __future__ import annotations

import numpy as np

_UNSAFE = "\0\n\r<"


def seven_bit(content: bytes) -> str:
    """The bits of the content, highest first, seven a character; zeros at the end fill the last one."""
    padded = np.zeros((-(-len(content) // 7), 8), np.uint8)  # seven bytes a row, and a zero before them
    seven = np.zeros(padded.shape[0] * 7, np.uint8)
    seven[: len(content)] = np.frombuffer(content, np.uint8)
    padded[:, 1:] = seven.reshape(-1, 7)
    symbols = np.zeros_like(padded)
    for number in range(8):  # the last bits of a byte, then the first of the next
        following = padded[:, number + 1] >> (number + 1) if number < 7 else 0
        symbols[:, number] = (padded[:, number] << (7 - number) | following) & 0x7F
    symbols = symbols.reshape(-1)[: -(-len(content) * 8 // 7)]
    text = symbols.tobytes().decode("ascii")
    for number, character in enumerate(_UNSAFE):
        text = text.replace(character, chr(0x80 + number))
    return text
