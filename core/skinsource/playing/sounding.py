"""The way to PortAudio: imported when somebody wants to hear something, and not before."""

import importlib
from types import ModuleType

from skinsource.errors import MissingExtraError, PlaybackError
from skinsource.quoting import printable

#: What to type where it is missing.
INSTALL = 'pip install "skinsource[audio]"'
_LIBRARY = (
    "PortAudio is not installed, without which nothing can be played. On Linux it is a package of "
    "the system: sudo apt install libportaudio2 (Debian, Ubuntu), sudo dnf install portaudio "
    "(Fedora). Then start the studio again."
)


def sound_library() -> ModuleType:
    """Import sounddevice.

    Raises
    ------
    MissingExtraError
        It is not installed; the message holds the line to type.
    PlaybackError
        It is, but PortAudio is not, or does not start.
    """
    try:
        return importlib.import_module("sounddevice")
    except ImportError as error:
        raise MissingExtraError(
            f"To play needs the package sounddevice, which cannot be imported "
            f"({printable(error)}). Install it with: {INSTALL}"
        ) from error
    except OSError as error:
        raise PlaybackError(f"{_LIBRARY} ({printable(error)})") from error
