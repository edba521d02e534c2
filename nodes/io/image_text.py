"""A few words kept inside a picture file: where it came from, so that it can be made again.

One entry called "graphface" holds the whole mapping as JSON: in PNG an international text chunk, elsewhere an attribute
of an XMP packet. XMP has a place of its own in JPEG, WebP and TIFF, so the photographer's EXIF stays as it was.
"""

from __future__ import annotations

import base64
import html
import json
import re
import zlib
from collections.abc import Mapping
from pathlib import Path

from graphface import UnreadableFile
from graphface.nodes.io.image_read import open_picture

KEYWORD = "graphface"


XMP = 700
"""The TIFF tag of an XMP packet."""


MAX_TEXT = 16_000_000
"""Characters; a longer text in a file is not believed."""


_XMP = (
    '<?xpacket begin="\ufeff" id="W5M0MpCehiHzreSzNTczkc9d"?><x:xmpmeta xmlns:x="adobe:ns:meta/">'
    '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">'
    '<rdf:Description rdf:about="" xmlns:graphface="urn:graphface:1" graphface:text="{}"/>'
    '</rdf:RDF></x:xmpmeta><?xpacket end="w"?>'
)


def read_text(path: Path) -> dict[str, str]:
    """The words that `write_image(..., text=...)` stored in a picture file; {} where there are none.

    Raises:
        UnreadableFile: no picture, or its words are damaged.
    """
    path = Path(path)
    with open_picture(path) as picture:
        if picture.format == "PNG":
            stored = picture.image.info.get(KEYWORD)
        else:
            xmp = picture.tags.get(XMP) if picture.format == "TIFF" else picture.image.info.get("xmp")
            xmp = xmp or b""
            xmp = xmp if isinstance(xmp, bytes) else str(xmp).encode()
            found = re.search(rb'graphface:text="([^"]*)"', xmp)
            stored = html.unescape(found[1].decode("utf-8", "replace")) if found else None
    if stored is None:
        return {}
    try:
        words = json.loads(_unpacked(str(stored)))
        return {str(key): str(value) for key, value in words.items()}
    except (ValueError, AttributeError, zlib.error) as error:
        raise UnreadableFile(path, f"the graphface text inside is damaged ({error})") from error


def packed(text: Mapping[str, str]) -> str:
    """The mapping as JSON; from 16 KB on compressed (JPEG has room for 64 KB)."""
    plain = json.dumps(dict(text), ensure_ascii=False, separators=(",", ":"))
    if len(plain) < 16_384:
        return plain
    return "zlib:" + base64.b64encode(zlib.compress(plain.encode(), 9)).decode("ascii")


def xmp_packet(text: Mapping[str, str]) -> bytes:
    """An XMP packet that holds the mapping."""
    return _XMP.format(html.escape(packed(text), quote=True)).encode()


def _unpacked(stored: str) -> str:
    if not stored.startswith("zlib:"):
        return stored
    inflater = zlib.decompressobj()
    plain = inflater.decompress(base64.b64decode(stored[5:], validate=True), MAX_TEXT)
    if inflater.unconsumed_tail:
        raise ValueError("it is implausibly long")
    return plain.decode()
