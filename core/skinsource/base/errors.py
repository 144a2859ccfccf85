"""All errors that a user can meet.

Each message says where it happened, what was found, what was expected, and what to do next.

SkinSourceError
├── InvalidInputError      a value handed to the library is impossible (also a `ValueError`)
│   ├── UnknownLimbError   no limb has this name
│   └── FormulaError       a formula cannot be read, or its result is no number; knows the column
├── FileFormatError        a file does not hold what it should
│   ├── DatasetError       … a file of the measured dataset, or the store made from it
│   ├── RecordingError     … a file that a recording is taken from
│   └── DesignFileError    … a `.skinsource` file
├── DatasetMissingError    a measured limb is asked for, and none is installed
├── StorageError           reading or writing failed: full disk, no permission, no such folder
├── DownloadError          the network, or the server, did not deliver
├── PlaybackError          a device is missing or does not support what is played
│   └── NothingToPlayOnError   … there is no device, or the package for devices is not installed
├── TooInaccurateError     a result would be less accurate than requested; nothing is written
├── NotConfirmedError      a result clips, passes a limit or loses much, and nobody confirmed it
├── MissingExtraError      an optional package is needed and not installed
└── Stopped                the user stopped it
"""


class SkinSourceError(Exception):
    """Base of every error whose message is written for the user."""


class InvalidInputError(SkinSourceError, ValueError):
    """A value handed to the library cannot be used."""


class UnknownLimbError(InvalidInputError):
    """No limb has this name."""


class FormulaError(InvalidInputError):
    """A formula cannot be read, or what it gives cannot be played.

    Attributes
    ----------
    column
        Where in the text, from 1.
    """

    def __init__(self, message: str, column: int = 1) -> None:
        super().__init__(message)
        self.column = column


class FileFormatError(SkinSourceError):
    """A file does not hold what it should."""


class DatasetError(FileFormatError):
    """A file of the measured dataset, or the store made from it, is not what it should be."""


class RecordingError(FileFormatError):
    """A file that a recording is to be taken from does not hold one that can be used."""


class DesignFileError(FileFormatError):
    """A design file cannot be understood."""


class DatasetMissingError(SkinSourceError):
    """A measured limb is needed, and no measured dataset is installed."""


class StorageError(SkinSourceError):
    """The file system refused: full disk, read-only folder, no such folder."""


class DownloadError(SkinSourceError):
    """The network or the server failed to deliver a file."""


class PlaybackError(SkinSourceError):
    """A device is missing, or does not support what is played."""


class NothingToPlayOnError(PlaybackError):
    """There is no device, or the package for devices is not installed."""


class TooInaccurateError(SkinSourceError):
    """A result would be less accurate than requested; nothing was written."""


class NotConfirmedError(SkinSourceError):
    """A result clips, passes a limit or loses much, unconfirmed; nothing was written."""


class MissingExtraError(SkinSourceError):
    """An optional package is needed and is not installed."""


class Stopped(SkinSourceError):
    """The user stopped the work; nothing was left behind."""
