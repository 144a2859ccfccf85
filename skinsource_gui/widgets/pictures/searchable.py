"""Pages whose words are found by those who search and copy."""

import re
import zlib

_LETTERS_OF_FONT = re.compile(rb"/ToUnicode (\d+) 0 R")
_TRAILER = re.compile(rb"trailer\s*<<(.*)>>\s*startxref\s*(\d+)\s*%%EOF\s*$", re.DOTALL)
_MEANINGS = re.compile(rb"\[.*?\]", re.DOTALL)
_TAB, _BLANK = b"<0009>", b"<0020>"


def searchable(pdf: bytes) -> bytes:
    """Return a page that Qt has written, with blanks between its words.

    A tab and a blank are one empty letter of a font, and Qt says of a letter the first thing that
    it stands for: a search for two words would find nothing.  What its fonts say is mended in an
    update at the end of the file, as the format has it; the page itself stays as it is.
    """
    end = _TRAILER.search(pdf)
    numbers = sorted({int(number) for number in _LETTERS_OF_FONT.findall(pdf)})
    mended = {number: _mended(pdf, number) for number in numbers}
    if end is None or not any(mended.values()):
        return pdf
    whole, places = bytearray(pdf), {}
    for number, letters in mended.items():
        if letters:
            places[number] = len(whole)
            whole += b"%d 0 obj\n<</Length %d>>\nstream\n" % (number, len(letters))
            whole += letters + b"\nendstream\nendobj\n"
    table = len(whole)
    rows = b"".join(b"%d 1\n%010d 00000 n \n" % place for place in places.items())
    whole += b"xref\n" + rows
    whole += b"trailer\n<<%s/Prev %s\n>>\nstartxref\n%d\n%%%%EOF\n" % (end[1], end[2], table)
    return bytes(whole)


def _mended(pdf: bytes, number: int) -> bytes:
    """What the letters of a font mean, with blanks; nothing where there is nothing to mend."""
    found = re.search(
        rb"(?<!\d)%d 0 obj\s*<<(.*?)>>\s*stream\r?\n(.*?)\r?\nendstream" % number, pdf, re.DOTALL
    )
    if found is None:
        return b""
    letters = zlib.decompress(found[2]) if b"/FlateDecode" in found[1] else found[2]
    mended = _MEANINGS.sub(lambda meanings: meanings[0].replace(_TAB, _BLANK), letters)
    return b"" if mended == letters else mended
