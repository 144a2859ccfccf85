"""The skin map in time: its frames, and the controls for quantity, speed, playhead and limits."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import count as counted
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QRectF, QSignalBlocker, QSize, Qt, Signal

from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.design.labels import signal_label
from skinsource.design.view import View
from skinsource.engine.time_rules import Moving, SlidingEnergy, block_of
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.signals.map_range import map_range_db
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.skin.painting import MapContent, small_font
from skinsource_gui.panels.skin.scale import auto_button, paint_colour_scale
from skinsource_gui.panels.skin.settings import (
    MAGNITUDE,
    QUANTITY,
    RMS,
    RMS_WINDOW,
    STILL,
    LevelRange,
    MapQuantity,
    SkinSettings,
    Z,
    time_text,
)
from skinsource_gui.plots.colour_maps import DIVERGING, colour_table
from skinsource_gui.qt.frames import CachedPicture
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import UNIT_PX, current_theme, play_icon, tabular
from skinsource_gui.qt.tooltips import tooltip

#: Name of the result from which each quantity is made.
NEEDS = {Z: "moving_z", MAGNITUDE: "moving_vector", RMS: "moving_energy"}
# Along z colours reach their ends at this share of the largest acceleration, which under the
# actuator is far larger than elsewhere.
_SHARE_OF_LARGEST = 0.25


class Frames:
    """Makes frames from signals that are cached; transforms nothing.

    Attributes
    ----------
    made
        Number of frames that were made.
    """

    def __init__(self) -> None:
        self.made = 0
        self._signals: Moving | SlidingEnergy | None = None
        self._name = ""
        self._block = 0

    def update(self, results: Mapping[str, Any], name: str, view: View) -> None:
        """Take over signals for the quantity ``name``, computed for ``view``."""
        self._signals, self._name = results[NEEDS[name]], name
        self._block = block_of(view.playhead_s)

    def forget(self) -> None:
        """Drop the signals."""
        self._signals = None

    @property
    def known(self) -> bool:
        """Whether there are signals."""
        return self._signals is not None

    @property
    def largest(self) -> float:
        """The largest acceleration of the whole response, m/s²; 0 where nothing is known."""
        return 0.0 if self._signals is None else self._signals.largest

    @property
    def largest_db(self) -> Floats:
        """The largest acceleration as a level, dB, (1,), which the automatic range follows."""
        return decibels(np.array([self.largest]))

    def end_s(self, view: View) -> float:
        """Return the end of the response on the time axis of ``view``; 0 where nothing is known."""
        signals = self._signals
        if signals is None:
            return 0.0
        removed_s = signals.delay_s if view.delay_removed else 0.0
        return max((signals.response_samples - 1) / signals.sample_rate_hz - removed_s, 0.0)

    def has(self, view: View) -> bool:
        """Return whether the signals around the playhead of ``view`` are cached."""
        signals = self._signals
        if signals is None:
            return False
        at = response_time_s(view, signals.delay_s) * signals.sample_rate_hz
        return at >= signals.response_samples or signals.first <= at <= max(signals.end, 1)

    def runs_out(self, view: View) -> bool:
        """Return whether other signals should be requested: soon the playhead leaves these."""
        signals = self._signals
        if signals is None or (signals.first == 0 and signals.end >= signals.response_samples):
            return False
        return block_of(view.playhead_s) != self._block

    def content(
        self,
        before: MapContent,
        view: View,
        settings: SkinSettings,
        surface: SurfaceOperator | None,
        matched: str = "",
    ) -> MapContent:
        """Return the content of the map at the playhead of ``view``.

        Parameters
        ----------
        before
            The content without values.
        surface
            Interpolates between outputs; None: sensors carry the colours.
        matched
            By how much it is louder or softer than it was stored, or "".
        """
        signals = self._signals
        if signals is None:
            raise LookupError("there are no signals to make a frame of")
        self.made += 1
        at_s = response_time_s(view, signals.delay_s)
        if isinstance(signals, SlidingEnergy):
            values = decibels(signals.rms(at_s, settings.rms_window_s))
        elif self._name == Z:
            values = signals.acceleration(at_s)[:, 0]
        else:
            values = decibels(signals.magnitude(at_s))
        quantity = MapQuantity(
            name=self._name,
            span=view.span,
            signal=signal_label(view.axes, view.method),
            window_s=settings.rms_window_s,
            time_s=view.playhead_s,
            matched=matched,
        )
        chosen = settings.z_limits if quantity.signed else settings.moving_range_db
        return replace(
            before,
            values=values,
            field_values=None if surface is None else surface.interpolate(values),
            quantity=quantity,
            value_range=self.value_range(settings),
            fixed=chosen is not None,
            colours=DIVERGING if quantity.signed else settings.colours,
        )

    def value_range(self, settings: SkinSettings) -> LevelRange:
        """Return values of the lowest and the highest colour: the same at each instant."""
        if settings.quantity == Z:
            return settings.z_limits or self._usual_limits()
        return settings.moving_range_db or map_range_db(self.largest_db)

    def _usual_limits(self) -> LevelRange:
        limit = _round_up(self.largest * _SHARE_OF_LARGEST) if self.largest > 0.0 else 1.0
        return -limit, limit


def response_time_s(view: View, delay_s: float) -> float:
    """Return the playhead's time in the response, which contains the pre-trigger delay."""
    return view.playhead_s + (delay_s if view.delay_removed else 0.0)


