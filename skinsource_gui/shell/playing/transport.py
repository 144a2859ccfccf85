"""Play, repeat and gain, in the bar above the panels."""

from PySide6.QtCore import QEvent, QSize, Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from skinsource.lab.playing.mix import HIGHEST_DB, LOWEST_DB, START_DB
from skinsource.specs.fields import NumberSpec
from skinsource_gui.played import Played
from skinsource_gui.state.playing.gain_setting import DECIMALS
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.keys import shortcut_text
from skinsource_gui.widgets.level_meter import LevelMeter
from skinsource_gui.widgets.tooltips import tooltip
from skinsource_gui.widgets.transport_icons import play_icon, repeat_icon, stop_icon

GAIN = NumberSpec(
    label="Gain",
    unit="dB",
    minimum=LOWEST_DB,
    maximum=HIGHEST_DB,
    step=1.0,
    hint="How loud it is played: at 0 dB an amplitude of 1 is full scale of the device. Starts "
    f"at {START_DB:g} dB, and where a sample would pass full scale playing stops",
)
_WIDEST = minus(f"{LOWEST_DB:.{DECIMALS}f}")
_METER_PX = 3
_PLAY = "Play or stop", "Without a device the playhead runs in silence."
_REPEAT = (
    "Repeat",
    "Play the whole design again and again; a loop on the ruler is repeated in any case.",
)


class Transport(QWidget):
    """Shows what is played, and asks for it."""

    play_wanted = Signal()
    repeat_wanted = Signal()
    #: The gain that is wanted, dB.
    gain_wanted = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("transport")
        self._played = Played()
        self.play = self._button("play_button", "play", *_PLAY)
        self.play.clicked.connect(self.play_wanted)
        self.repeat = self._button("repeat_button", "repeat", *_REPEAT)
        self.repeat.setCheckable(True)
        self.repeat.clicked.connect(self.repeat_wanted)
        self.gain = NumberField(GAIN, widest_unit=GAIN.unit, widest_number=_WIDEST)
        self.gain.setObjectName("gain_field")
        self.gain.set_value(START_DB)
        self.gain.edited.connect(self._want_gain)
        self.meter = LevelMeter()
        self.meter.setFixedHeight(_METER_PX)
        column = QVBoxLayout()
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.gain)
        column.addWidget(self.meter)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(self.play)
        row.addWidget(self.repeat)
        row.addLayout(column)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self._show_icons()

    def show_played(self, played: Played) -> None:
        """Take over what is played, and how loud."""
        if played.playing != self._played.playing:
            self._played = played
            self._show_icons()
        self._played = played
        self.repeat.setChecked(played.loops)
        self.gain.set_value(played.gain_db)
        rms_db, peak_db = -200.0, -200.0
        if played.levels is not None:
            rms_db, peak_db = float(played.levels.rms_db.max()), float(played.levels.peak_db.max())
        self.meter.show_level(rms_db, peak_db)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._show_icons()

    def _show_icons(self) -> None:
        playing = self._played.playing
        self.play.setIcon((stop_icon if playing else play_icon)())
        self.play.setAccessibleName("Stop" if playing else "Play")
        self.repeat.setIcon(repeat_icon())

    def _button(self, name: str, action: str, title: str, hint: str) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(name)
        button.setIconSize(QSize(16, 16))
        title = f"{title} ({shortcut_text(action)})"
        button.setToolTip(tooltip(title, hint))
        button.setAccessibleName(title)
        return button

    def _want_gain(self, gain_db: float, _gesture: int | None) -> None:
        self.gain_wanted.emit(gain_db)
