"""One way to say what is wrong with the files of a limb."""

from pathlib import Path

from skinsource.errors import RecordingError
from skinsource.files import named

_ADVICE = "docs/limbs.md says what a limb consists of."


def refusal(path: Path, found: str, expected: str) -> RecordingError:
    """The error that names the file, what was found and expected, and where to look."""
    return RecordingError(f"{named(Path(path.name))}: {found}, expected {expected}. {_ADVICE}")
