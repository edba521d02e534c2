"""Text kept inside a picture file: which run made it, so that it can be made again.

An entry called "graphface" holds a mapping of texts as JSON: in PNG an international text chunk, elsewhere an attribute
of an XMP packet. JPEG, WebP and TIFF store XMP apart from EXIF, so the photographer's EXIF stays as it is.
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
"""Bytes; a longer text in a file is refused."""


_XMP = (
    '<?xpacket begin="\ufeff" id="W5M0MpCehiHzreSzNTczkc9d"?><x:xmpmeta xmlns:x="adobe:ns:meta/">'
    '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">'
    '<rdf:Description rdf:about="" xmlns:graphface="urn:graphface:1" graphface:text="{}"/>'
    '</rdf:RDF></x:xmpmeta><?xpacket end="w"?>'
)


def read_text(path: Path) -> dict[str, str]:
    """The texts that `write_image(..., text=...)` stored in a picture file; {} where there are none.

    Raises:
        UnreadableFile: no picture, or its text is damaged.
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
        texts = json.loads(_unpacked(str(stored)))
        return {str(key): str(value) for key, value in texts.items()}
    except (ValueError, AttributeError, zlib.error) as error:
        raise UnreadableFile(path, f"the graphface text inside is damaged ({error})") from error


def packed(text: Mapping[str, str]) -> str:
    """The mapping as JSON; compressed from 16 KB on (a segment of a JPEG holds 64 KB)."""
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
