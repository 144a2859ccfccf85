"""How values and sentences look in a message.

What is quoted comes from files, servers and scripts: it may be a megabyte of text, and hold
commands for a terminal.  A message shows the beginning of it, in characters that can be printed.
"""

import reprlib

#: Characters of a quotation; what is longer is cut.
MOST_CHARACTERS = 80

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = MOST_CHARACTERS
_SHORT.maxlevel = 3


def quoted(value: object) -> str:
    """Return ``value`` as Python writes it, at most 80 printable characters of it."""
    if isinstance(value, str | bytes | bytearray):
        # Only the beginning is turned into words, however long it is.
        text = repr(value[: MOST_CHARACTERS + 1])
    else:
        try:
            text = _SHORT.repr(value)
        except (ValueError, RecursionError):  # whole numbers of thousands of digits; deep nests
            text = f"<{type(value).__name__}>"
    return printable(text)


def printable(thing: object) -> str:
    r"""Return a text, or what an error says, in one line of at most 80 printable characters.

    What cannot be printed is written as Python does, ``\x1b`` for the beginning of a
    terminal's command; a cut is marked by ``…``.
    """
    text = str(thing)
    beginning = text[: 4 * MOST_CHARACTERS]
    shown = escaped(" ".join(beginning.split()))
    whole = len(shown) <= MOST_CHARACTERS and len(text) == len(beginning)
    return shown if whole else f"{shown[: MOST_CHARACTERS - 1]}…"


def escaped(text: str) -> str:
    """Return ``text`` with what cannot be printed written as Python does."""
    return "".join(
        character if character.isprintable() else character.encode("unicode_escape").decode("ascii")
        for character in text
    )


def sentence(text: str) -> str:
    """Return ``text`` with exactly one full stop at its end."""
    return f"{text.rstrip().rstrip('.')}."


def first_sentence(text: str) -> str:
    """Return the first sentence of ``text``, with its full stop.

    >>> first_sentence("The level is 0.5 dB. Choose another one.")
    'The level is 0.5 dB.'
    """
    return sentence(text.split(". ", 1)[0])
