"""Figures of outputs as a table."""

from dataclasses import dataclass

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.limbs.locations import output_words
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.analysis.statistics import BEGUN_SHARE, Statistics
from skinsource_gui.widgets.copied_numbers import copied

#: Titles, as narrow as they can be, and what they mean.
COLUMNS = (
    ("Output", "Number and place of the output"),
    ("RMS\nm/s²", "RMS over what the choice Levels says"),
    ("Peak\nm/s²", "Largest magnitude of the signal, over the whole record"),
    ("Crest", "Peak over RMS"),
    ("Main\nHz", "Frequency with the most power along the chosen axes"),
    (
        "Delay\nms",
        f"From the start of the first input to where the output first reaches {BEGUN_SHARE:.0%} of "
        "its peak; the pre-trigger counts unless it is removed",
    ),
)
NOISE_MARK = "≈"
NOISE_WORDS = f"{NOISE_MARK} less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise"


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One output: its name, its figures, and whether they are mostly those of noise."""

    number: int
    name: str
    values: tuple[float, ...]
    noisy: bool

    def texts(self) -> tuple[str, ...]:
        """As they are shown; a dash where there is no number."""
        mark = f" {NOISE_MARK}" if self.noisy else ""
        written = (
            format(value, style).removesuffix(".") if np.isfinite(value) else "–"
            for value, style in zip(self.shown, ("#.3g", "#.3g", ".2f", ".1f", ".1f"), strict=True)
        )
        return (f"{self.number}  {self.name}{mark}", *(one.replace("-", "−") for one in written))

    @property
    def short_name(self) -> str:
        """Its name where there is little room: the number."""
        return f"{self.number} {NOISE_MARK}" if self.noisy else str(self.number)

    @property
    def shown(self) -> tuple[float, ...]:
        """Values in the units of the table."""
        *others, delay_s = self.values
        return (*others, delay_s * 1e3)


def rows_of(
    outputs: tuple[int, ...], figures: Statistics, above_noise_db: Floats | None, limb: str = ""
) -> tuple[Row, ...]:
    """A row for each selected output of a limb."""
    found = []
    columns = (
        figures.rms,
        figures.peak,
        figures.crest,
        figures.dominant_hz,
        figures.delay_s,
    )
    for rank, output in enumerate(outputs):
        above = np.inf if above_noise_db is None else above_noise_db[output - 1]
        found.append(
            Row(
                number=output,
                name=output_words(output, limb).short_name,
                values=tuple(float(column[rank]) for column in columns),
                noisy=bool(above < LEAST_ABOVE_NOISE_DB),
            )
        )
    return tuple(found)


def tab_separated(rows: tuple[Row, ...]) -> str:
    """The table for a spreadsheet: a header, then numbers that read back exactly."""
    header: tuple[str, ...] = ("output", "place", "rms_m_per_s2", "peak_m_per_s2")
    header += ("crest", "dominant_hz", "delay_ms", "mostly_noise")
    lines = ["\t".join(header)]
    for row in rows:
        numbers = map(copied, row.shown)
        lines.append("\t".join((str(row.number), row.name, *numbers, "yes" if row.noisy else "no")))
    return "\n".join(lines) + "\n"
