"""The stage: title and sentence, maps in motion, traces and one knob, for people further off."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import isclose, sqrt
from textwrap import shorten
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import (
    QEvent,
    QLineF,
    QPointF,
    QRectF,
    QSignalBlocker,
    QSize,
    Qt,
    QTimer,
    Signal,
)

from skinsource.base.conventions import Floats, axes_text
from skinsource.base.errors import InvalidInputError, counted
from skinsource.design import edits
from skinsource.design.amplitudes import amplitude_spec, amplitude_unit, is_gain
from skinsource.design.clips import ONSET as ONSET_SPEC
from skinsource.design.clips import Clip
from skinsource.design.comparing import common_title
from skinsource.design.design import AMPLITUDE_GAIN, EDITED, Design, Input, View
from skinsource.design.display_units import value_text
from skinsource.design.edits.edit import Edit, clip_of, leading_input
from skinsource.design.panel_settings import (
    AMPLITUDE,
    CONTROL,
    FREQUENCY,
    ONSET,
    STAGE,
    StageSettings,
    settings_of,
    stage_settings,
    with_settings,
)
from skinsource.engine.loops import Loop, first_onset_s
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.analysis.wave_speed import arrivals
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.studies import scenes
from skinsource.studies.checking import bands_shown, proportion, strengths_of
from skinsource_gui.fields.editor import Burst
from skinsource_gui.fields.number_field import DRAG_BEGINS_PX, NumberField
from skinsource_gui.fields.units import minus, output_text, parse_number
from skinsource_gui.panels.compare.content import (
    ALL_AXES,
    KINDS,
    Kind,
    Names,
    OfWindow,
    noisy_outputs,
)
from skinsource_gui.panels.compare.maps import MapsPanel
from skinsource_gui.panels.compare.motion import rounded
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.plots.curves import output_names
from skinsource_gui.plots.figure import Axis, Figure, shrunk
from skinsource_gui.plots.ranges import Tick, readable_ticks
from skinsource_gui.plots.small_map import Range, offer_arm
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.frames import CachedPicture, Same
from skinsource_gui.qt.keys import KEYS, shortcut_text
from skinsource_gui.qt.layouts import Policy, in_column, in_row, named
from skinsource_gui.qt.theme import UNIT_PX, current_theme, letter_scale, tabular
from skinsource_gui.state.compared import Compared

_ALONE = OfWindow()
# Between the names of curves; from where to where those in rows reach, from their middle.
_BETWEEN, _REACH = "   ", np.array([-0.45, 0.45])


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve:
    """A trace, a spectrum, or a line that is fitted to dots.

    Attributes
    ----------
    names, rank
        Its names, the longest first, and the rank of its colour.
    x, y
        Its points.
    dots
        Heights of dots over ``x``; None: there are none.
    arrival
        Where it arrives along x; None: that is not known.
    """

    names: Names
    rank: int
    x: Floats
    y: Floats
    dots: Floats | None = None
    arrival: float | None = None


class Strip(Figure):
    """Traces or spectra over one axis, and where the motion is.

    Attributes
    ----------
    curves, ends, marked
        What is drawn, the ends of x and y, and which x is marked; None: none is.
    ticks
        Of x, below the curves.
    in_rows
        Whether each curve has a row of height 1, and its name beside it, if there is room for all.
    """

    def __init__(self) -> None:
        super().__init__("stage_traces", "Traces")
        self.curves: tuple[Curve, ...] = ()
        self.marked: float | None = None
        self.ticks: tuple[Tick, ...] = ()
        self.ends: tuple[Range, Range] = ((0.0, 1.0), (-1.0, 1.0))
        self._words, self.in_rows = ("", "", ""), False
        self._picture = CachedPicture()
        self.setMouseTracking(False)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

    def show_curves(
        self, curves: tuple[Curve, ...], ends: tuple[Range, Range], words: tuple[str, str, str]
    ) -> None:
        """Draw curves between ends of x and y; words say where, and what the ends are."""
        self.curves, self.ends, self._words = curves, ends, words
        self.setVisible(bool(curves))
        called = ", ".join(curve.names[0] for curve in curves)
        self.setAccessibleName(f"{called}; {words[1]}" if curves else "")
        self.update()

    def show_cursor(self, x: float | None) -> None:
        """Mark an instant; None, or one beyond the end: none is."""
        self.marked = None if x is None or x > self.ends[0][1] else x
        self.update()

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        painter.setFont(tabular(self.font()))
        theme = current_theme()
        key = (Same(self.curves), self.ends, theme)
        ground = QtGui.QColor(theme.base)
        self._picture.paint(painter, room, key, self._paint, ground)
        if self.marked is not None and self.curves:
            area, (low, high) = self._area(), self.ends[0]
            x = area.left() + area.width() * (self.marked - low) / (high - low)
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 2))
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
            # Left of what stands in the corner, where names leave room.
            corner = self._words[0] and f"{_BETWEEN}{self._words[0]}"
            text = minus(f"{1e3 * self.marked:.1f} ms") + corner
            left = area.right() - painter.fontMetrics().horizontalAdvance(text)
            painter.drawText(
                QPointF(left, 0.9 * painter.fontMetrics().height()), text.removesuffix(corner)
            )

    @property
    def _has_rows(self) -> bool:
        line = self.fontMetrics().height()
        return self.in_rows and self.height() >= (len(self.curves) + 2.8) * line

    def _area(self) -> QRectF:
        line = 1.4 * self.fontMetrics().height()
        below = line * (1.6 if self.ticks else 1.0)
        room = QRectF(self.rect()).adjusted(UNIT_PX, line, -UNIT_PX, -below)
        if self._has_rows:
            width_of = QtGui.QFontMetricsF(tabular(self.font())).horizontalAdvance
            room.setLeft(2 * UNIT_PX + max(map(width_of, self._labels(room.width()))))
        return room

    def _paint(self, painter: QtGui.QPainter) -> None:
        theme, area, line = current_theme(), self._area(), painter.fontMetrics().height()
        room = QRectF(self.rect()).adjusted(UNIT_PX, 0.0, -UNIT_PX, 0.0)
        left_side, right_side = Qt.AlignmentFlag.AlignLeft, Qt.AlignmentFlag.AlignRight
        pen_px, ((x_low, x_high), (y_low, y_high)) = max(line / 9.0, 1.5), self.ends

        def points(x: Floats, y: Floats | float) -> list[QPointF]:
            across = area.left() + area.width() * (x - x_low) / (x_high - x_low)
            up = area.bottom() - area.height() * (y - y_low) / (y_high - y_low) + 0.0 * x
            return list(map(QPointF, across.tolist(), up.tolist()))

        left, ends = area.left(), np.array([x_low, x_high])
        in_rows, labels = self._has_rows, self._labels(room.width())
        y_high += len(labels) - 1 if in_rows else 0
        for row, (curve, label) in enumerate(zip(self.curves, labels, strict=True), 1):
            lifted = len(labels) - row if in_rows else 0.0
            middle = lifted + sum(self.ends[1]) / 2
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
            if in_rows or row == 1:
                painter.drawPolyline(points(ends, middle))
            painter.setPen(theme.output_pen(curve.rank, pen_px))
            painter.save()
            painter.setClipRect(area.adjusted(0.0, -pen_px, 0.0, pen_px))
            painter.drawPolyline(points(curve.x, lifted + curve.y))
            if curve.arrival is not None:
                if in_rows:
                    painter.setPen(QtGui.QPen(QtGui.QColor(theme.text), pen_px))
                painter.drawPolyline(points(np.full(2, curve.arrival), middle + _REACH))
            painter.restore()
            painter.setBrush(theme.output_colour(curve.rank))
            for dot in points(curve.x, curve.dots) if curve.dots is not None else ():
                painter.drawEllipse(dot, 2 * pen_px, 2 * pen_px)
            at = QPointF(left, 0.9 * line)
            if in_rows:
                at = QPointF(room.left(), points(ends, middle)[0].y() + 0.3 * line)
            painter.drawText(at, label)
            left += painter.fontMetrics().horizontalAdvance(f"{label}{_BETWEEN}")
        painter.setPen(QtGui.QColor(theme.dim))
        for tick in self.ticks:
            (at,) = points(np.array([tick.value]), y_low)
            painter.drawLine(at, at - QPointF(0.0, line / 4))
            place = QRectF(at.x() - 2 * line, at.y(), 4 * line, line)
            painter.drawText(place, Qt.AlignmentFlag.AlignHCenter, tick.label)
        below = room.adjusted(0.0, self.height() - 1.2 * line, 0.0, 0.0)
        joined = _BETWEEN.join(self._words[1:])
        painter.drawText(room, right_side, self._words[0])
        painter.setFont(shrunk(painter.font(), [joined], room.width()))
        painter.drawText(below, left_side, self._words[1])
        painter.drawText(below, right_side, self._words[2])

    def _labels(self, room_px: float) -> Sequence[str]:
        """Return the longest names for which all curves have room beside the words."""
        metrics = QtGui.QFontMetricsF(tabular(self.font()))
        longest = max(len(curve.names) for curve in self.curves)
        for k in range(longest):
            labels = [curve.names[min(k, len(curve.names) - 1)] for curve in self.curves]
            text = _BETWEEN.join((*labels, "0000.0 ms", self._words[0]))
            if self._has_rows:
                text = 3 * max(labels, key=metrics.horizontalAdvance)
            if metrics.horizontalAdvance(text) <= room_px:
                break
        return labels


# Steps of the whole turn, of an arrow key or a notch of the wheel.
_STEPS, _STEP = 1000, 5
# What a drag turns: steps for a pixel up; and the angle of the whole turn, as Qt draws it.
_STEPS_PER_PX, _SWEEP_DEG = 4.0, 300.0
# Ends of the turn, where those of the number are too far apart.
_ENDS = {"amplitude": (0.01, 100.0), "onset_s": (0.0, 0.2)}


class Dial(QtWidgets.QDial):
    """Turned by how far the mouse moves: up and down, or round where the drag begins sideways."""

    _at, _round, _reached = QPointF(), False, 0.0

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self._at, self._reached = event.position(), -1.0
        self.setSliderDown(event.button() == Qt.MouseButton.LeftButton)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        at, middle = event.position(), QRectF(self.rect()).center()
        by = at - self._at
        if not self.isSliderDown() or (self._reached < 0 and by.manhattanLength() < DRAG_BEGINS_PX):
            return
        if self._reached < 0:
            self._round, self._reached = abs(by.x()) > abs(by.y()), self.value()
        clockwise = QLineF(middle, at).angleTo(QLineF(middle, self._at))
        turned = (clockwise + 180.0) % 360.0 - 180.0
        steps = turned / _SWEEP_DEG * _STEPS if self._round else -_STEPS_PER_PX * by.y()
        self._at, self._reached = at, min(max(self._reached + steps, 0.0), _STEPS)
        self.setValue(round(self._reached))

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self.setSliderDown(False)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        # A slip in front of people would turn it to an end, where little was measured.
        if event.key() not in (Qt.Key.Key_Home, Qt.Key.Key_End):
            super().keyPressEvent(event)


class Knob(QtWidgets.QWidget):
    """A large dial for one number, which stands below it and can be typed."""

    #: The new value, and the number of its gesture.
    edited = Signal(float, object)

    def __init__(self) -> None:
        super().__init__()
        self.label = page_label("stage_number", tone="dim", centred=True)
        self.dial = named(Dial(), "stage_dial")
        self.field = NumberField(ONSET_SPEC)
        self._axis, self._burst = Axis(shown=(0.0, 1.0), title=""), Burst(self)
        # The maps have the room first.
        self.dial.setSizePolicy(Policy.Preferred, Policy.Ignored)
        self.dial.setRange(0, _STEPS)
        self.dial.setSingleStep(_STEP)
        self.dial.setPageStep(10 * _STEP)
        self.dial.valueChanged.connect(self._turn)
        self.field.edited.connect(self.edited)
        self.field.setAlignment(Qt.AlignmentFlag.AlignCenter)
        parts, gap_px = (self.label, (self.dial, 1), self.field), UNIT_PX // 2
        self.column = in_column(*parts, of=self, margins=0, gap_px=gap_px)
        self.setFocusProxy(self.dial)

    def show_number(self, name: str, spec: NumberSpec, value: float, of: str = "") -> None:
        """Show a number of this name; ``of``: whose it is."""
        low, high = _ENDS.get(name) or spec.measured_band_hz or (spec.minimum, spec.maximum)
        self._axis = Axis(shown=(low, high), title="", log=low > 0.0)
        share = self._axis.part(np.array(min(max(value, low), high)))
        self.label.setText(f"{spec.label}{of}")
        for part in (self.dial, self.field):
            part.setAccessibleName(self.label.text())
        self.field.set_spec(spec)
        self.field.set_value(float(f"{value:.4g}"))
        with QSignalBlocker(self.dial):
            self.dial.setValue(round(_STEPS * float(share)))

    def _turn(self, step: int) -> None:
        value = self._axis.value(step / _STEPS)
        self.edited.emit(float(f"{value:.3g}"), self._burst.gesture())


# Heights of letters, in that of the panel: title, sentence, other words.
_LETTERS = (0.05, 0.034, 0.022)
# The least height of the dial, in that of the panel: with larger letters, too.
_LEAST_DIAL = 0.105
# Of the strip: lines of letters; least height of curves, and what words leave them.
_LINES_OF_STRIP, _CURVES = 2.6, (0.03, 0.22)
# In the width: words beside a map, the knob below several.
_BESIDE, _BESIDE_SEVERAL = 0.52, 0.14
# Above several maps and beside one, words take the first share of the height at most, more of it
# with larger letters, and never more than the second.  Letters are made smaller until they are half
# as large as usual, those of a title sooner; then less is said, and no more letters than this.
_WORDS, _MOST_LETTERS = {True: (0.2, 0.36), False: (0.35, 0.5)}, 600
_SMALLER, _TITLE_SMALLER, _LEAST_LETTERS = 0.95, 0.8, 0.5
# How many periods are drawn of a steady tone, and of what passes; height of spectra.
_PERIODS = {False: 3.0, True: 1.0}
_SPECTRUM_DB = 60.0
# Curves of other outputs that are so much weaker than what was shown are not to be seen.
_SUNK_DB = 12.0
#: A list of what can be turned has the numbers of so many inputs.
MOST_OFFERED = 12
# When curves that a turn of the knob has cut are fitted, after the last turn.
_RESTS_MS = 1000


# Begins what is to be tried, and all that stays true; ends a title that numbers were left out of; a
# number and its unit; a level, share or length, which follows from other numbers.
_TRY = "Try"
_LASTING, _EDITED = (_TRY, "Measured", "The skin itself"), " · edited"
_QUANTITY = re.compile(r"(\d+(?:[.,]\d+)?)[\s-]?([^\W\d]\S*?)(?=[\s,.:;()-]|$)")
_RESULT = re.compile(r"\d\s?(?:dB|%|[cmµ]m)")


class StagePanel(MapsPanel):
    """What is presented of a design; nothing else can be edited there but one number.

    Attributes
    ----------
    heading, sentence
        Title of the design, and the first line of its notes.
    strip, knob
        Traces, and the number that is turned.
    named
        Returns what a design without a title is called; set by the window.
    """

    title: ClassVar[str] = "Stage"
    name: ClassVar[str] = STAGE

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.heading, self.sentence = page_label("stage_title"), page_label("stage_sentence")
        self.strip, self.knob = Strip(), Knob()
        self.caution, self._caution = page_label("stage_caution", tone="warning"), ("", "")
        self.arm, self.switch = QtWidgets.QCheckBox("Arm"), QtWidgets.QCheckBox("Compare")
        keys = KEYS["presenting"].gestures
        named(self.switch, "stage_compare", hint=keys["compare"].hint)
        self.switch.clicked.connect(self.compare)
        named(self.arm, "stage_arm", hint=keys["arm"].hint)
        self.knob.dial.setToolTip(keys["fit"].hint)
        self.arm.clicked.connect(self.show_arm)
        self.maps.arm_shown.connect(self._follow_arm)
        self._switches = in_column(self.arm, self.switch, margins=0)
        self._line = in_row((self.caution, 1), self._switches)
        self.named: Callable[[], str] = str
        self._held_ends: tuple[Range, Range] | None = None
        self._passes = self._cut = self._sunk = False
        # How long maps that do not repeat together had run where the curves begin.
        self._since_s = 0.0
        self._rest = QTimer(self, singleShot=True, interval=_RESTS_MS)
        self._rest.timeout.connect(self._fit_cut)
        self._shown: tuple[Any, ...] = ()
        self._said: tuple[tuple[QtWidgets.QLabel, str, str], ...] = ()
        # The design of which title and notes were first said.
        self._said_of: dict[tuple[str, str], Design] = {}
        self._track: Input | None = None
        self._turned = ""
        self.maps.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        # On a single map the wave is to be seen on the arm, too.
        self.maps.least_lines, self.maps.several_on_hands = 9.0, True
        self.knob.edited.connect(self._turn)
        self.guessed = self.maps, self.strip
        self.setFocusProxy(self.knob)
        self._grid = QtWidgets.QGridLayout(self)
        self._several: bool | None = None
        self._lay_out(several=False)

    @property
    def needs(self) -> frozenset[str]:
        # The strip shows motion beside levels too.
        return super().needs | self.needs_of_motion

    @property
    def needs_of_motion(self) -> frozenset[str]:
        motion = super().needs_of_motion
        return motion | {ALL_AXES} if motion and self._together else motion

    @property
    def _together(self) -> bool:
        """Whether spectra are of all axes together: where those of each are shown elsewhere."""
        layout = dict(dict(self.view.panels).get("spectra", ())).get("layout")
        spectra = stage_settings(self.view).plot == "spectra"
        return spectra and layout == "axes" and self.kind is not KINDS["axes"]

    def sizeHint(self) -> QSize:
        return QSize(1200, 700)

    def show_state(self, design: Design, view: View) -> None:
        stage, compare = stage_settings(view), settings_of(view, "compare", CompareSettings)
        kind = _compared(design, view, compare) if stage.compared else _ALONE
        self.switch.setChecked(stage.compared)
        self._show_knob(design, view)
        compared = view.snapshots if kind is KINDS["snapshots"] else ()
        self._show_words(design, view, [each.design.title for each in compared])
        shown = kind, compare, stage, view.axes, design.limb
        others = view.outputs != self.view.outputs
        if shown != self._shown or (others and (design != self.design or not self.strip.curves)):
            self._shown = shown
            self._release()
        elif others:
            # It is seen which output is louder.
            self._held_ends = self._held_ends or self.strip.ends
            self._rest.start()
        layout = dict(dict(view.panels).get("traces", ())).get("layout")
        self.moving.passes = kind is _ALONE and layout == "stacked" and stage.plot == "traces"
        self.take_state(design, view, kind, compare, moves=stage.moves)

    def start_over(self) -> None:
        self._said_of.clear()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        # The name of a map is the title of its design.
        super().show_snapshots([self._with_title_now(side) for side in compared])

    def show_maps(self) -> None:
        super().show_maps()
        several = len(self.maps.content.cells) > 1
        self._lay_out(several=several)
        # Of several maps, traces are of one output.
        self.maps.picker.toggles = not several
        if not self.moves and self.maps.content.cells:
            names = self.kind.names(self.compared, self.view)
            self.moving.update(self.compared, names)
        self._show_traces()
        self.show_caution(*self._caution)

    def reset_range(self) -> None:
        super().reset_range()
        self._release()

    def show_caution(self, text: str, about: str) -> None:
        self._caution = text, about
        # The noise is that of the noisiest map.
        counts = [len(noisy_outputs(side)) for side in self.compared]
        if most := max(counts, default=0):
            names = self.kind.names(self.compared, self.view)
            noisiest = names[counts.index(most)]
            several, content = len(counts) > 1, self.maps.content
            hatches = not self.moves and content.is_hatched(hand_only=self.maps.places.low)
            of = f"{noisiest[-1]}: " * several
            noise = f"{of}{counted(most, 'output')} near the noise{', hatched' * hatches}"
            about += f"\n{'Hatched' if hatches else 'Near the noise'}: mostly noise"
            if not self.moves and self.kind.drawn_as(self.settings) != "levels":
                # Of no map it is the number.
                noise = "outputs near the noise"
            elif several:
                about += f"; most in {noisiest[0]}, which are counted"
            text = f"{text}; {noise}" if text else f"⚠ {noise[0].upper()}{noise[1:]}"
        self.caution.setToolTip(about if text else "")
        if text != self.caution.text():
            self.caution.setText(text)
            self._fit_letters()

    def fit(self) -> None:
        """Fit the scales to what is shown now: they stay as they are while the knob turns."""
        self._release()
        self.show_maps()

    def _fit_cut(self) -> None:
        """Fit the scales to curves that are cut, or of outputs alone that are far weaker.

        Until the knob or the mouse rests, it is seen what is louder.
        """
        if self.is_stale or self.knob.dial.isSliderDown():
            self._rest.start()
        elif self._cut or (self._sunk and self.held is None):
            self.fit()

    def _release(self) -> None:
        self.held = self._held_ends = None

    def hold(self) -> None:
        """Let the motion stop where it is, or go on."""
        self.clock.held = self.moves and not self.clock.held

    def show_levels(self) -> None:
        """Show RMS levels in place of motion, or motion again."""
        self._change(moves=not stage_settings(self.view).moves)

    def compare(self) -> None:
        """Show what the Compare panel compares, or the design alone again."""
        self._change(compared=not stage_settings(self.view).compared)

    def show_arm(self) -> None:
        """Show hands with their arms, or alone; what was chosen stays, for several maps too."""
        if self.maps.content.cells:
            self.maps.arm = self.maps.places.low
            self.maps.show_content(self.maps.content)
            self.show_caution(*self._caution)

    def _follow_arm(self, shown: bool) -> None:
        self.arm.setChecked(shown)
        smalls = [cell.small for cell in self.maps.content.cells if cell.small is not None]
        offer_arm(
            self.arm, [small.limb_map for small in smalls], KEYS["presenting"].gestures["arm"].hint
        )

    def _change(self, **changes: Any) -> None:
        stage = replace(settings_of(self.view, STAGE, StageSettings), **changes)
        self.view_changed.emit(with_settings(self.view, STAGE, stage))

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit_letters()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.StyleChange:
            # Each label gets the letters of the window after its panel.
            QTimer.singleShot(0, self, self._fit_letters)

    def move_on(self, seconds: float) -> None:
        super().move_on(seconds)
        self._show_cursor()

    def _lay_out(self, *, several: bool) -> None:
        """Put one map beside the words, and several below them."""
        if several == self._several:
            return
        self._several, grid = several, self._grid
        places = (
            ((0, 0, 1, 1), (1, 0, 1, 3), (3, 0, 1, 3), (4, 0, 1, 2), (4, 2, 1, 1))
            if several
            else ((0, 1, 1, 1), (1, 1, 1, 1), (0, 0, 5, 1), (3, 1, 1, 1), (4, 1, 1, 1))
        )
        parts = (self.heading, self.sentence, self.maps, self.strip, self.knob)
        for part, place in zip(parts, places, strict=True):
            grid.addWidget(part, *place)
        directions = QtWidgets.QBoxLayout.Direction
        self._switches.setDirection(directions.TopToBottom if several else directions.LeftToRight)
        self._switches.setSpacing(UNIT_PX // 2 if several else 2 * UNIT_PX)
        grid.removeItem(self._line)
        grid.addLayout(self._line, 0 if several else 2, 1, 1, 2 if several else 1)
        for row, share in enumerate((0, 0, 0, 75, 25) if several else (0, 0, 0, 60, 40)):
            grid.setRowStretch(row, share)
        for column, share in enumerate((65, 20, 15) if several else (45, 55, 0)):
            grid.setColumnStretch(column, share)
        self._fit_letters()

    def _fit_letters(self) -> None:
        usual, most = _WORDS[bool(self._several)]
        scale = letter_scale(self.font())
        most_px = min(usual * scale, most) * self.height()
        # Words beside a map leave the room for what stands below them, where letters grow less.
        others_px = self._fit_others(sqrt(scale))
        if not self._several:
            most_px = min(most_px, self.height() - others_px)
        for label, whole, _ in self._said:
            label.setVisible(bool(whole))
            label.setText(shorten(whole, _MOST_LETTERS, placeholder="…"))
        title, words, _ = _LETTERS
        self._set_letters(scale * title, self.heading)
        self._set_letters(scale * words, self.sentence)
        while self._words_px() > most_px and scale > _LEAST_LETTERS:
            scale, title = scale * _SMALLER, words + _TITLE_SMALLER * (title - words)
            self._set_letters(scale * title, self.heading)
            self._set_letters(scale * words, self.sentence)
        self._fit_others(scale)
        for label, whole, text in self._said:
            # Nothing moves where less is said than before.
            label.setMinimumHeight(0 if whole == text else self._height_of(label))
            label.setText(shorten(text, _MOST_LETTERS, placeholder="…"))
        while self._words_px() > most_px and " " in self.sentence.text():
            self.sentence.setText(f"{self.sentence.text().rpartition(' ')[0]}…")
        for label, _, text in self._said:
            label.setToolTip("" if label.text() == text else text)

    def _fit_others(self, scale: float) -> int:
        """Fit all but words; return how high what stands below words is, with all margins."""
        # The maps need the room that words take: what stands beside them grows less.
        grown, knob, (_, words, others) = min(scale, sqrt(scale)), self.knob, _LETTERS
        small = self.maps, self.strip, knob.label, self.caution, self.arm, self.switch
        self._set_letters(grown * others, *small)
        # A passing notice in letters of the caution lies above all of it.
        margin, line_px = self.height() // 40, self.caution.fontMetrics().height()
        top = max(margin, line_px + UNIT_PX)
        self._grid.setSpacing(margin)
        self._grid.setContentsMargins(margin, top, margin, margin)
        self._set_letters(grown * words, knob.field)
        knob.field.setMinimumHeight(knob.field.sizeHint().height())
        knob.dial.setMinimumHeight(max(7 * UNIT_PX, round(_LEAST_DIAL * self.height())))
        least_px, fair_px = (
            round(_LINES_OF_STRIP * line_px + share * self.height()) for share in _CURVES
        )
        self.strip.setMinimumHeight(least_px)
        # Its width until now may be that beside other maps.
        share = _BESIDE_SEVERAL if self._several else _BESIDE
        knob_px = knob.column.minimumHeightForWidth(round(share * self.width()))
        self._grid.setRowMinimumHeight(4, knob_px)
        for row in (self._switches, self._line):
            row.invalidate()
        line_px = self._line.heightForWidth(round(_BESIDE * self.width()))
        return top + 5 * margin + line_px + fair_px + knob_px

    def _height_of(self, label: QtWidgets.QLabel) -> int:
        share = _BESIDE if not self._several else 0.58 if label is self.heading else 0.95
        return label.heightForWidth(round(share * self.width()))

    def _words_px(self) -> int:
        return sum(self._height_of(label) for label, whole, _ in self._said if whole)

    def _set_letters(self, share: float, *parts: QtWidgets.QWidget) -> None:
        """Give parts letters of a share of the height of the panel."""
        for part in parts:
            font = QtGui.QFont(part.font())
            font.setPixelSize(max(round(share * self.height()), 12))
            font.setBold(part is self.heading)
            part.setFont(tabular(font))

    def _show_words(self, design: Design, view: View, others: Sequence[str]) -> None:
        to_add = f"Press {shortcut_text('add_input')} to add an input"
        plain = self.named() if design.inputs else to_add
        title, words = design.title or plain, design.notes.partition("\n")[0]
        before = self._said_of.setdefault((design.title, design.notes), design)
        now = self._title_now(design, view) if design.title else plain
        said = words
        if now != title or design.inputs != before.inputs:
            # What was said of other numbers is no longer true.
            spec = self._turned_alone(before, design, view)
            parts = re.split(r"(?<=\.) (?=[A-Z])", words)
            number = _number(design, view)
            said = " ".join(
                part
                for part in parts
                if not (_is_tried(part, number) if part.startswith(_LASTING) else _says(part, spec))
            )
        # The end of a title says which of them it is.
        texts = title, now.removesuffix(_EDITED)
        title, now = (common_title([text, *others]) or text for text in texts)
        shown = self._said
        self._said = ((self.heading, title, now), (self.sentence, words, said))
        if self._said != shown:
            self._fit_letters()

    def _turned_alone(self, before: Design, design: Design, view: View) -> NumberSpec | None:
        """Return the number that was turned where a design of one's own differs in no other."""
        number = _number(design, view)
        if number is None or scenes.title_of(design) != design.title:
            return None
        track, name, spec, value = number
        ids = view.selected_inputs or (track.id,)
        outcome = edits.change_field(before, view, ids, name, value)
        return spec if isinstance(outcome, Edit) and outcome.design == design else None

    def _title_now(self, design: Design, view: View) -> str:
        """Return the title of a design with the number that was turned since it was first said."""
        before = self._said_of.get((design.title, design.notes), design)
        title = scenes.title_of(design)
        numbers = _number(before, view), _number(design, view)
        if title != design.title or design.inputs == before.inputs or None in numbers:
            return title
        (_, _, spec, then), (*_, value) = filter(None, numbers)

        def said(match: re.Match[str]) -> str:
            return value_text(value, spec.unit) if _is_said(match, spec, then) else match[0]

        live = _QUANTITY.sub(said, title)
        if live != title:
            return live
        first, *parts = title.split(" · ")
        kept = [part for part in parts if not re.search(r"\d", part)]
        return " · ".join((first, *kept)) + _EDITED * (kept != parts)

    def _with_title_now(self, side: Compared) -> Compared:
        snapshot, design = side.snapshot, side.snapshot.design
        if snapshot.number != EDITED or scenes.title_of(design) != design.title:
            return side
        title = self._title_now(design, self.view)
        told = replace(design, title="" if title.endswith(_EDITED) else title)
        return replace(side, snapshot=replace(snapshot, design=told))

    def _show_knob(self, design: Design, view: View) -> None:
        number = _number(design, view)
        self._track = None if number is None else number[0]
        self.knob.setVisible(number is not None)
        if number is None:
            return
        _, self._turned, spec, value = number
        self.knob.show_number(self._turned, spec, value, turned_inputs(design, view))

    def _show_traces(self) -> None:
        """Draw the outputs of one map, or the first one of several."""
        known = [(k, *loop) for k, loop in enumerate(self.moving.loops) if loop is not None]
        alone = len(self.moving.loops) == 1
        outputs = self.view.outputs if alone else self.view.outputs[:1]
        if not (known and outputs):
            self.strip.show_curves((), self.strip.ends, ("", "", ""))
            return
        names = self.kind.names(self.compared, self.view)
        limb = self.compared[0].snapshot.design.limb
        where = "" if alone else output_text(outputs[0], limb)
        spectra = stage_settings(self.view).plot == "spectra"
        # What passes is shown to its end, whatever scales stay.
        begin_s, passes = self.moving.begin_s, bool(self.moving.passing)
        end_s = _PERIODS[passes] * self.moving.longest_s
        shown_s = end_s
        if self._held_ends is not None and not (passes or self._passes):
            end_s = float(np.ptp(self._held_ends[0]))
        self._passes = passes
        curves = []
        for k, loop, gain in known:
            noisy = noisy_outputs(self.compared[k])
            kept = tuple(number for number in outputs if number <= loop.moving.signals.shape[0])
            if self._together:
                results = self.compared[k].values or {}
                loop = replace(loop, moving=results.get(ALL_AXES, loop.moving))
            x, values = loop.spectra(kept) if spectra else loop.traces(kept, end_s, self._since_s)
            values = values + 20.0 * np.log10(gain) if spectra else gain * values
            # Of another design the loudest part may lie where this one has ended.
            for row, number in enumerate(kept if x.size else ()):
                called = _names(number, limb) if alone else names[k]
                called = tuple(f"{each}{' noise' * (number in noisy)}" for each in called)
                rank, at = row if alone else k, x + begin_s * (not spectra)
                curves.append(Curve(names=called, rank=rank, x=at, y=values[row]))
        self.strip.in_rows = self.moving.passes and bool(curves)
        top = max((float(np.abs(curve.y).max()) for curve in curves), default=0.0) or 1.0
        self._sunk = False
        designs = [side.snapshot.design for side in self.compared]
        bands = dict(dict(self.view.panels).get("linearity", ())).get("bands")
        loops = [loop for _, loop, _ in known]
        record_samples = (self.compared[0].values or {}).get("record_samples")
        if bands and (fits := _fits_of(designs, loops, outputs[0], record_samples)):
            curves, x, y = fits, fits[0].x, [curve.y for curve in fits]
            low, top = float(np.min(y)), float(np.max(y))
            ends = (x[0] - 0.1, x[-1] + 0.1), (low - 0.1, top + 0.1)
            text = f"Output in m/s² over input in {amplitude_unit(designs[0])}, both logarithmic"
            words = (where, text, f"{rounded(10**low)} to {rounded(10**top)} m/s²")
            self.strip.ticks = tuple(Tick(value=at, label=f"{10**at:.3g}") for at in x)
        elif spectra and curves:
            low_hz, high_hz = facts_of(limb).band_hz or (0.0, float(curves[0].x[-1]))
            top = max(float(curve.y.max()) for curve in curves)
            ends = self._held_ends or ((low_hz, high_hz), (top - _SPECTRUM_DB, top))
            self._sunk = top < ends[1][1] - _SUNK_DB
            of = self.moving.unit.replace("m/s²", "acceleration")
            if self._together:
                axes, matched = axes_text(facts_of(limb).axes), of.partition(",")[1:]
                of = f"acceleration along {axes} together{''.join(matched)}"
            text = f"{low_hz:g} Hz · height: {of}, {_SPECTRUM_DB:g} dB in all"
            if held := next((loop.moving for loop in loops if not loop.moving.is_whole), None):
                first_s, last_s = held.first / held.sample_rate_hz, held.end / held.sample_rate_hz
                text = f"{text}, of {first_s:.3g} to {last_s:.3g} s"
            words = (where, text, f"{high_hz:g} Hz")
            self.strip.ticks = readable_ticks(low_hz, 0.99 * high_hz, 7.0, 7.0)
        else:
            self.strip.ticks = ()
            across = begin_s, begin_s + end_s
            ends = across, self._held_ends[1] if self._held_ends else (-top, top)
            self._held_ends, self._sunk = (
                self._held_ends and ends,
                top < 10 ** (-_SUNK_DB / 20) * ends[1][1],
            )
            high = f"±{rounded(ends[1][1])} {self.moving.unit}"
            if self.strip.in_rows:
                rows = [k - 1 for k in kept]
                curves = _in_rows(self.compared[0], known[0][1], curves, rows, begin_s)
                ends, top = (across, (-0.5, 0.5)), 0.0
                # The loudest part of a long motion begins after that.
                arrivals_s = [curve.arrival for curve in curves if curve.arrival is not None]
                marks = any(across[0] <= each <= across[1] for each in arrivals_s)
                arrives = ", marked where it arrives" * marks
                high = f"each relative to its peak; + group delay{arrives}"
            span = self.moving.span_text if passes else f"window {1e3 * end_s:.4g} ms"
            words = (where, high, span)
        self._cut = top > ends[1][1] or (not spectra and shown_s > end_s)
        self.strip.show_curves(tuple(curves), ends, words)
        self._show_cursor()

    def _show_cursor(self) -> None:
        longest_s = self.moving.longest_s
        if not (longest_s and self.moves and stage_settings(self.view).plot == "traces"):
            self.strip.show_cursor(None)
            return
        # It goes back by whole periods, so that curves and maps agree where it stands.
        begin_s, end_s = self.strip.ends[0]
        lap_s = longest_s * max(round((end_s - begin_s) / longest_s), 1)
        at_s = self.moving.ran_s % lap_s
        since_s = 0.0 if self.moving.repeats else self.moving.ran_s - at_s
        if not isclose(since_s, self._since_s, abs_tol=1e-9):
            # Shorter periods are elsewhere after that.
            self._since_s = since_s
            self._show_traces()
        else:
            self.strip.show_cursor(begin_s + at_s)

    def _turn(self, value: float, gesture: int | None) -> None:
        if self.design is not None and self._track is not None:
            ids = self.view.selected_inputs or (self._track.id,)
            outcome = edits.change_field(self.design, self.view, ids, self._turned, value)
            if self.held is None and (scale := self.maps.content.common_scale) is not None:
                self.held, self._held_ends = scale.range_db, self.strip.ends
            self.edited.emit(outcome, gesture)
            self._rest.start()


