"""The process that reads a file of version 1: ``python -m skinsource.design_file.version_1_child``.

It takes the bytes of the file from its input, and writes a word of `apart` and what follows from
it: a file of today, or a sentence.
"""

import sys

from skinsource import codec
from skinsource.codec import image
from skinsource.design_file import VERSION, DesignFile, version_1
from skinsource.design_file.version_1_process import DAMAGED, FOUND, REFUSED
from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.files.child_limits import limit_memory, limit_time, own_output

_MEMORY_BYTES, _CPU_S = 2**30, 50


def main() -> None:
    """Read one file."""
    output = own_output()
    limit_memory(_MEMORY_BYTES)
    limit_time(_CPU_S)
    output.write(answer(sys.stdin.buffer.read()))
    output.flush()


def answer(stored: bytes) -> bytes:
    """What is said of a file with these bytes."""
    try:
        design, view, layout = version_1.content_of(stored)
        content = DesignFile(design=design, view=view, layout=layout)
        return FOUND + image.to_image(codec.encode(content), VERSION)
    except FileFormatError as error:
        return DAMAGED + str(error).encode()
    except InvalidInputError as error:
        return REFUSED + str(error).encode()


if __name__ == "__main__":
    main()
