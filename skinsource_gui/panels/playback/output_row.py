"""One place of the design: its output, how loud that is, and a tone to find it by."""

from functools import partial

from PySide6.QtCore import QObject, QSize, Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from skinsource.lab.playing.devices import MOST_OUTPUTS
from skinsource.limbs.locations import PlaceWords, input_words
from skinsource.specs.fields import NumberSpec
from skinsource_gui.played import Played
from skinsource_gui.theme import tabular
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.fitting_label import FittingLabel
from skinsource_gui.widgets.level_meter import LevelMeter
from skinsource_gui.widgets.room.letter_width import LetterWidth
from skinsource_gui.widgets.tooltips import show_tooltip

_METER_PX, _LEAST_METER_PX, _NUMBER_PX = 8, 48, 56
_WIDEST_LEVEL = "\u2212100.0 dBFS"
_SILENT_DB = -200.0


class OutputRow(QObject):
    """Its widgets stand in one row of a grid.

    Parameters
    ----------
    grid, row
        Where.
    place, output
        Input place, and the output, from 1, that drives its actuator.
    """

    #: The place, and the output that shall drive it.
    output_wanted = Signal(int, int)
    #: The output that shall play a tone.
    tone_wanted = Signal(int)

    def __init__(self, grid: QGridLayout, row: int, place: int, output: int, limb: str) -> None:
        super().__init__()
        words = input_words(place, limb)
        self.place = place
        self.title = _Title(place, words)
        spec = NumberSpec(
            label=f"Output of place {place}", minimum=1, maximum=MOST_OUTPUTS, whole=True
        )
        self.output = NumberField(spec, widest_unit="")
        self.output.setObjectName(f"output_of_{place}")
        self.output.setAccessibleName(spec.label)
        self.output.setToolTip("Number of the output of the device that its actuator is wired to")
        LetterWidth(self.output, _NUMBER_PX)
        self.output.edited.connect(self._choose)
        self.meter = LevelMeter()
        self.meter.setFixedHeight(_METER_PX)
        self.level = QLabel()
        self.level.setFont(tabular(self.level.font()))
        self.level.setObjectName(f"level_of_{place}")
        self.level.hide()
        self.loudness = _Loudness(self.meter, self.level)
        self.tone = QToolButton()
        self.tone.setText("Test tone")
        self.tone.setObjectName(f"tone_of_{place}")
        self.tone.clicked.connect(partial(self._ask_tone))
        for column, widget in enumerate(self.widgets):
            grid.addWidget(widget, row, column)
        self.show_output(output)

    @property
    def widgets(self) -> tuple[QLabel, NumberField, QWidget, QToolButton]:
        """From left to right."""
        return self.title, self.output, self.loudness, self.tone

    def show_output(self, output: int) -> None:
        """Show another output."""
        self.output.set_value(float(output))
        self.tone.setAccessibleName(f"Test tone on output {output}, place {self.place}")

    def show_played(self, played: Played) -> None:
        """Show how loud its output is, and whether a tone can be heard on it."""
        self._offer_tone(played.missing)
        index = round(self.output.value_si) - 1
        levels = played.levels
        if levels is None or index >= levels.rms_db.size:
            self.meter.show_level(_SILENT_DB, _SILENT_DB)
            self._say_level("")
            return
        self.meter.show_level(float(levels.rms_db[index]), float(levels.peak_db[index]))
        highest_db = float(levels.highest_db[index])
        self._say_level(
            "silent"
            if highest_db <= _SILENT_DB
            else f"{highest_db:z.1f} dBFS".replace("-", "\u2212")
        )

    def _choose(self, output: float, _gesture: int | None) -> None:
        self.output_wanted.emit(self.place, round(output))

    def _say_level(self, words: str) -> None:
        # Alone, the bar stands in the middle.
        self.level.setText(words)
        self.level.setVisible(bool(words))

    def _offer_tone(self, missing: str) -> None:
        self.tone.setEnabled(not missing)
        show_tooltip(
            self.tone,
            missing
            or f"0.6 s of 100 Hz on output {round(self.output.value_si)} alone, at the gain above, "
            f"to find the actuator of place {self.place}",
        )

    def _ask_tone(self) -> None:
        self.tone_wanted.emit(round(self.output.value_si))


class _Title(FittingLabel):
    """A place and its name, which gives way to what is pressed and typed; the number stays."""

    def __init__(self, place: int, words: PlaceWords) -> None:
        super().__init__()
        self._least = f"{place} · …"
        self.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.show_phrases((f"{place} · {words.name}", f"{place} · {words.short_name}"))
        self.setToolTip(words.name)

    def minimumSizeHint(self) -> QSize:
        least = self.fontMetrics().horizontalAdvance(self._least) + 4
        return QSize(least, super().minimumSizeHint().height())


class _Loudness(QWidget):
    """A bar, and its level below: beside it there would be no room in a narrow panel."""

    def __init__(self, meter: LevelMeter, level: QLabel) -> None:
        super().__init__()
        self._level = level
        below = QVBoxLayout(self)
        below.setContentsMargins(0, 0, 0, 0)
        below.setSpacing(2)
        below.addWidget(meter)
        below.addWidget(level)

    def minimumSizeHint(self) -> QSize:
        # Kept while nothing is heard: rows would widen, and cut what is beside them.
        room_px = self._level.fontMetrics().horizontalAdvance(_WIDEST_LEVEL)
        return QSize(max(room_px, _LEAST_METER_PX), super().minimumSizeHint().height())