def _compared(design: Design, view: View, compare: CompareSettings) -> Kind:
    """Return what is compared, people where that is less than two, or the design alone."""
    kinds = KINDS[compare.of], KINDS["limbs"]
    return next((kind for kind in kinds if kind.is_several(compare, design, view)), _ALONE)


def _in_rows(
    side: Compared, loop: Loop, curves: list[Curve], rows: list[int], begin_s: float
) -> list[Curve]:
    """Return traces in rows, with when they arrive: after the first, which has the onset."""
    moving, drawn, noisy = loop.moving, list[Curve](), np.array(noisy_outputs(side), dtype=int) - 1
    signals = moving.signals[:, 0] if loop.signed else np.linalg.norm(moving.signals, axis=1)
    # Noise never arrives.
    heard = signals[rows] * ~np.isin(rows, noisy)[:, None]
    onset_s = first_onset_s(side.snapshot.design) + moving.delay_s
    first_s = moving.first / moving.sample_rate_hz
    delays_s = arrivals(heard, moving.sample_rate_hz, onset_s - first_s)
    for curve, delay_s in zip(curves, delays_s, strict=True):
        curve = replace(curve, y=_REACH[1] * curve.y / (np.abs(curve.y).max() or 1.0))
        if np.isfinite(delay_s):
            told = minus(f" {round(1e3 * delay_s):+d} ms")
            names = (*(f"{name}{told}" for name in curve.names), curve.names[-1])
            arrives_s = begin_s + onset_s + delay_s - loop.begin_s
            curve = replace(curve, names=names, arrival=arrives_s)
        drawn.append(curve)
    return drawn


