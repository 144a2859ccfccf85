"""What a PDF says and shows, read from its bytes."""

import re
import zlib
from pathlib import Path

_OBJECT = re.compile(rb"(\d+) 0 obj(.*?)endobj", re.DOTALL)
_STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)


class Paper:
    """A PDF as Qt writes it.

    Attributes
    ----------
    objects
        What stands in each, by its number.
    """

    def __init__(self, path: Path) -> None:
        self.objects = {int(one[1]): one[2] for one in _OBJECT.finditer(path.read_bytes())}

    def text(self) -> str:
        """All that is written, letter by letter: of letters alone, not of their outlines."""
        fonts = {name: self._letters(number) for name, number in self._fonts().items()}
        written, font = [], {}
        for one in re.finditer(rb"/(F\d+) [\d.]+ Tf|<([0-9A-Fa-f]+)> Tj", self._drawn()):
            if one[1]:
                font = fonts[one[1]]
            else:
                codes = re.findall(rb"....", one[2])
                written.append("".join(font[int(code, 16)] for code in codes))
        return "".join(written)

    def images(self) -> list[bytes]:
        """How each image is packed."""
        found = [one for one in self.objects.values() if b"/Subtype /Image" in one]
        return [re.search(rb"/Filter /(\w+)", one)[1] for one in found]

    def _drawn(self) -> bytes:
        pages = [one for one in self.objects.values() if re.search(rb"/Type /Page\b", one)]
        contents = [int(re.search(rb"/Contents (\d+)", one)[1]) for one in pages]
        return b"".join(self._stream(number) for number in contents)

    def _fonts(self) -> dict[bytes, int]:
        found = {}
        for one in self.objects.values():
            for listed in re.findall(rb"/Font <<(.*?)>>", one, re.DOTALL):
                for name, number in re.findall(rb"/(F\d+) (\d+) 0 R", listed):
                    found[name] = int(number)
        return found

    def _letters(self, number: int) -> dict[int, str]:
        """What each code of a font means, from its table for those who search and copy."""
        table = int(re.search(rb"/ToUnicode (\d+)", self.objects[number])[1])
        found = {}
        rows = re.findall(rb"<(\w+)> <\w+> \[(.*?)\]", self._stream(table), re.DOTALL)
        for first, letters in rows:
            for k, letter in enumerate(re.findall(rb"<(\w+)>", letters)):
                found[int(first, 16) + k] = bytes.fromhex(letter.decode()).decode("utf-16-be")
        return found

    def _stream(self, number: int) -> bytes:
        content = _STREAM.search(self.objects[number])[1]
        packed = b"/FlateDecode" in self.objects[number].partition(b"stream")[0]
        return zlib.decompress(content) if packed else content
