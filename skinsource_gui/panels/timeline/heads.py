"""The heads of the tracks: number, mute, solo, a fader and a peak meter, in a list.

The fader and the meter share one scale in decibels of an amplitude of 1.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import copysign, log10
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import (
    QAbstractItemModel,
    QAbstractListModel,
    QEvent,
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QPoint,
    QPointF,
    QRect,
    QRectF,
    QSize,
    Qt,
    Signal,
)

from skinsource.base.conventions import Floats
from skinsource.design import edits
from skinsource.design.amplitudes import amplitude_spec, amplitude_unit, is_gain
from skinsource.design.describing import duration_text
from skinsource.design.design import AMPLITUDE_GAIN, Design, Input, View, audible_inputs
from skinsource.design.display_units import SHOWN_DIGITS, number_text, value_text
from skinsource.design.edits.edit import Edit, Refusal, change_inputs, clip_of
from skinsource.limbs.locations import input_name
from skinsource_gui.fields.editor import Burst, new_gesture
from skinsource_gui.fields.inputs import (
    EMPTY,
    ENTRIES,
    ORDER,
    Entry,
    clip_text,
    clips_text,
    fill_inputs_menu,
    peak_of,
)
from skinsource_gui.fields.number_field import FINISHERS, NumberField, makes_step
from skinsource_gui.fields.units import minus, parse_level
from skinsource_gui.panels.timeline.content import shown_gain_curves, toggle_gain_curves
from skinsource_gui.qt.buttons import paint_swatch, passing_menu, text_colour_on
from skinsource_gui.qt.frames import drop_line
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.theme import Theme, current_theme
from skinsource_gui.qt.wheel import NOTCH

#: Ends of the fader and of the meter, dB of an amplitude of 1; at the left end it is silent.
LEAST_DB, MOST_DB = -40.0, 20.0
#: One step of a key or of the wheel, dB; with Ctrl finer, with Shift coarser.
STEP_DB, _FINE, _COARSE = 1.0, 0.1, 6.0

Index = QModelIndex | QPersistentModelIndex
_Key, _Held = Qt.Key, Qt.KeyboardModifier
_PLACE = "inputs"
_Role = Qt.ItemDataRole
_TEXTS = (_Role.DisplayRole, _Role.AccessibleTextRole, _Role.ToolTipRole)
_EDITS: dict[str, Callable[..., Edit | Refusal]] = {
    "mute": edits.toggle_mute,
    "solo": edits.toggle_solo,
    "duplicate": edits.duplicate_inputs,
    "gain_curve": toggle_gain_curves,
    "remove": edits.remove_inputs,
}


def level_db(amplitude: float) -> float:
    """Return the place of an amplitude on the fader, dB; at least the left end."""
    return max(20.0 * log10(abs(amplitude)), LEAST_DB) if amplitude else LEAST_DB


def level_text(amplitude: float) -> str:
    """Return the level of an amplitude: ``"−6.02 dB"``; that of 0 is "silent"."""
    if not amplitude:
        return "silent"
    return minus(value_text(20.0 * log10(abs(amplitude)), "dB", digits=3))


def moved_amplitude(amplitude: float, by_db: float) -> float:
    """Return an amplitude moved along the fader, with its polarity; 0 at the left end."""
    start_db = level_db(amplitude)
    moved_db = min(start_db + by_db, max(MOST_DB, start_db))
    size = 10.0 ** (moved_db / 20.0) if moved_db > LEAST_DB else 0.0
    return float(f"{copysign(size, amplitude):.4g}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Head:
    """What a head shows.

    Attributes
    ----------
    silent
        Whether the track is muted, or another one is solo.
    played
        What the track plays before its amplitude; None: it is not known.
    peaks_at_amplitude
        Whether the amplitude is the peak of the track, whatever it plays.
    """

    track: Input
    silent: bool
    played: Floats | None
    peaks_at_amplitude: bool = False

    @property
    def peak(self) -> float | None:
        """The largest value that the track plays, between samples too, with its amplitude."""
        if self.played is None:
            return None
        peak = peak_of(self.played)
        return abs(self.track.amplitude) * (peak > 0.0 if self.peaks_at_amplitude else peak)

    def level_text(self, decimals: int = 1) -> str:
        """Return the level of the amplitude in a few letters, dB: ``"−6.0"``, ``"+12.3"``."""
        if not self.track.amplitude:
            return "−∞"
        text = f"{20.0 * log10(abs(self.track.amplitude)):+z.{decimals}f}"
        return minus(text.replace("+0.0", "0.0"))

    @property
    def painted(self) -> tuple[object, ...]:
        """What is seen of it: a meter shows no more than a percent."""
        track, peak = self.track, self.peak
        switches = track.muted, track.solo, self.silent
        level = None if peak is None else round(peak, 2)
        return track.location, track.colour, track.amplitude, switches, level


def text_of(head: Head, design: Design, view: View) -> str:
    """Return what the track plays, how loud, for the tooltip."""
    track, clip = head.track, clip_of(head.track, view)
    played = EMPTY
    if clip is not None:
        length = duration_text(clip.duration_s)
        played = f"{clip_text(clip)} · {length}{clips_text(len(track.clips))}"
    gain, unit = f"{AMPLITUDE_GAIN.label} {track.amplitude:zg}", amplitude_unit(design)
    level = gain if is_gain(design, track) else f"{track.amplitude:zg} {unit}"
    level += f" ({level_text(track.amplitude)})"
    if (peak := head.peak) is not None:
        level += f", peak {peak:.3g} {unit}"
    inverted = "\nPolarity inverted" if track.amplitude < 0 else ""
    return f"{played}\n{level}{inverted}"


def chosen_heads(view: View) -> tuple[int, ...]:
    """Return the tracks that are selected themselves: none where they are so by their clips."""
    return () if view.selected_clips else view.selected_inputs


class HeadsModel(QAbstractListModel):
    """The heads as rows of a list, of which ``design`` and ``view`` are shown."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.heads: list[Head] = []
        self._design, self._view = Design(limb=""), View()

    def show_state(self, design: Design, view: View, played: Mapping[int, Floats]) -> None:
        """Show other heads; ``played``: what tracks play before their amplitude, by their ids."""
        audible = {track.id for track in audible_inputs(design.inputs)}
        before, same = self.heads, design.ids == self._design.ids
        if not same:
            self.beginResetModel()
        self._design, self._view = design, view
        self.heads = [
            Head(
                track=track,
                silent=track.id not in audible,
                played=played.get(track.id),
                peaks_at_amplitude=design.scaling == "upstream",
            )
            for track in design.inputs
        ]
        if not same:
            self.endResetModel()
            return
        for row, (old, new) in enumerate(zip(before, self.heads, strict=True)):
            if new.painted != old.painted:
                index = self.createIndex(row, 0)
                self.dataChanged.emit(index, index)

    def rowCount(self, parent: Index | None = None) -> int:
        return len(self.heads)

    def flags(self, index: Index) -> Qt.ItemFlag:
        return super().flags(index) | Qt.ItemFlag.ItemIsEditable

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if role not in _TEXTS:
            return None
        head = self.heads[index.row()]
        place = input_name(head.track.location, self._design.limb)
        text = text_of(head, self._design, self._view)
        if role == _Role.ToolTipRole:
            chosen = chosen_heads(self._view)
            if len(chosen) > 1 and head.track.id in chosen:
                text += "\nM, S and fader change all selected inputs"
            return f"{place.number} · {place.name}\n{text}"
        silent = ", silent" if head.silent else ""
        return f"Input at {place.number}, {place.name}: {text.replace(chr(10), ', ')}{silent}"


