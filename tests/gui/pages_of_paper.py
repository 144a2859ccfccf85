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
        self.objects = {int(match[1]): match[2] for match in _OBJECT.finditer(path.read_bytes())}

    def text(self) -> str:
        """All that is written, letter by letter: of letters alone, not of their outlines."""
        fonts = {name: self._letters(number) for name, number in self._fonts().items()}
        written, font = [], {}
        for match in re.finditer(rb"/(F\d+) [\d.]+ Tf|<([0-9A-Fa-f]+)> Tj", self._drawn()):
            if match[1]:
                font = fonts[match[1]]
            else:
                codes = re.findall(rb"....", match[2])
                written.append("".join(font[int(code, 16)] for code in codes))
        # Qt writes the blank of some fonts as a tab.
        return "".join(written).replace("\t", " ")

    def images(self) -> list[bytes]:
        """How each image is packed."""
        images = [
            pdf_object for pdf_object in self.objects.values() if b"/Subtype /Image" in pdf_object
        ]
        return [re.search(rb"/Filter /(\w+)", image)[1] for image in images]

    def _drawn(self) -> bytes:
        pages = [
            pdf_object
            for pdf_object in self.objects.values()
            if re.search(rb"/Type /Page\b", pdf_object)
        ]
        contents = [int(re.search(rb"/Contents (\d+)", page)[1]) for page in pages]
        return b"".join(self._stream(number) for number in contents)

    def _fonts(self) -> dict[bytes, int]:
        numbers = {}
        for pdf_object in self.objects.values():
            for listed in re.findall(rb"/Font <<(.*?)>>", pdf_object, re.DOTALL):
                for name, number in re.findall(rb"/(F\d+) (\d+) 0 R", listed):
                    numbers[name] = int(number)
        return numbers

    def _letters(self, number: int) -> dict[int, str]:
        """What each code of a font means, from its table for those who search and copy."""
        table = int(re.search(rb"/ToUnicode (\d+)", self.objects[number])[1])
        letter_of_code = {}
        # A font of few letters has them in another form.
        rows = re.findall(rb"<(\w+)> <\w+> (\[.*?\]|<\w+>)", self._stream(table), re.DOTALL)
        for first, letters in rows:
            for k, letter in enumerate(re.findall(rb"<(\w+)>", letters)):
                letter_of_code[int(first, 16) + k] = bytes.fromhex(letter.decode()).decode(
                    "utf-16-be"
                )
        return letter_of_code

    def _stream(self, number: int) -> bytes:
        content = _STREAM.search(self.objects[number])[1]
        packed = b"/FlateDecode" in self.objects[number].partition(b"stream")[0]
        return zlib.decompress(content) if packed else content
