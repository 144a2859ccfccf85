"""A preset as a file: one JSON text with a checksum, see `skinsource.codec.text`."""

from pathlib import Path

from skinsource import codec
from skinsource.codec import text
from skinsource.codec.json_text import MAX_TEXT_BYTES
from skinsource.errors import FileFormatError, InvalidInputError, SkinSourceError
from skinsource.fields import Address
from skinsource.files import named, read_bytes
from skinsource.presets.preset import Preset
from skinsource.quoting import sentence

#: What the text says that it is.
FORMAT = "skinsource preset"
SUFFIX = ".skinpreset"


def preset_text(preset: Preset) -> str:
    """The preset as a text; the same preset gives the same text.

    Raises
    ------
    InvalidInputError
        It holds so many samples that it could not be read again.
    """
    return text.to_text(codec.encode(preset), FORMAT) + "\n"


def preset_from(words: str) -> Preset:
    """The preset that `preset_text` wrote.

    Raises
    ------
    FileFormatError, InvalidInputError
        The text is something else, is damaged, or was written in another version.
    """
    found: Preset = codec.decode(text.from_text(words, FORMAT), (Preset,), Address())
    return found


def read_preset(path: Path) -> Preset:
    """The preset in a file.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It holds none, and why.
    """
    content = read_bytes(path, most=MAX_TEXT_BYTES + 1)
    try:
        return preset_from(content.decode(errors="replace"))
    except (FileFormatError, InvalidInputError) as error:
        raise FileFormatError(f"{named(Path(path.name))}: {sentence(str(error))}") from error


def why(error: SkinSourceError) -> str:
    """What went wrong, as one sentence."""
    return sentence(str(error))
