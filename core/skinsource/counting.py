"""How many there are, in words."""


def counted(count: int, noun: str, plural: str = "") -> str:
    """Return ``"1 clip"``, ``"3 clips"``.

    Parameters
    ----------
    count
        How many.
    noun
        What one is called; the words before it stay as they are: ``"more clip"``.
    plural
        What several are called, where that is not the noun with an s.
    """
    return f"{count} {noun if count == 1 else plural or f'{noun}s'}"
