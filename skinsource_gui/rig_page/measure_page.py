"""The page on which one channel of a rig is measured."""

from functools import partial
from threading import Event

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import InvalidInputError, SkinSourceError, Stopped
from skinsource.base.quoting import sentence
from skinsource.lab.rig_measuring import (
    ChannelMeasurement,
    InputDevice,
    input_devices,
    measurable,
    measure,
)
from skinsource_gui.rig_page.measure_fields import MeasureFields, setup_of, setup_text
from skinsource_gui.rig_page.measured_curves import beside_the_model
from skinsource_gui.rig_page.measured_view import MeasuredView
from skinsource_gui.state.playing.sound_settings import SoundSettings
from skinsource_gui.state.playing.sound_thread import SoundThread
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.page_button import page_button

_INTRODUCTION = (
    "Fix the accelerometer to the contactor, and wire it to an input of the sound card. After two "
    "seconds of silence a quiet sweep comes, then those that are measured."
)
_LOOKING = "Looking for devices…"
_START = "Play the sweeps, and record them"
_READY = "Start plays on output {output}, at the level above."


class MeasurePage(QDialog):
    """Asks for the sensor, measures, shows what was found, and hands it on where it is kept.

    Parameters
    ----------
    channel
        What is measured.
    settings
        Of playing: the device where the channel names none, its rate and delay; and what was said
        of the sensor last.

    Attributes
    ----------
    fields, plot, words
        Its parts.
    found
        What was measured last; None: nothing was.
    """

    #: The `ChannelMeasurement` that shall be kept.
    kept = Signal(object)
    _told = Signal(int, int, str)  # from the thread

    def __init__(
        self,
        channel: RigChannel,
        settings: SoundSettings,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("measure_page")
        self.setWindowTitle(f"Measure place {channel.place}")
        self.resize(760, 640)
        self._channel, self._settings = channel, settings
        self._thread, self._stop = SoundThread(self), Event()
        self._running = self._looking = False
        self.found: ChannelMeasurement | None = None
        self.fields = MeasureFields(setup_of(settings.sensor_text), self)
        self.plot = MeasuredView()
        self.words, self._bar = QLabel(), QProgressBar()
        self.words.setObjectName("measure_words")
        self.words.setWordWrap(True)
        self.words.setTextFormat(Qt.TextFormat.PlainText)
        self.start = page_button("measure_start", "Start", _START)
        self.stop = page_button("measure_stop", "Stop", "Silence at once; nothing is kept")
        self.keep = page_button("measure_keep", "Keep", "Put it into the channel, with the date")
        self._close = page_button("measure_close", "Close", "Without keeping it")
        self._lay_out()
        self._connect()
        self._look()

    def done(self, result: int) -> None:
        """Fall silent, and close."""
        # Devices that are found from now on are nobody's business here.
        self._looking = False
        self._stop.set()
        self._thread.end(lambda: None)
        super().done(result)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._running:
            # What is heard ends first; pressed again, the page closes.
            self._stop.set()
        else:
            super().keyPressEvent(event)

    def _lay_out(self) -> None:
        about = QLabel(_INTRODUCTION)
        about.setWordWrap(True)
        self._bar.setTextVisible(False)
        kept = self._bar.sizePolicy()
        kept.setRetainSizeWhenHidden(True)
        self._bar.setSizePolicy(kept)
        self._bar.setAccessibleName("Progress")
        foot = QHBoxLayout()
        for button in (self.start, self.stop):
            foot.addWidget(button)
        foot.addWidget(self._bar, 1)
        for button in (self.keep, self._close):
            foot.addWidget(button)
        whole = QVBoxLayout(self)
        whole.setSpacing(UNIT_PX)
        whole.addWidget(about)
        whole.addWidget(self.fields.grid)
        whole.addWidget(self.plot, 1)
        whole.addWidget(self.words)
        whole.addLayout(foot)

    def _connect(self) -> None:
        self.start.clicked.connect(self._start)
        self.stop.clicked.connect(self._stop.set)
        self.keep.clicked.connect(self._keep)
        self._close.clicked.connect(self.reject)
        self.fields.refused.connect(self._say)
        self.fields.changed.connect(self._say_whether)
        self.plot.exports.failed.connect(self._say)
        self.plot.exports.written.connect(self._say)
        self._told.connect(self._show_progress, Qt.ConnectionType.QueuedConnection)
        self._settings.changed.connect(self._list_inputs)

    def _look(self) -> None:
        """Look for devices: what is played ends, and the sound card is free."""
        self._looking = True
        self._say(self._missing or _LOOKING)
        self._settings.look()
        self._show_state()

    def _list_inputs(self) -> None:
        if self._looking and self._settings.looked:
            self._looking = False
            self._thread.do(input_devices, self._show_inputs)

    def _show_inputs(
        self, found: tuple[InputDevice, ...] | None, error: SkinSourceError | None
    ) -> None:
        self.fields.show_inputs(found or ())
        self._say_whether()
        if error is not None and not self._missing:
            self._say(str(error))

    def _start(self) -> None:
        setup, channel = self.fields.setup, self._channel
        self._settings.sensor_text = setup_text(setup)
        self._stop.clear()
        self._running, self.found = True, None
        self.plot.show_measured(None, None, "Measuring…")
        self._say("Two seconds of silence first.")
        self._show_state()
        work = partial(
            measure,
            Rig(channels=(channel,)),
            channel.place,
            setup,
            output=self._settings.output,
            progress=self._told.emit,
            stop=self._stop.is_set,
        )
        self._thread.do(work, self._take)

    def _take(self, found: ChannelMeasurement | None, error: SkinSourceError | None) -> None:
        self._running, self.found = False, found
        self.plot.show_measured(found, self._channel)
        if found is not None:
            self._say(" ".join((*found.lines, *beside_the_model(found, self._channel))))
        else:
            self._say("Stopped." if isinstance(error, Stopped) else str(error))
        self._show_state()

    def _keep(self) -> None:
        if self.found is not None:
            self.kept.emit(self.found)
            self.accept()

    @property
    def _missing(self) -> str:
        """Why it cannot be measured, whatever devices there are; or ""."""
        try:
            measurable(self._channel, self.fields.setup, self._settings.output.sample_rate_hz)
        except InvalidInputError as error:
            return sentence(str(error))
        return ""

    def _say_whether(self) -> None:
        """Say that it can begin, or why it cannot; what was measured stays said."""
        if not self._looking and (self._missing or self.found is None):
            self._say(self._missing or _READY.format(output=self._channel.output))
        self._show_state()

    def _show_progress(self, done: int, total: int, words: str) -> None:
        if self._running:
            self._bar.setRange(0, total)
            self._bar.setValue(done)
            self._say(f"{words}…")

    def _show_state(self) -> None:
        self.fields.grid.setEnabled(not self._running)
        self.start.setEnabled(not (self._running or self._looking or self._missing))
        self.start.setToolTip(self._missing or _START)
        self.stop.setEnabled(self._running)
        self.keep.setEnabled(self.found is not None)
        self._bar.setVisible(self._running)

    def _say(self, words: str) -> None:
        self.words.setText(words if words.endswith(("…", ".")) else sentence(words))