def _round_up(value: float) -> float:
    """Return the next number that begins with 1, 2 or 5."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= value))


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
    return next(pace for pace in _paces() if pace >= needed)


def _paces() -> Iterator[float]:
    """Return the endless series 1, 2, 5, 10, 20, 50 and so on."""
    return (digit * 10.0**power for power in counted() for digit in (1.0, 2.0, 5.0))


PACE = ChoiceSpec(
    label="Speed",
    options=tuple((str(pace), f"1/{pace}") for pace in PACES),
    hint="How fast time runs while it plays; below 1/1 it is seen, and not heard",
)
_PACE_PX, _WINDOW_PX = 76, 66
# Width of the arrow and edges of a list, px.
_ARROW_PX = 40


class QuantityRow(QtWidgets.QWidget):
    """Fields for the quantity of the map, its window, and the speed of playing."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.quantity = ChoiceField(QUANTITY, self)
        self.quantity.setObjectName("skin_quantity")
        self.rms_window = NumberField(RMS_WINDOW, self, widest_unit="ms")
        self.rms_window.setObjectName("skin_rms_window")
        self.rms_window.setAccessibleName(RMS_WINDOW.label)
        self.rms_window.setToolTip(tooltip(RMS_WINDOW.label, RMS_WINDOW.hint))
        self.pace = ChoiceField(PACE, self)
        self.pace.setObjectName("skin_pace")
        self.pace.setMinimumContentsLength(4)
        in_row(
            (self.quantity, 1), self.rms_window, self.pace, of=self, margins=0, gap_px=UNIT_PX // 2
        )
        self._fit()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()

    def show_settings(self, settings: SkinSettings, slow_motion: float) -> None:
        """Show the present choice."""
        self.quantity.set_value(settings.quantity)
        self.rms_window.setVisible(settings.quantity == RMS)
        self.rms_window.set_value(settings.rms_window_s)
        self.pace.setVisible(settings.quantity not in STILL)
        self.pace.set_value(f"{slow_motion:g}")

    def _fit(self) -> None:
        metrics = self.fontMetrics()
        pace = metrics.horizontalAdvance("1/200") + _ARROW_PX
        window = metrics.horizontalAdvance("500 ms") + 3 * UNIT_PX
        self.pace.setFixedWidth(max(_PACE_PX, pace))
        self.rms_window.setFixedWidth(max(_WINDOW_PX, window))


# The slider counts tenths of a millisecond.
_PER_S = 10_000
# Steps of an arrow key, and of Page Up.
_STEP, _PAGE = 10, 500


