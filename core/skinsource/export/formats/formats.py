"""The table of formats."""

from pathlib import Path

from skinsource.base.arguments import one_of
from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import printable
from skinsource.export.formats.arrays import HDF5, MAT, NPZ
from skinsource.export.formats.audio import FLAC, WAV
from skinsource.export.formats.chips import BOS1901, DRV2605L, DRV2665
from skinsource.export.formats.experiments import BIDS, PSYCHOPY
from skinsource.export.formats.format import StimulusFormat
from skinsource.export.formats.phones import AHAP, HAPTIC, PWLE
from skinsource.export.formats.text import C_HEADER, CSV

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
    """Return the names of the formats of stimulus files, see `skinsource.export_stimulus`."""
    return tuple(known.name for known in FORMATS)


def format_named(name: str | None, path: Path) -> StimulusFormat:
    """Return the format with this name; None: the first one whose files end as ``path`` does."""
    if name is None:
        for known in FORMATS:
            if known.suffix and path.name.endswith(known.suffix):
                return known
        raise InvalidInputError(
            f"{printable(path.name)} does not tell its format: say which, one of "
            f"{', '.join(export_formats())}"
        )
    one_of("format", name, export_formats())
    return next(known for known in FORMATS if known.name == name)