#: Size of a head for text of the usual size, and height of such a line, px.
HEADS_PX, ROW_PX, USUAL_LINE_PX = 114, 40, 14
# Heads of larger text leave the lanes room too.
_MOST_HEADS_PX = 220
_EDGE_PX, _LINE_PX, _SWATCH_PX, _METER_PX, _MARK_PX = 6, 18, 21, 3, 3
_TINT_ALPHA = 28


def heads_px(line_px: int) -> int:
    """Return the width of heads for lines of text of this height, px."""
    return min(round(HEADS_PX * max(line_px / USUAL_LINE_PX, 1.0)), _MOST_HEADS_PX)


def row_px(line_px: int) -> int:
    """Return the height of a head for lines of text of this height, px."""
    return round(ROW_PX * max(line_px / USUAL_LINE_PX, 1.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadPlaces:
    """Places of the parts of a head, px."""

    swatch: QRectF
    level: QRectF
    mute: QRectF
    solo: QRectF
    fader: QRectF
    meter: QRectF

    @classmethod
    def of(cls, row: QRect, line_px: int) -> "HeadPlaces":
        """Return the places in a row, for lines of text of this height."""
        scale = max(line_px / USUAL_LINE_PX, 1.0)
        line, left, top = scale * _LINE_PX, row.x() + _EDGE_PX, row.y() + 2.0
        solo = row.right() - _EDGE_PX - line
        mute = solo - line - 2
        meter = row.bottom() - _METER_PX - 2
        below = top + line + 2
        across = row.right() - _EDGE_PX - left
        return cls(
            swatch=QRectF(left, top, scale * _SWATCH_PX, line),
            level=QRectF(left + scale * _SWATCH_PX, top, mute - left - scale * _SWATCH_PX, line),
            mute=QRectF(mute, top, line, line),
            solo=QRectF(solo, top, line, line),
            fader=QRectF(left, below, across, meter - below - 1),
            meter=QRectF(left, meter, across, _METER_PX),
        )

    def part_at(self, at: QPointF) -> str:
        """Return which part lies at a place: "level", "mute", "solo", "fader", or ""."""
        parts = "level", "mute", "solo", "fader"
        return next((part for part in parts if getattr(self, part).contains(at)), "")


class LevelField(NumberField):
    """An amplitude as its level, dB; a number with another unit is the amplitude itself.

    Attributes
    ----------
    is_level
        Whether the last text was a level, which has no polarity.
    """

    is_level = True

    @property
    def unit_text(self) -> str:
        return "dB"

    def _number_text(self, digits: int = SHOWN_DIGITS) -> str:
        size = abs(self.value_si)
        return number_text(round(20.0 * log10(size), 2), "dB") if size else "−∞"

    def commit(self) -> bool:
        self.is_level = _unit_of(self.text()) in ("", "db", *_SILENT)
        return super().commit()

    def _read(self, text: str) -> float:
        unit = _unit_of(text)
        if unit in _SILENT:
            return 0.0
        return parse_level(text if unit else f"{text} dB", self.spec, self.value_si)


# What is typed for the level of silence.
_SILENT = "∞", "∞ db", "inf", "inf db"


def _unit_of(text: str) -> str:
    return text.strip().lstrip("+-−0123456789.,eE ").casefold()


class HeadDelegate(QtWidgets.QStyledItemDelegate):
    """Paints heads, and lets the level of an amplitude be typed over the fader."""

    #: Id of a track, the amplitude that was typed, and whether it leaves the polarity.
    typed = Signal(int, float, bool)

    def __init__(self, rows: "Heads") -> None:
        super().__init__(rows)
        self._rows = rows

    def sizeHint(self, option: QtWidgets.QStyleOptionViewItem, index: Index) -> QSize:
        line_px = self._rows.fontMetrics().height()
        return QSize(heads_px(line_px), row_px(line_px))

    def paint(
        self, painter: QtGui.QPainter, option: QtWidgets.QStyleOptionViewItem, index: Index
    ) -> None:
        theme, head = current_theme(), self._rows.heads[index.row()]
        places = HeadPlaces.of(option.rect, option.fontMetrics.height())
        leads = index.row() == self._rows.currentIndex().row()
        painter.save()
        painter.setFont(self._rows.font())
        if option.state & QtWidgets.QStyle.StateFlag.State_Selected:
            chosen = head.track.id in self._rows.chosen
            self._paint_selection(painter, option.rect, theme, leads=leads, chosen=chosen)
        colour, dim = theme.input_colour(head.track.colour), QtGui.QColor(theme.dim)
        text, number = QtGui.QColor(theme.text), head.track.location
        paint_swatch(painter, places.swatch, number, colour, text, silent=head.silent)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setPen(dim)
        inverted, middle = head.track.amplitude < 0, Qt.AlignmentFlag.AlignVCenter
        side = Qt.AlignmentFlag.AlignRight if inverted else Qt.AlignmentFlag.AlignHCenter
        level, mark = head.level_text(), "ø" if inverted else ""
        if painter.fontMetrics().horizontalAdvance(mark + level) > places.level.width():
            level = head.level_text(0)
        painter.drawText(places.level, middle | side, level)
        painter.setPen(text)
        painter.drawText(places.level, Qt.AlignmentFlag.AlignLeft, mark)
        _paint_letter(painter, places.mute, "M", theme.warning, on=head.track.muted)
        _paint_letter(painter, places.solo, "S", theme.accent, on=head.track.solo)
        _paint_fader(painter, places.fader, head.track.amplitude, theme)
        painter.fillRect(places.meter, QtGui.QColor(theme.grid))
        if (peak := head.peak) is not None:
            painter.fillRect(_part(places.meter, peak), dim if head.silent else colour)
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
        painter.drawLine(option.rect.bottomLeft(), option.rect.bottomRight())
        painter.restore()

    def createEditor(
        self, parent: QtWidgets.QWidget, option: QtWidgets.QStyleOptionViewItem, index: Index
    ) -> QtWidgets.QWidget:
        track = self._rows.heads[index.row()].track
        spec = self._rows.spec_of(track)
        hint = f"Level re 1 {spec.unit}".rstrip() + "; with another unit an amplitude"
        field = LevelField(replace(spec, hint=hint), parent, widest_unit="dB")
        field.setObjectName("amplitude_field")
        field.setStyleSheet("QLineEdit { min-height: 0; padding: 0 4px; }")
        field.edited.connect(lambda value, _: self.typed.emit(track.id, value, field.is_level))
        return field

    def setEditorData(self, editor: QtWidgets.QWidget, index: Index) -> None:
        if isinstance(editor, NumberField) and not editor.editing:
            editor.set_value(self._rows.heads[index.row()].track.amplitude)
            editor.begin_editing()

    def setModelData(
        self, editor: QtWidgets.QWidget, model: QAbstractItemModel, index: Index
    ) -> None:
        if isinstance(editor, NumberField):
            editor.commit()

    def updateEditorGeometry(
        self,
        editor: QtWidgets.QWidget,
        option: QtWidgets.QStyleOptionViewItem,
        index: Index,
    ) -> None:
        places = HeadPlaces.of(option.rect, option.fontMetrics.height())
        editor.setGeometry(places.fader.united(places.meter).toRect())

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Wheel or (
            isinstance(event, QtGui.QKeyEvent)
            and event.type() == QEvent.Type.KeyPress
            and (event.key() in FINISHERS or makes_step(event))
        ):
            # A text that is no number stays, with the reason.
            if isinstance(editor, LevelField) and editor.commit():
                self.closeEditor.emit(editor)
            return True
        return super().eventFilter(editor, event)

    def _paint_selection(
        self, painter: QtGui.QPainter, row: QRect, theme: Theme, *, leads: bool, chosen: bool
    ) -> None:
        """Mark the head that leads, or each that has selected clips; tint what changes together."""
        tint = QtGui.QColor(theme.accent)
        if leads or not chosen:
            painter.fillRect(row.x(), row.y(), _MARK_PX, row.height(), tint)
        if leads and self._rows.hasFocus():
            painter.setPen(QtGui.QPen(tint, 2))
            painter.drawRect(QRectF(row).adjusted(1, 1, -1, -1))
        if chosen:
            tint.setAlpha(_TINT_ALPHA)
            painter.fillRect(row, tint)


def _part(room: QRectF, amplitude: float) -> QRectF:
    """Return the part of a fader or meter up to an amplitude."""
    share = (min(level_db(amplitude), MOST_DB) - LEAST_DB) / (MOST_DB - LEAST_DB)
    return QRectF(room.left(), room.top(), share * room.width(), room.height())


def _paint_letter(
    painter: QtGui.QPainter, place: QRectF, letter: str, colour: str, *, on: bool
) -> None:
    theme, fill = current_theme(), QtGui.QColor(colour)
    painter.setPen(Qt.PenStyle.NoPen if on else QtGui.QPen(QtGui.QColor(theme.border), 1))
    painter.setBrush(fill if on else Qt.BrushStyle.NoBrush)
    painter.drawRoundedRect(place.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
    painter.setPen(text_colour_on(fill) if on else QtGui.QColor(theme.dim))
    painter.drawText(place, Qt.AlignmentFlag.AlignCenter, letter)


def _paint_fader(painter: QtGui.QPainter, room: QRectF, amplitude: float, theme: Theme) -> None:
    middle, unity = room.center().y(), _part(room, 1.0).right()
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.dim), 1))
    painter.drawLine(QPointF(room.left(), middle), QPointF(room.right(), middle))
    painter.drawLine(QPointF(unity, middle - 3), QPointF(unity, middle + 3))
    half = room.height() / 2 - 1
    handle = QRectF(_part(room, amplitude).right() - 3, middle - half, 6, 2 * half)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.base), 1))
    painter.setBrush(QtGui.QColor(theme.text))
    painter.drawRoundedRect(handle, 2, 2)


