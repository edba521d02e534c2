"""How wide a text is in a sans-serif font that is not known yet: no wider than this, in the common ones."""

from __future__ import annotations

import unicodedata

# Of DejaVu Sans from the space on, in thousandths of the size: the widest font that "sans-serif" commonly stands for.
_WIDTHS = (
    *(318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337),
    *(636, 636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531),
    *(1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787),
    *(603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500),
    *(500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612),
    *(635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838),
)
_BOLD = 1.13
_OTHER, _WIDE, _ELLIPSIS = 850, 1100, "…"


def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Pixels, at a font size in pixels."""
    return sum(map(_width, text)) * size / 1000 * (_BOLD if bold else 1.0)


def fitted(text: str, room: float, size: float, *, bold: bool = False) -> str:
    """The text, cut short and with an ellipsis where it is wider than `room`; one line, whatever is in it."""
    text = " ".join(text.split())
    if text_width(text, size, bold=bold) <= room:
        return text
    left, kept = room - text_width(_ELLIPSIS, size, bold=bold), 0
    for character in text:
        left -= text_width(character, size, bold=bold)
        if left < 0:
            break
        kept += 1
    return text[:kept].rstrip() + _ELLIPSIS if kept else ""


def wrapped(text: str, room: float, size: float, most: int) -> list[str]:
    """The text in at most so many lines, broken at spaces; the last one is cut where there is more."""
    words = text.split()
    lines: list[str] = []
    while words and len(lines) < most - 1:
        taken = 1
        while taken < len(words) and text_width(" ".join(words[: taken + 1]), size) <= room:
            taken += 1
        lines.append(fitted(" ".join(words[:taken]), room, size))
        del words[:taken]
    return [*lines, fitted(" ".join(words), room, size)] if words else lines


def _width(character: str) -> int:
    number = ord(character) - 32
    if 0 <= number < len(_WIDTHS):
        return _WIDTHS[number]
    if character == _ELLIPSIS:
        return 1000
    wide = ord(character) > 0xFFFF or unicodedata.east_asian_width(character) in "WF"
    return _WIDE if wide else _OTHER