def _fits_of(
    designs: Sequence[Design], loops: Sequence[Loop], output: int, record_samples: int | None
) -> list[Curve]:
    """Return dots of an output over the input, in some bands, and their lines; all logarithms.

    There are none where designs differ in more than their strength, or along several axes.
    """
    strengths = strengths_of(designs)
    if not 0 < len(strengths) == len([loop for loop in loops if loop.signed]):
        return []
    responses = np.stack([loop.moving.signals[output - 1] for loop in loops])
    rate_hz, band_hz = loops[0].moving.sample_rate_hz, facts_of(designs[0].limb).band_hz
    result = proportion(strengths, responses, rate_hz, band_hz, record_samples)
    x, curves = np.log10(result.strengths), list[Curve]()
    for band in bands_shown(result, 0):
        y, dots = np.log10((result.band_line[:, 0, band], result.band_rms[:, 0, band]))
        hz = f"{result.frequency_hz[band]:.0f} Hz"
        names = f"{hz}: R² {result.adjusted_r2[0, band]:.4f}", hz
        curves.append(Curve(names=names, rank=len(curves), x=x, y=y, dots=dots))
    return curves


def _names(number: int, limb: str) -> Names:
    (name,) = output_names((number,), limb)
    return output_text(number, limb), f"{number} {name.short}".rstrip(), str(number)