class ScrubBar(QtWidgets.QWidget):
    """A play button, a slider for the playhead, and its time."""

    #: New time of the playhead, s.
    time_requested = Signal(float)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.play = QtWidgets.QToolButton(self)
        self.play.setObjectName("skin_play")
        self.play.setIconSize(QSize(14, 14))
        self.play.setAccessibleName("Play or stop")
        self.play.setToolTip(
            tooltip(
                f"Play or stop ({shortcut_text('play')})",
                f"{shortcut_text('pause')} stops where the playhead is, and goes on.",
            )
        )
        self.slider = QtWidgets.QSlider(Qt.Orientation.Horizontal, self)
        self.slider.setObjectName("skin_time")
        self.slider.setAccessibleName("Time")
        self.slider.setToolTip("Drag through time; arrow keys step by a millisecond")
        self.slider.setSingleStep(_STEP)
        self.slider.setPageStep(_PAGE)
        self.slider.valueChanged.connect(lambda tenths: self.time_requested.emit(tenths / _PER_S))
        self.time = QtWidgets.QLabel(self)
        self.time.setFont(tabular(self.time.font()))
        self.time.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        in_row(self.play, (self.slider, 1), self.time, of=self, margins=0, gap_px=UNIT_PX // 2)
        self.play.setIcon(play_icon())

    def show_time(self, time_s: float, end_s: float) -> None:
        """Show the playhead in a response that ends at ``end_s``, without emitting it."""
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
            self.play.setIcon(play_icon())


_LIMIT = NumberSpec(
    label="Limit",
    unit="m/s²",
    minimum=1e-6,
    maximum=1e6,
    hint="Acceleration along z at the end of the colours, either way",
)
_RAMP_LEFT, _RAMP_WIDTH, _END_PX = 4, 14, 8


class SignedStrip(QtWidgets.QWidget):
    """Colours of signed values, with ticks."""

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.limits: LevelRange = (-1.0, 1.0)
        self._matched = ""
        self._scale = CachedPicture()
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMinimumHeight(70)

    def show_scale(self, limits: LevelRange, matched: str) -> None:
        """Show limits, and by how much the response is louder or softer than it was stored."""
        if (limits, matched) != (self.limits, self._matched):
            self.limits, self._matched = limits, matched
            self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setFont(tabular(small_font(self.font())))
        ground = self.palette().window().color()
        key = (self.limits, current_theme(), self._matched)
        self._scale.paint(painter, QRectF(self.rect()), key, self._paint, ground)
        painter.end()

    def _paint(self, painter: QtGui.QPainter) -> None:
        # The numbers reach beyond the ends by half of their height.
        end = max(_END_PX, painter.fontMetrics().height() / 2)
        ramp = QRectF(_RAMP_LEFT, end, _RAMP_WIDTH, self.height() - 2 * end)
        limits, table = self.limits, colour_table(DIVERGING)
        quantity = MapQuantity(name=Z, matched=self._matched)
        paint_colour_scale(painter, ramp, limits, limits, table, current_theme(), quantity)


class SignedBar(QtWidgets.QWidget):
    """A strip of signed values, a field for its limit, and a switch for the automatic one."""

    #: The chosen limits, or None for the automatic ones.
    limits_chosen = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.limit = NumberField(_LIMIT, self)
        self.limit.setObjectName("z_limit")
        self.limit.setAccessibleName(_LIMIT.label)
        self.limit.setToolTip(tooltip(_LIMIT.label, _LIMIT.hint))
        self.limit.setSizePolicy(
            QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed
        )
        self.strip = SignedStrip(self)
        self.auto_button = auto_button(
            self,
            "z_auto",
            "Automatic limit",
            "The limit follows the design: a quarter of the largest acceleration along z anywhere",
        )
        in_column(
            self.limit, (self.strip, 1), self.auto_button, of=self, margins=0, gap_px=UNIT_PX // 2
        )
        self.setFixedWidth(self._width())
        self.limit.edited.connect(self._choose)
        self.auto_button.clicked.connect(self._switch)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.setFixedWidth(self._width())

    def show_limits(self, limits: LevelRange, *, automatic: bool, matched: str) -> None:
        """Show limits, whether they follow the design, and the gain of what is shown."""
        self.limit.set_value(limits[1])
        self.strip.show_scale(limits, matched)
        self.auto_button.setChecked(automatic)

    def _choose(self, limit: float, _gesture: object) -> None:
        self.limits_chosen.emit((-limit, limit))

    def _switch(self, automatic: bool) -> None:
        self.limits_chosen.emit(None if automatic else self.strip.limits)

    def _width(self) -> int:
        return self.fontMetrics().horizontalAdvance("0.0005 m/s²") + 2 * UNIT_PX
