"""The table of formats."""

from pathlib import Path

from skinsource.arguments import one_of
from skinsource.errors import InvalidInputError
from skinsource.quoting import printable
from skinsource.stimulus_formats.bids import BIDS
from skinsource.stimulus_formats.c_header import C_HEADER
from skinsource.stimulus_formats.csv_text import CSV
from skinsource.stimulus_formats.driver_chips import BOS1901, DRV2605L, DRV2665
from skinsource.stimulus_formats.flac import FLAC
from skinsource.stimulus_formats.hdf5_file import HDF5
from skinsource.stimulus_formats.matlab import MAT
from skinsource.stimulus_formats.numpy_archive import NPZ
from skinsource.stimulus_formats.phones import AHAP, HAPTIC, PWLE
from skinsource.stimulus_formats.psychopy import PSYCHOPY
from skinsource.stimulus_formats.stimulus_format import StimulusFormat
from skinsource.stimulus_formats.wav import WAV

FORMATS: tuple[StimulusFormat, ...] = (
    WAV,
    FLAC,
    CSV,
    NPZ,
    MAT,
    HDF5,
    C_HEADER,
    BIDS,
    PSYCHOPY,
    DRV2605L,
    BOS1901,
    DRV2665,
    HAPTIC,
    AHAP,
    PWLE,
)


def export_formats() -> tuple[str, ...]:
    """Names of what a stimulus can be exported as, see `skinsource.export_stimulus`."""
    return tuple(one.name for one in FORMATS)


def format_named(name: str | None, path: Path) -> StimulusFormat:
    """Return the format with this name; None: the first one whose files end as ``path`` does."""
    if name is None:
        for one in FORMATS:
            if one.suffix and path.name.endswith(one.suffix):
                return one
        raise InvalidInputError(
            f"{printable(path.name)} does not tell its format: say which, one of "
            f"{', '.join(export_formats())}"
        )
    known = one_of("format", name, export_formats())
    return next(one for one in FORMATS if one.name == known)
