"""The skin map in time: how slowly it runs, and the controls for playhead and speed."""

from dataclasses import replace
from itertools import count

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QSignalBlocker, QSize, Qt, Signal

from skinsource.design.design import View
from skinsource.limbs.limb import LimbFacts
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.panels.skin.settings import MAGNITUDE, RMS, SkinSettings, Z, time_text
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.layouts import in_row, named, tooltip
from skinsource_gui.qt.theme import UNIT_PX, icon_of, tabular

#: How many times slower it can be chosen to run.
PACES = (1, 2, 5, 10, 20, 50, 100, 200)


def slow_down_factor(view: View, settings: SkinSettings, per_s: int, limb: LimbFacts) -> float:
    """Return the chosen slow motion, or the least at which a film shows the fastest motion.

    Fewer than two instants in a period of the fastest motion would show waves that do not exist.
    Therefore a film of a limb with a high sample rate runs more slowly than the window plays.
    """
    highest_hz = limb.band_hz[1] if limb.band_hz else limb.sample_rate_hz / 2.0
    # The length of a vector moves twice as fast.
    fastest_hz = {Z: highest_hz, MAGNITUDE: 2.0 * highest_hz, RMS: 1.0 / settings.rms_window_s}
    needed = 2.0 * fastest_hz[settings.quantity] / per_s
    if view.slow_motion >= needed:
        return view.slow_motion
    # The endless series 1, 2, 5, 10, 20, 50 and so on.
    paces = (digit * 10.0**power for power in count() for digit in (1.0, 2.0, 5.0))
    return next(pace for pace in paces if pace >= needed)


PACE = ChoiceSpec(
    label="Speed",
    options=tuple((str(pace), f"1/{pace}") for pace in PACES),
    hint="Speed of the animation; sound plays only at 1/1",
)
# The slider counts tenths of a millisecond.
_PER_S = 10_000
# Steps of an arrow key, and of Page Up.
_STEP, _PAGE = 10, 500


class ScrubBar(QtWidgets.QWidget):
    """A play button, a slider for the playhead, its time, and how fast time runs."""

    #: New time of the playhead, s.
    time_requested = Signal(float)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.play = QtWidgets.QToolButton(self)
        hint = f"{shortcut_text('pause')} pauses at the playhead, and continues."
        hint = tooltip(f"Play or stop ({shortcut_text('play')})", hint)
        named(self.play, "skin_play", "Play or stop", hint)
        self.play.setIconSize(QSize(14, 14))
        self.slider = QtWidgets.QSlider(Qt.Orientation.Horizontal, self)
        named(
            self.slider, "skin_time", "Time", "Drag through time; arrow keys step by a millisecond"
        )
        self.slider.setSingleStep(_STEP)
        self.slider.setPageStep(_PAGE)
        self.slider.valueChanged.connect(lambda tenths: self.time_requested.emit(tenths / _PER_S))
        self.time = QtWidgets.QLabel(self)
        self.time.setFont(tabular(self.time.font()))
        self.time.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        options = ("0", "Automatic"), *PACE.options, ("500", "1/500"), ("1000", "1/1000")
        self.pace = named(ChoiceField(replace(PACE, options=options), self), "skin_pace")
        self.pace.setMinimumContentsLength(5)
        row = self.play, (self.slider, 1), self.time, self.pace
        in_row(*row, of=self, margins=0, gap_px=UNIT_PX // 2)
        self.play.setIcon(icon_of("play"))

    def show_time(self, view: View, end_s: float) -> None:
        """Show playhead and speed in a response that ends at ``end_s``, without emitting them."""
        time_s = view.playhead_s
        self.pace.set_value(f"{view.slow_motion:g}")
        with QSignalBlocker(self.slider):
            self.slider.setMaximum(max(round(end_s * _PER_S), 1))
            self.slider.setValue(round(time_s * _PER_S))
        self.time.setText(time_text(time_s))
        # As wide as its widest text, so that the slider keeps its width.
        widest = self.time.fontMetrics().horizontalAdvance(time_text(max(end_s, time_s)) + "0")
        if self.time.minimumWidth() != widest:
            self.time.setMinimumWidth(widest)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self.play.setIcon(icon_of("play"))
