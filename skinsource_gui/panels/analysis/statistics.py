"""Figures of the selected outputs, as a table that can be copied."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtWidgets
from PySide6.QtCore import QSize

from skinsource.base.conventions import Floats
from skinsource.design.comparing import match_text
from skinsource.design.labels import signal_label, span_label
from skinsource.limbs.locations import output_name
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.analysis.statistics import BEGUN_SHARE, Statistics
from skinsource_gui.panels.analysis.table import OutputTableView, TableRow
from skinsource_gui.plots.figure import NoteLabel
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.questions import tab_separated
from skinsource_gui.qt.resources import columns_of
from skinsource_gui.qt.theme import UNIT_PX

#: Titles, and what they mean.
COLUMNS = tuple(columns_of("statistics", begun_share=BEGUN_SHARE).items())
NOISE_MARK = "≈"
NOISE_NOTE = f"{NOISE_MARK} less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise"


@dataclass(frozen=True, slots=True, kw_only=True)
class StatisticsRow:
    """One output: its name, its figures, and whether they are mostly those of noise."""

    number: int
    name: str
    values: tuple[float, ...]
    noisy: bool

    @property
    def texts(self) -> tuple[str, ...]:
        """The texts of a row; a dash where there is no number."""
        mark = f" {NOISE_MARK}" if self.noisy else ""
        written = (
            format(value, style).removesuffix(".") if np.isfinite(value) else "–"
            for value, style in zip(self.shown, ("#.3g", "#.3g", ".2f", ".1f", ".1f"), strict=True)
        )
        return (f"{self.number}{mark}  {self.name}", *(text.replace("-", "−") for text in written))

    @property
    def table_row(self) -> TableRow:
        """The row of the table."""
        return TableRow(
            output=self.number,
            texts=self.texts,
            hint=f"{self.texts[0]}: {NOISE_NOTE}" if self.noisy else "",
        )

    @property
    def shown(self) -> tuple[float, ...]:
        """Values in the units of the table."""
        *others, delay_s = self.values
        return (*others, delay_s * 1e3)


def rows_of(
    outputs: tuple[int, ...], figures: Statistics, above_noise_db: Floats | None, limb: str = ""
) -> tuple[StatisticsRow, ...]:
    """Return a row for each selected output of a limb."""
    rows = []
    columns = (figures.rms, figures.peak, figures.crest, figures.dominant_hz, figures.delay_s)
    for rank, output in enumerate(outputs):
        above = np.inf if above_noise_db is None else above_noise_db[output - 1]
        rows.append(
            StatisticsRow(
                number=output,
                name=output_name(output, limb).short_name,
                values=tuple(float(column[rank]) for column in columns),
                noisy=bool(above < LEAST_ABOVE_NOISE_DB),
            )
        )
    return tuple(rows)


def table_text(rows: tuple[StatisticsRow, ...]) -> str:
    """Return the table for a spreadsheet: a header, then numbers that read back exactly."""
    header: tuple[str, ...] = ("output", "place", "rms_m_per_s2", "peak_m_per_s2")
    header += ("crest", "dominant_hz", "delay_ms", "mostly_noise")
    lines = ((str(row.number), row.name, *row.shown, "yes" if row.noisy else "no") for row in rows)
    return tab_separated((header, *lines))


class StatisticsView(OutputTableView):
    """RMS, peak, crest factor, main frequency and delay of each selected output."""

    name: ClassVar[str] = "statistics"
    needs = frozenset(
        {"output_statistics", "shown_outputs", "above_noise_db", "limb_data"}
        | {"axes", "match_gain", "method", "span"}
    )

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__("Figures of the selected outputs", parent)
        self.setMinimumSize(240, 120)
        self.rows: tuple[StatisticsRow, ...] = ()
        self.about = NoteLabel("statistics_about")
        bar = in_row((self.about, 1), margins=(UNIT_PX, 1, UNIT_PX // 2, 1))
        in_column(bar, (self.stack, 1), of=self, margins=0, gap_px=0)
        self.say_instead(self.no_outputs)

    def sizeHint(self) -> QSize:
        return QSize(460, 260)

    def show_results(self, results: Mapping[str, Any]) -> None:
        outputs = results["shown_outputs"]
        if not outputs:
            self.say_instead(self.no_outputs)
            return
        figures, above_noise_db = results["output_statistics"], results["above_noise_db"]
        limb = results["limb_data"].name
        self.rows = rows = rows_of(outputs, figures, above_noise_db, limb)
        parts = (
            signal_label(results["axes"], results["method"]),
            f"RMS: {span_label(results['span'])}",
            match_text(results["match_gain"]),
            NOISE_NOTE if any(row.noisy for row in rows) else "",
        )
        self.about.say(" · ".join(filter(None, parts)))
        self.show_rows(COLUMNS, [row.table_row for row in rows])

    def say_instead(self, message: str) -> None:
        self.rows = ()
        self.about.say("")
        super().say_instead(message)

    @property
    def words(self) -> str:
        return self.about.whole

    def table_text(self) -> str:
        return table_text(self.rows)