def _number_said(match: re.Match[str], spec: NumberSpec) -> float | None:
    """Return a number in a text, SI; None: it is of another quantity."""
    try:
        return parse_number(f"{match[1]} {match[2]}", spec)
    except InvalidInputError:
        return None


def _is_said(match: re.Match[str], spec: NumberSpec, value: float) -> bool:
    number = _number_said(match, spec)
    return number is not None and isclose(number, value, rel_tol=5e-3)


def _is_tried(sentence: str, number: tuple[Input, str, NumberSpec, float] | None) -> bool:
    """Whether a sentence asks to turn a number to what it is."""
    if number is None or not sentence.startswith(_TRY):
        return False
    *_, spec, value = number
    return any(_is_said(each, spec, value) for each in _QUANTITY.finditer(sentence))


def _says(sentence: str, turned: NumberSpec | None) -> bool:
    """Whether a sentence says a number of what was turned, or follows from it; None: any number."""
    if turned is None or _RESULT.search(sentence):
        return re.search(r"\d", sentence) is not None
    return any(_number_said(each, turned) is not None for each in _QUANTITY.finditer(sentence))


def knob_options(design: Design, view: View) -> dict[str, tuple[str, View]]:
    """Return by their titles the numbers that the knob can turn, and views in which it does.

    They are those of what it turns in ``view``, and of the first inputs of the design.
    """
    several = _n_turned(design, view) > 1
    now = None if several else _turned_input(design, view)
    views = [view] if several or now is None else []
    views += [
        view if track is now else edits.select_inputs(design, view, [track.id]).view
        for k, track in enumerate(design.inputs)
        if k < MOST_OFFERED or track is now
    ]
    return {
        f"{title}{turned_inputs(design, each)}": (name, each)
        for each in views
        for name, title in _numbers_of(_turned_input(design, each), each)
    }


