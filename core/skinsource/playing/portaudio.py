"""The way to PortAudio: imported when somebody wants to hear something, and not before."""

from types import ModuleType

from skinsource.errors import MissingExtraError, NothingToPlayOnError
from skinsource.extras import extra_line, package_of_extra
from skinsource.quoting import printable

_LIBRARY = (
    "PortAudio is not installed, without which nothing can be played. On Linux it is a package of "
    "the system: sudo apt install libportaudio2 (Debian, Ubuntu), sudo dnf install portaudio "
    "(Fedora). Then start the studio again."
)


def sound_library() -> ModuleType:
    """Import sounddevice.

    Raises
    ------
    NothingToPlayOnError
        It is not installed, or PortAudio is not, or does not start; the message says what to type.
    """
    try:
        return package_of_extra("sounddevice", "audio")
    except MissingExtraError as error:
        raise NothingToPlayOnError(
            f"To play, type: {extra_line('audio')} and start the studio again "
            f"({printable(error.__cause__)})."
        ) from error
    except OSError as error:
        raise NothingToPlayOnError(f"{_LIBRARY} ({printable(error)})") from error
