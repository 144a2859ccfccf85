"""Levels above threshold, and the ISO 5349-1 weighting of contacts."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from PySide6 import QtWidgets
from PySide6.QtCore import QSize, Qt

from skinsource.base.errors import SkinSourceError, printable
from skinsource.design.comparing import match_text
from skinsource.design.design import Design, View
from skinsource.design.panel_settings import settings_of
from skinsource.engine.analysis_rules import SILENT_DB, Sensation
from skinsource.limbs.locations import output_name
from skinsource.perception.thresholds import (
    AREA,
    LIMITS,
    PerceptionSettings,
    read_threshold_table,
    settings_table,
)
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.analysis.table import OutputTableView, TableRow
from skinsource_gui.qt.buttons import page_label, tool_button
from skinsource_gui.qt.fitting import FoldingRow, fit_to_letters, grouped
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.questions import ask_open, copied_level, tab_separated
from skinsource_gui.qt.theme import UNIT_PX, set_tone

#: Weighted RMS of each place in use, m/s²; None: drives are no accelerations of the probe.
Weighted = tuple[tuple[int, float], ...] | None

_NO_WEIGHTED = "The health weighting Wh needs drives that are accelerations of the probe"
_MOST_LISTED = 3
# Word joiners: a line does not break at the slash.
_UNIT = "m\u2060/\u2060s²"


def contact_text(weighted: Weighted, *, as_stored: bool = False) -> str:
    """Return the weighted RMS of the contacts as a sentence; of many places only the largest.

    ``as_stored``: other levels have a display gain that these do not have.
    """
    if weighted is None:
        return _NO_WEIGHTED
    if not weighted:
        return ""
    if len(weighted) <= _MOST_LISTED:
        levels = f"{_listed(weighted, ', ')} RMS"
    else:
        place, most = max(weighted, key=lambda pair: pair[1])
        levels = f"largest {most:.3g} {_UNIT} RMS at place {place}, of {len(weighted)} places"
    stored = ", with the amplitudes that were stored" if as_stored else ""
    return (
        "ISO 5349-1 Wh, a health weighting, not perception, of the probe itself from its first to "
        f"its last motion: {levels}{stored}"
    )


def contact_list(weighted: Weighted) -> str:
    """Return a line for each place; "" where the sentence names all of them."""
    if weighted is None or len(weighted) <= _MOST_LISTED:
        return ""
    return "Wh, RMS\n" + _listed(weighted, "\n")


def contact_table(weighted: Weighted) -> str:
    """Return all places for a spreadsheet, below an empty line; "" where there are none."""
    if not weighted:
        return ""
    lines = [f"{place}\t{value!r}" for place, value in weighted]
    return "\n".join(["", "place\tiso_5349_1_wh_rms_m_per_s2", *lines]) + "\n"


def _listed(weighted: tuple[tuple[int, float], ...], between: str) -> str:
    return between.join(f"place {place}: {value:.3g} {_UNIT}" for place, value in weighted)


_TITLES = {"P": "P\ndB", "NP I": "NP I\ndB", "own": "Own\ndB"}
_HINTS = {
    "P": "Above the threshold of the Pacinian channel, which governs high frequencies",
    "NP I": "Above the threshold of channel NP I, for low frequencies and the arm",
    "own": "Above the thresholds of your own table",
}


def header(sensation: Sensation) -> list[tuple[str, str]]:
    """Return titles and hints of the columns."""
    columns = [("Output", "Number and place"), ("SL\ndB", "Sensation level (lowest threshold)")]
    columns += [(_TITLES[name], _HINTS[name]) for name in sensation.by_channel]
    if sensation.strength is not None:
        hint = "Perceived intensity: larger channel plus half the smaller; compares on one limb"
        columns.append(("Strength", hint))
    return columns


def rows(sensation: Sensation, outputs: tuple[int, ...], limb: str = "") -> list[TableRow]:
    """Return the rows for outputs of a limb."""
    return [
        TableRow(
            output=output,
            texts=(
                f"{output}  {output_name(output, limb).short_name}",
                *map(_text, _numbers(sensation, output)),
            ),
        )
        for output in outputs
    ]


def table_text(sensation: Sensation, outputs: tuple[int, ...], limb: str = "") -> str:
    """Return the table for a spreadsheet; a cell is empty where the panel shows a dash."""
    names = ["output", "place", "above_threshold_db"]
    names += [f"{name.replace(' ', '_').lower()}_db" for name in sensation.by_channel]
    names += ["strength"] if sensation.strength is not None else []
    lines = (
        (
            str(output),
            output_name(output, limb).short_name,
            *map(copied_level, _numbers(sensation, output)),
        )
        for output in outputs
    )
    return tab_separated((names, *lines))


def _numbers(sensation: Sensation, output: int) -> list[float]:
    k = output - 1
    numbers = [
        float(sensation.level_db[k]),
        *(float(levels_db[k]) for levels_db in sensation.by_channel.values()),
    ]
    if sensation.strength is None:
        return numbers
    # A vibration without sensation has no strength either.
    perceived = sensation.level_db[k] > SILENT_DB
    return [*numbers, float(sensation.strength[k]) if perceived else SILENT_DB]


def _text(value: float) -> str:
    return "–" if value <= SILENT_DB else f"{value:z.1f}".replace("-", "−")


_OWN_LIMITS = (
    "Thresholds are those of your table, the same at every output; sensors and force are not "
    "modelled. Compare designs on one limb only."
)
_IMPORT_HINT = "Take thresholds from a CSV file: frequency_hz, threshold_m_per_s2 (RMS)"
_MOST_NAME_PX, _MOST_AREA_PX = 120, 96


class PerceptionView(OutputTableView):
    """A table of levels above threshold, the limits of such numbers, and the health weighting."""

    name: ClassVar[str] = "perception"
    needs = frozenset(
        {"sensation", "shown_outputs", "contact_weighted_rms", "limb_data", "match_gain"}
    )

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__("Sensation levels", parent)
        self.setMinimumSize(240, 160)
        self.settings = PerceptionSettings()
        self._sensation: Sensation | None = None
        self._outputs: tuple[int, ...] = ()
        self._limb = ""
        # Text on the display gain where levels are louder or softer than stored.
        self._matched = ""
        self._weighted: Weighted = None
        self._folder = Path()
        self.area = NumberField(AREA, widest_unit="cm²")
        fit_to_letters(self.area, _MOST_AREA_PX, at_most=True)
        self.area_label = QtWidgets.QLabel("Vibrating area")
        self.area_label.setBuddy(self.area)
        set_tone(self.area_label, "dim")
        self.own = tool_button(self, "perception_own", "Own thresholds…")
        hint = "Use the thresholds of the model again"
        self.model = tool_button(self, "perception_model", "Use the model", hint)
        self.contact = page_label("perception_contact", tone="dim")
        self.limits = page_label("perception_limits", LIMITS, tone="dim")
        gap_px = UNIT_PX // 2
        area = grouped(self.area_label, self.area, None, gap_px=gap_px)
        thresholds = grouped(self.own, self.model, None, gap_px=gap_px)
        bar = FoldingRow((area, thresholds), gap_px)
        parts = (bar, (self.stack, 1), self.contact, self.limits)
        margins = (UNIT_PX // 2, 1, UNIT_PX // 2, UNIT_PX // 2)
        in_column(*parts, of=self, margins=margins, gap_px=UNIT_PX // 2)
        self.area.edited.connect(lambda area_cm2, _: self._change(area_cm2=area_cm2))
        self.own.clicked.connect(self._ask)
        message = "Thresholds are those of the model"
        self.model.clicked.connect(lambda: self._change(message, table=(), source=""))
        self.say_instead(self.no_outputs)

    def sizeHint(self) -> QSize:
        return QSize(380, 320)

    def show_state(self, design: Design, view: View) -> None:
        self._view = view
        self.settings = settings_of(view, self.name, PerceptionSettings)
        own = bool(self.settings.thresholds)
        self.area.set_value(self.settings.area_cm2)
        self.area.setEnabled(not own)
        self.model.setVisible(own)
        name = self.settings.source or "Own table"
        middle = Qt.TextElideMode.ElideMiddle
        short = self.fontMetrics().elidedText(name, middle, _MOST_NAME_PX)
        self.own.setText(short if own else "Own thresholds…")
        self.own.setToolTip(f"{name}. {_IMPORT_HINT}" if own else _IMPORT_HINT)
        self.limits.setText(_limits(self.settings, self._sensation, self._matched))
        self.show_selection(view)

    def show_results(self, results: Mapping[str, Any]) -> None:
        sensation, outputs = results["sensation"], results["shown_outputs"]
        self._weighted = results["contact_weighted_rms"]
        self._matched = match_text(results["match_gain"])
        self.contact.setText(contact_text(self._weighted, as_stored=bool(self._matched)))
        self.contact.setToolTip(contact_list(self._weighted))
        if sensation.problem or not outputs:
            self.say_instead(sensation.problem or self.no_outputs)
            return
        self._sensation, self._outputs, self._limb = sensation, outputs, results["limb_data"].name
        self.limits.setText(_limits(self.settings, self._sensation, self._matched))
        self.show_rows(header(sensation), rows(sensation, outputs, self._limb))

    def show_staleness(self, stale: bool) -> None:
        super().show_staleness(stale)
        # The text is hidden: its single line has no room for the mark of stale results.
        self.contact.setHidden(stale)

    def show_problem(self, reason: str) -> None:
        super().show_problem(reason)
        self.contact.setText("")
        self.contact.setToolTip("")

    def show_folder(self, folder: Path) -> None:
        self._folder = folder

    def import_thresholds(self, path: Path) -> None:
        """Import the thresholds of a file and compare levels with them."""
        try:
            table = read_threshold_table(path)
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        message = f"Thresholds are those of {printable(path.name)}"
        self._change(message, table=settings_table(table), source=path.name[:200])

    def _ask(self) -> None:
        path = ask_open(self, "Own thresholds", "CSV (*.csv)", self._folder)
        if path is not None:
            self.import_thresholds(path)

    def say_instead(self, message: str) -> None:
        self._sensation, self._matched = None, ""
        self.limits.setText(_limits(self.settings, self._sensation, self._matched))
        super().say_instead(message)

    @property
    def words(self) -> str:
        return self.limits.text()

    def table_text(self) -> str:
        if self._sensation is None:
            return ""
        levels = table_text(self._sensation, self._outputs, self._limb)
        return levels + contact_table(self._weighted)

    def _change(self, message: str = "", **changes: Any) -> None:
        """Change settings; ``message`` is shown in any case, changed or not."""
        if message:
            self.done.emit(message)
        self.change_settings(**changes)


def _limits(settings: PerceptionSettings, sensation: Sensation | None, matched: str) -> str:
    """Return the limits of such numbers and the band that counts, after their display gain."""
    text = _OWN_LIMITS if settings.thresholds else LIMITS
    text = f"{matched}. {text}" if matched else text
    if sensation is None or sensation.band_hz is None:
        return text
    low_hz, high_hz = sensation.band_hz
    return f"{text} Only {low_hz:g} to {high_hz:g} Hz counts."