def _numbers_of(track: Input | None, view: View) -> list[tuple[str, str]]:
    """Return which numbers of an input the knob can turn, and their titles."""
    clip = None if track is None else clip_of(track, view)
    left_out = FREQUENCY if clip is None or _frequency_of(clip) is None else ""
    return [option for option in CONTROL.options if option[0] != left_out]


def _frequency_of(clip: Clip) -> tuple[str, NumberSpec] | None:
    """Return name and limits of the first frequency of what a clip plays; None: it has none."""
    for name, spec in specs_of(clip.waveform).items():
        if isinstance(spec, NumberSpec) and spec.measured_band_hz is not None:
            return name, spec
    return None


def turned_inputs(design: Design, view: View) -> str:
    """Return of which input the knob turns a number, or of how many; "" where there is one."""
    n_turned, track = _n_turned(design, view), _turned_input(design, view)
    if track is None or len(design.inputs) == 1:
        return ""
    if n_turned > 1:
        return f", {n_turned} inputs"
    there = [each.id for each in design.inputs if each.location == track.location]
    which = f", {there.index(track.id) + 1} of {len(there)}" if len(there) > 1 else ""
    return f", place\N{NO-BREAK SPACE}{track.location}{which}"


def _n_turned(design: Design, view: View) -> int:
    return len(set(view.selected_inputs) & set(design.ids))


def _turned_input(design: Design, view: View) -> Input | None:
    return leading_input(design, view) or next(iter(design.inputs), None)


def _number(design: Design, view: View) -> tuple[Input, str, NumberSpec, float] | None:
    """Return what the knob turns: an input, the name of its number, and that number."""
    track = _turned_input(design, view)
    if track is None:
        return None
    clip, control = clip_of(track, view), stage_settings(view).control
    if clip is not None and control == ONSET:
        return track, "onset_s", ONSET_SPEC, clip.onset_s
    if clip is not None and control != AMPLITUDE and (turned := _frequency_of(clip)):
        facts, (name, spec) = facts_of(design.limb), turned
        spec = spec.at_rate(facts.sample_rate_hz, facts.band_hz)
        # Alone, "From" is no name.
        label = f"{clip.waveform.title} {spec.label.lower()}"
        return track, name, replace(spec, label=label), getattr(clip.waveform, name)
    amplitude = AMPLITUDE_GAIN if is_gain(design, track) else amplitude_spec(design)
    return track, "amplitude", amplitude, track.amplitude