@dataclass(slots=True, kw_only=True)
class _Press:
    """A press of the left button on a head.

    Attributes
    ----------
    start
        The design then.
    ids
        Tracks whose fader is dragged; none: the head itself is.
    was_selected
        Whether the head was selected already.
    gap
        Where a drag would put the selected heads; None: it is a click yet.
    """

    at: QPoint
    row: int
    start: Design
    ids: tuple[int, ...] = ()
    gesture: int = 0
    was_selected: bool = False
    gap: int | None = None


# Height of the line that shows between which rows a drag would put the selected ones, px.
_GAP_PX = 3


class Heads(QtWidgets.QListView):
    """The heads, which select, change, order and remove tracks.

    A fader is dragged, turned by the wheel, or moved by keys, and moves those of all selected
    tracks by as many decibels.  Dragging a head puts the selected ones between two others.

    Attributes
    ----------
    chosen
        Tracks that change together, see `chosen_heads`.
    """

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: Other heads are there, or they have another size; Qt tells no other way.
    laid_out = Signal()

    def __init__(self) -> None:
        super().__init__()
        named(self, "input_rows", "Inputs")
        self.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
        self.setSelectionMode(self.SelectionMode.ExtendedSelection)
        self.setEditTriggers(self.EditTrigger.NoEditTriggers)
        self.setUniformItemSizes(True)
        self.setVerticalScrollMode(self.ScrollMode.ScrollPerPixel)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._design, self._view = Design(limb=""), View()
        self.chosen: tuple[int, ...] = ()
        self._selection: tuple[tuple[int, ...], ...] = ()
        self._model, self._shows = HeadsModel(self), False
        self.setModel(self._model)
        delegate = HeadDelegate(self)
        self.setItemDelegate(delegate)
        delegate.typed.connect(self._type)
        self.selectionModel().selectionChanged.connect(self._select)
        self._burst = Burst(self)
        self._press: _Press | None = None
        self._gap = drop_line(self.viewport(), "input_gap")

    @property
    def heads(self) -> list[Head]:
        """The heads, from top to bottom."""
        return self._model.heads

    def spec_of(self, track: Input) -> Any:
        """Return what the amplitude of a track may be."""
        return AMPLITUDE_GAIN if is_gain(self._design, track) else amplitude_spec(self._design)

    def places(self, row: int) -> HeadPlaces:
        """Return the places of the parts of a head, px."""
        rect = self.visualRect(self._model.index(row))
        return HeadPlaces.of(rect, self.fontMetrics().height())

    def show_state(self, design: Design, view: View, played: Mapping[int, Floats]) -> None:
        """Show one head for each track; see `HeadsModel.show_state`."""
        same = design.ids == self._design.ids
        selection = view.selected_inputs, view.selected_clips
        if not same:
            self._cancel()
        self._design, self._view = design, view
        self._shows = True
        self._model.show_state(design, view, played)
        if not same or selection != self._selection:
            self._selection = selection
            self._show_selection()
        self._shows = False

    def dataChanged(self, first: Index, last: Index, roles: Sequence[int] = ()) -> None:
        # A list would be laid out again, and painted as a whole.
        QtWidgets.QAbstractItemView.dataChanged(self, first, last, roles)

    def updateGeometries(self) -> None:
        super().updateGeometries()
        self.laid_out.emit()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        # A click says itself what it selects.
        if self._view.selected_clips and event.reason() != Qt.FocusReason.MouseFocusReason:
            self._edit(edits.select_inputs, self._view.selected_inputs)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == _Key.Key_Escape and self._cancel():
            return
        command, last = meaning_of(_PLACE, event), self._view.selected_input
        chosen = () if last is None else self._affected(last)
        if not command or not self._design.inputs:
            event.ignore()
        elif command == "go":
            super().keyPressEvent(event)
        elif command in ("shift_up", "shift_down"):
            self._edit(edits.shift_inputs, chosen, command == "shift_down")
        elif command == "select_all":
            self._edit(edits.select_all_inputs)
        elif command == "fader":
            way = 1 if event.key() == _Key.Key_Right else -1
            self._step(chosen, way, event.modifiers())
        elif not chosen:
            event.ignore()
        elif command == "type":
            self.edit(self.currentIndex())
        else:
            self._edit(_EDITS[command], chosen)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        at = event.position().toPoint()
        row = self.indexAt(at).row()
        if row < 0 or event.button() != Qt.MouseButton.LeftButton:
            return
        self._cancel()
        id, part = self._design.ids[row], self.places(row).part_at(event.position())
        selected = id in self.chosen
        if part in ("mute", "solo"):
            self._edit(_EDITS[part], self._affected(id))
            return
        if not (selected or event.modifiers()):
            self._edit(edits.select_inputs, (id,))
        elif not selected or (part != "fader" and event.modifiers()):
            super().mousePressEvent(event)
        self._press = _Press(at=at, row=row, start=self._design, was_selected=selected)
        if part == "fader":
            self._press.ids, self._press.gesture = self._affected(id), new_gesture()
        elif event.modifiers():
            self._press = None

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        press, at = self._press, event.position().toPoint()
        if press is None or not event.buttons() & Qt.MouseButton.LeftButton:
            return
        if press.ids:
            room = self.places(press.row).fader.width()
            by_db = (at.x() - press.at.x()) / room * (MOST_DB - LEAST_DB)
            fine = _FINE if event.modifiers() & _Held.ControlModifier else 1.0
            self._move_faders(press.start, press.ids, fine * by_db, press.gesture)
            level = level_text(self._design.inputs[press.row].amplitude)
            QtWidgets.QToolTip.showText(event.globalPosition().toPoint(), level, self)
            return
        far = (at - press.at).manhattanLength() >= QtWidgets.QApplication.startDragDistance()
        if press.gap is not None or far:
            rects = [self.visualRect(self._model.index(row)) for row in range(len(self.heads))]
            press.gap = sum(rect.center().y() < at.y() for rect in rects)
            bottom = rects[press.gap - 1].bottom() + 1 if press.gap else rects[0].top()
            self._gap.setGeometry(0, max(bottom - _GAP_PX // 2, 0), self.width(), _GAP_PX)
            self._gap.show()

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        press, self._press = self._press, None
        self._gap.hide()
        if press is None or press.ids:
            return
        if press.gap is not None:
            dragged = self._affected(self._design.ids[press.row])
            self._edit(edits.put_inputs_before, dragged, press.gap)
        elif press.was_selected:
            # A click on one of several selected heads selects that one alone.
            self._edit(edits.select_inputs, (self._design.ids[press.row],))

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        index = self.indexAt(event.position().toPoint())
        part = self.places(index.row()).part_at(event.position()) if index.isValid() else ""
        if part in ("fader", "level"):
            self._press = None
            # This ends the editor that is open, which takes no other one beside it.
            self.setFocus(Qt.FocusReason.MouseFocusReason)
            self.edit(index)
        else:
            self.mousePressEvent(event)

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        index, turns = self.indexAt(event.position().toPoint()), event.angleDelta()
        # Who scrolls the tracks changes nothing: as a number, a fader turns once it was chosen.
        chosen = self.hasFocus() and self.selectionModel().isSelected(index)
        if not chosen or self.places(index.row()).part_at(event.position()) != "fader":
            super().wheelEvent(event)
            return
        notches = (turns.y() or turns.x()) / NOTCH
        self._step(self._affected(self._design.ids[index.row()]), notches, event.modifiers())
        event.accept()

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        # The menu key opens the menu of the head that was selected last, on that head.
        by_key = event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard
        index = self.currentIndex() if by_key else self.indexAt(event.pos())
        if index.isValid():
            id = self._design.ids[index.row()]
            if id not in self.chosen:
                self._edit(edits.select_inputs, (id,))
            centre = self.viewport().mapToGlobal(self.visualRect(index).center())
            self._open_menu(self._affected(id), centre if by_key else event.globalPos())

    def _edit(self, edit: Callable[..., Edit | Refusal], *more: object) -> None:
        self.edited.emit(edit(self._design, self._view, *more), None)

    def _affected(self, id: int) -> tuple[int, ...]:
        """Return the tracks that a control changes: all chosen ones, if its own is among them."""
        return self.chosen if id in self.chosen else (id,)

    def _show_selection(self) -> None:
        self.chosen = chosen_heads(self._view)
        self.viewport().update()
        rows = {id: row for row, id in enumerate(self._design.ids)}
        chosen = [rows[id] for id in self._view.selected_inputs if id in rows]
        picked = self.selectionModel()
        if sorted(index.row() for index in picked.selectedRows()) != sorted(chosen):
            selection = QItemSelection()
            for row in chosen:
                selection.select(self._model.index(row), self._model.index(row))
            picked.select(selection, QItemSelectionModel.SelectionFlag.ClearAndSelect)
        last = self._model.index(chosen[-1]) if chosen else QModelIndex()
        if self.currentIndex() != last:
            picked.setCurrentIndex(last, QItemSelectionModel.SelectionFlag.NoUpdate)

    def _select(self) -> None:
        if self._shows:
            return
        current, chosen = self.currentIndex().row(), self.selectionModel().selectedRows()
        rows = sorted((index.row() for index in chosen), key=lambda row: (row == current, row))
        self._edit(edits.select_inputs, tuple(self._design.ids[row] for row in rows))

    def _type(self, id: int, amplitude: float, is_level: bool) -> None:
        def typed(track: Input) -> float:
            return copysign(amplitude, track.amplitude) if is_level else amplitude

        ids = self._affected(id)
        changes = {
            track.id: {"amplitude": typed(track)}
            for track in self._design.inputs
            if track.id in ids
        }
        self._edit(change_inputs, "Change amplitude of", changes)

    def _step(self, ids: Iterable[int], steps: float, held: Qt.KeyboardModifier) -> None:
        size = _FINE if held & _Held.ControlModifier else 1.0
        size = _COARSE if held & _Held.ShiftModifier else size
        self._move_faders(self._design, ids, steps * size * STEP_DB, self._burst.gesture())

    def _move_faders(self, start: Design, ids: Iterable[int], by_db: float, gesture: int) -> None:
        """Move faders by so many decibels from where they stood in a design."""
        changes: dict[int, dict[str, Any]] = {
            track.id: {
                "amplitude": moved_amplitude(track.amplitude, by_db) if by_db else track.amplitude
            }
            for track in start.inputs
            if track.id in set(ids)
        }
        outcome = change_inputs(self._design, self._view, "Change amplitude of", changes)
        self.edited.emit(outcome, gesture)

    def _cancel(self) -> bool:
        """Give up a drag; return whether there was one."""
        press, self._press = self._press, None
        self._gap.hide()
        if press is not None and press.ids:
            self._move_faders(press.start, press.ids, 0.0, press.gesture)
        return press is not None and (press.gap is not None or bool(press.ids))

    def _open_menu(self, ids: tuple[int, ...], at: QPoint) -> None:
        menu, shown = passing_menu(self, "inputs_menu"), shown_gain_curves(self._view)
        chosen = [track for track in self._design.inputs if track.id in ids]
        gain = Entry(
            text="Gain curve",
            key="gain_curve",
            edit=toggle_gain_curves,
            on=lambda track: track.id in shown,
            separated=True,
        )
        entries = (*ENTRIES, *ORDER, gain)
        fill_inputs_menu(
            menu, chosen, lambda edit: self._edit(edit, ids), place=_PLACE, entries=entries
        )
        menu.popup(at)
