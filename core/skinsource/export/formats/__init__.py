"""Formats of stimulus files.

A format is a class that makes what `StimulusFormat` names.  To add one, write its class in a module
of this package and name it in `FORMATS`.
"""

from pathlib import Path

from skinsource.base.arguments import one_of
from skinsource.base.errors import InvalidInputError, printable
from skinsource.export.formats.arrays import Hdf5, Mat, Npz
from skinsource.export.formats.audio import Flac, Wav
from skinsource.export.formats.chips import Bos1901, Drv2605l, Drv2665
from skinsource.export.formats.experiments import Bids, PsychoPy
from skinsource.export.formats.format import StimulusFormat
from skinsource.export.formats.phones import Ahap, Haptic, Pwle
from skinsource.export.formats.text import CHeader, Csv

#: Every format, in the order of the list.
FORMATS: tuple[StimulusFormat, ...] = (
    Wav(),
    Flac(),
    Csv(),
    Npz(),
    Mat(),
    Hdf5(),
    CHeader(),
    Bids(),
    PsychoPy(),
    Drv2605l(),
    Bos1901(),
    Drv2665(),
    Haptic(),
    Ahap(),
    Pwle(),
)


def export_formats() -> tuple[str, ...]:
    """Return the names of the formats of stimulus files, see `skinsource.export_stimulus`.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(", ".join(ss.export_formats()[:4]))
    wav, flac, csv, npz
    """
    return tuple(known.name for known in FORMATS)


def format_named(name: str) -> StimulusFormat:
    """Return the format with this name."""
    one_of("format", name, export_formats())
    return next(known for known in FORMATS if known.name == name)


def format_of(path: Path, name: str | None = None) -> StimulusFormat:
    """Return the format with a name, else the first one whose files end as ``path`` does.

    Raises
    ------
    InvalidInputError
        There is none, or the path ends as files of another format do.
    """
    by_ending = [known for known in FORMATS if known.suffix and path.name.endswith(known.suffix)]
    if name is not None:
        chosen = format_named(name)
        if by_ending and chosen.suffix and not path.name.endswith(chosen.suffix):
            raise InvalidInputError(
                f"{printable(path.name)} has the ending of {by_ending[0].name} files, but the "
                f"format is {name}. Call it *{chosen.suffix}, or choose the other format."
            )
        return chosen
    if by_ending:
        return by_ending[0]
    raise InvalidInputError(
        f"{printable(path.name)} does not state its format; choose one of "
        f"{', '.join(export_formats())}"
    )
