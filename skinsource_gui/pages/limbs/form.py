"""The draft of an own limb, and the form and the canvas of the page that edits it."""

import dataclasses
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPointF, QRectF, QSize, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource.base.errors import counted
from skinsource.design.design import AXES
from skinsource.limbs.limb_import import LimbSource
from skinsource.limbs.own_limbs import NAME_RULE
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.hand.picture import spacing_of
from skinsource_gui.qt.buttons import page_button
from skinsource_gui.qt.frames import fitted
from skinsource_gui.qt.layouts import add_row, form_of, in_row, named, tooltip
from skinsource_gui.qt.resources import number_named
from skinsource_gui.qt.theme import UNIT_PX, current_theme, set_tone

_NO_POINTS, _TURN = np.empty((0, 2)), np.array((1.0, -1.0))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Draft:
    """Files, points and values of a limb, as far as they are chosen.

    Attributes
    ----------
    responses
        File of the responses; None: not chosen yet.
    shape
        Shape of the responses: inputs, outputs, axes and taps; None: not known.
    in_layout
        Whether the file is in the layout of limbs, which states all that is needed.
    outline, inputs, outputs
        Points, (n, 2), as they are drawn: x right, y down where there is a photograph, else up.
    hand
        The two ends of the length of the hand, (n, 2), clicked on a photograph.
    y_down
        Whether y points down: points are pixels of a photograph.
    tables
        Which of these points come from files.
    turned
        Whether y of these files was turned: the outline is an SVG, where y points down, and the
        tables are assumed to follow it.
    input_names, output_names
        From tables.
    values
        Typed values: fields of `skinsource.limbs.own_limbs.OwnLimb`.
    """

    responses: Path | None = None
    shape: tuple[int, ...] | None = None
    in_layout: bool = False
    outline: Floats = dataclasses.field(default_factory=_NO_POINTS.copy)
    inputs: Floats = dataclasses.field(default_factory=_NO_POINTS.copy)
    outputs: Floats = dataclasses.field(default_factory=_NO_POINTS.copy)
    hand: Floats = dataclasses.field(default_factory=_NO_POINTS.copy)
    y_down: bool = False
    tables: frozenset[str] = frozenset()
    turned: bool = False
    order: str = ""
    input_names: tuple[str, ...] = ()
    output_names: tuple[str, ...] = ()
    values: dict[str, Any] = dataclasses.field(default_factory=dict)

    def with_point(self, what: str, point: tuple[float, float]) -> "Draft":
        """Return a draft with one more point; a third end of the hand replaces the first."""
        points = np.vstack((getattr(self, what), [point]))
        changed: dict[str, Any] = {what: points[-2:] if what == "hand" else points}
        return replace(self, **changed)

    def with_file(self, what: str, points: Floats, *, y_down: bool) -> "Draft":
        """Return a draft with the points of a file, whose y points down or up."""
        if self.y_down:
            # Pixels of the photograph.
            as_clicked: dict[str, Any] = {what: points}
            return replace(self, **as_clicked)
        turned = y_down if what == "outline" else self.turned
        changed: dict[str, Any] = {what: points * _TURN if turned else points}
        if turned != self.turned:
            changed |= {table: getattr(self, table) * _TURN for table in self.tables - {what}}
        return replace(self, tables=self.tables | {what}, turned=turned, **changed)

    def with_array(self, path: Path) -> "Draft":
        """Return a draft with an array of responses, without the points of a file in the layout."""
        nothing: dict[str, Any] = {"responses": path, "shape": None, "in_layout": False}
        if self.in_layout and not self.y_down:
            for what in {"outline", "inputs", "outputs"} - self.tables:
                nothing[what] = _NO_POINTS.copy()
        return replace(self, **nothing)

    def without_last(self, what: str) -> "Draft":
        """Return a draft without the last point of ``what``."""
        return replace(self, **{what: getattr(self, what)[:-1]})

    def source(self) -> LimbSource:
        """Return what is imported; the file's own values count where nothing was chosen."""
        if self.responses is None:
            raise ValueError("no responses are chosen; open a file")
        values = dict(self.values)
        if len(self.hand) == 2:
            values["hand_length_px"] = float(np.linalg.norm(self.hand[1] - self.hand[0]))
        for name in ("input_names", "output_names"):
            if getattr(self, name):
                values[name] = getattr(self, name)
        return LimbSource(
            responses=self.responses,
            order=self.order,
            outline=self.outline if len(self.outline) else None,
            inputs=self.inputs if len(self.inputs) else None,
            outputs=self.outputs if len(self.outputs) else None,
            y_down=self.y_down,
            values=values,
        )

    def missing(self) -> str:
        """Return what is still to be done, as a sentence; empty: the limb can be imported."""
        if self.responses is None:
            return "Choose the file of the responses."
        placed = (self.inputs, self.outputs, self.outline, self.hand)
        if self.in_layout and self.y_down and not any(map(len, placed)):
            # Nothing was clicked on the photograph, so the points of the file count.
            return ""
        if not self.values.get("name"):
            return "Give the limb a name."
        axes = self.values.get("axes", "")
        if self.shape and len(axes) != self.shape[2]:
            axes_there = f"{self.shape[2]} ax{'is' if self.shape[2] == 1 else 'es'}"
            return f"The responses have {axes_there}; choose as many."
        for what, index in (("inputs", 0), ("outputs", 1)):
            n, expected = len(getattr(self, what)), self.shape[index] if self.shape else 0
            if expected and n != expected:
                return f"{n} of {expected} {what} have a place: click them, or open a table."
        if self.in_layout and len(self.outline) < 3:
            return "Click the corners of the outline: the file's has another unit."
        if self.y_down and len(self.hand) != 2:
            return "Click both ends of the hand's length: fingertip and wrist."
        return ""


_RADIUS_PX, _DOT_PX = 8.0, 4.0
# Radius of a mark in a crowd, as a share of the distance to the nearest mark of its kind; its least
# radius; and the least radius of a mark with a number.
_OF_SPACING, _CROWDED_PX, _NUMBERED_PX = 0.44, 2.0, 7.0
_NOTHING = "Outline and places appear here. Open a photograph to click them."


class PlacesCanvas(QtWidgets.QWidget):
    """Shows photograph, outline and places of a draft, and emits clicks in its coordinates."""

    #: x, y
    clicked = Signal(float, float)

    def __init__(self) -> None:
        super().__init__()
        self._draft = Draft()
        self._photograph = QtGui.QImage()
        named(self, "places_canvas", "Outline and places")
        self.setMinimumSize(260, 320)

    def show_photograph(self, photograph: QtGui.QImage) -> None:
        """Show a photograph under the places."""
        self._photograph = photograph
        can_click = not photograph.isNull()
        self.setCursor(Qt.CursorShape.CrossCursor if can_click else Qt.CursorShape.ArrowCursor)
        self.update()

    def show_draft(self, draft: Draft) -> None:
        """Show outline and places."""
        self._draft = draft
        placed = f"{counted(len(draft.inputs), 'input')}, {counted(len(draft.outputs), 'output')}"
        self.setAccessibleDescription(
            f"{placed}, outline of {counted(len(draft.outline), 'corner')}"
        )
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(380, 460)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self._photograph.isNull():
            return
        back, can_turn = self._transform().inverted()
        if can_turn:
            at = back.map(event.position())
            self.clicked.emit(at.x(), at.y())

    def place_of(self, x: float, y: float) -> QPointF:
        """Return the position of a point of the draft on the screen."""
        return self._transform().map(QPointF(x, y))

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme, draft = QtGui.QPainter(self), current_theme(), self._draft
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QtGui.QPainter.RenderHint.SmoothPixmapTransform)
        painter.fillRect(self.rect(), QtGui.QColor(theme.base))
        transform = self._transform()
        if not self._photograph.isNull():
            painter.save()
            painter.setTransform(transform)
            painter.drawImage(0, 0, self._photograph)
            painter.restore()
        if self._bounds().isEmpty():
            painter.setPen(QtGui.QColor(theme.dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect().adjusted(8, 8, -8, -8), int(flags), _NOTHING)
        self._paint_outline(painter, transform, draft.outline)
        self._paint_hand(painter, transform, draft.hand)
        font = painter.font()
        font.setPixelSize(10)
        painter.setFont(font)
        for points, colour, radius in (
            (draft.outputs, theme.text, _DOT_PX),
            (draft.inputs, theme.accent, _RADIUS_PX),
        ):
            self._paint_points(painter, transform, points, QtGui.QColor(colour), radius)

    def _paint_outline(
        self, painter: QtGui.QPainter, transform: QtGui.QTransform, outline: Floats
    ) -> None:
        line = QtGui.QPolygonF([transform.map(QPointF(x, y)) for x, y in outline])
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().accent), 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolygon(line)

    def _paint_hand(
        self, painter: QtGui.QPainter, transform: QtGui.QTransform, hand: Floats
    ) -> None:
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().error), 2.0))
        ends = [transform.map(QPointF(x, y)) for x, y in hand]
        for end in ends:
            painter.drawEllipse(end, 3.0, 3.0)
        if len(ends) == 2:
            painter.drawLine(ends[0], ends[1])

    def _paint_points(
        self,
        painter: QtGui.QPainter,
        transform: QtGui.QTransform,
        points: Floats,
        fill: QtGui.QColor,
        radius: float,
    ) -> None:
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().base), 1.0))
        painter.setBrush(fill)
        scale = abs(transform.m11())
        radii = np.clip(_OF_SPACING * scale * spacing_of(points), _CROWDED_PX, radius)
        for number, ((x, y), own) in enumerate(zip(points, radii, strict=True), start=1):
            if not np.isfinite((x, y)).all():
                continue
            centre = transform.map(QPointF(x, y))
            painter.drawEllipse(centre, float(own), float(own))
            if own >= _NUMBERED_PX:
                area = QRectF(centre.x() - 12, centre.y() - 7, 24, 14)
                painter.drawText(area, Qt.AlignmentFlag.AlignCenter, str(number))

    def _bounds(self) -> QRectF:
        if not self._photograph.isNull():
            return QRectF(self._photograph.rect())
        parts = (self._draft.outline, self._draft.inputs, self._draft.outputs)
        points = np.vstack(parts)
        points = points[np.isfinite(points).all(axis=1)]
        if len(points) < 2:
            return QRectF()
        low, high = points.min(axis=0), points.max(axis=0)
        return QRectF(QPointF(*low), QPointF(*np.maximum(high, low + 1e-6)))

    def _transform(self) -> QtGui.QTransform:
        """Return the transform from the coordinates of the draft to pixels."""
        bounds = self._bounds()
        room = QRectF(self.rect()).adjusted(UNIT_PX, UNIT_PX, -UNIT_PX, -UNIT_PX)
        if bounds.isEmpty():
            return QtGui.QTransform()
        up = not self._draft.y_down and self._photograph.isNull()
        return fitted(bounds, room, up=up).transform()


_AXES = replace(AXES, hint="Axes of each output, in file order; z: normal")
_STARTING_AXES = "z"
_BAND = ("lowest_hz", "highest_hz")
_NUMBERS = {
    name: number_named(f"limb_{name}")
    for name in ("sample_rate_hz", "hand_length_mm", "pre_trigger_delay_s", *_BAND)
}
# Number fields hold lengths in metres.
_METRES = 1e-3
_STARTS = {"sample_rate_hz": 4000.0, "hand_length_mm": 0.18}
_FILES = {
    "responses": ("Responses", "HDF5 as in docs/limbs.md, or an array: NPY, NPZ, MATLAB, HDF5"),
    "outline": ("Outline", "SVG, or CSV of x and y; without one a hull is drawn"),
    "inputs": ("Inputs", "CSV of x, y and name, or click them on a photograph"),
    "outputs": ("Outputs", "CSV of x, y and name, or click them on a photograph"),
    "photograph": ("Photograph", "A picture on which places are clicked"),
}


class LimbForm(QObject):
    """Fields for the name, the measurement and the files of a limb, in ``widget``."""

    #: A value was typed or chosen.
    changed = Signal()
    #: A file is to be chosen: "responses", "outline", "inputs", "outputs" or "photograph".
    file_requested = Signal(str)

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.widget = QtWidgets.QWidget(parent)
        self._rows = form_of(self.widget)
        self._chosen: dict[str, QtWidgets.QLabel] = {}
        self.name, self.title, self.note, self.order = (QtWidgets.QLineEdit() for _ in range(4))
        self.axes = ChoiceField(_AXES)
        self.numbers = {name: NumberField(spec) for name, spec in _NUMBERS.items()}
        # Whether a file in the layout stated the values: they go with it.
        self._stated = False
        self.left, self.mirrored = (
            QtWidgets.QCheckBox("Left hand"),
            QtWidgets.QCheckBox("Show mirrored"),
        )
        self.synthetic = QtWidgets.QCheckBox("Computed, not measured")
        self.mirrored.setToolTip(tooltip("Show mirrored", "A left hand as a right one"))
        self._lay_out()
        self._start_over()

    def show_file(self, what: str, text: str) -> None:
        """Show which file was chosen."""
        self._chosen[what].setText(text)

    def show_header(self, header: dict[str, Any]) -> None:
        """Show the values of a file in the layout; all of them can be changed."""
        for field, key in ((self.name, "name"), (self.title, "title"), (self.note, "note")):
            field.setText(str(header[key]))
        self.axes.set_value(str(header["axes"]))
        values = {**header, **dict(zip(_BAND, header["band_hz"] or (0.0, 0.0), strict=True))}
        for name, field in self.numbers.items():
            field.set_value(float(values[name]) * (_METRES if name == "hand_length_mm" else 1.0))
        self.left.setChecked(header["left"])
        self.synthetic.setChecked(bool(header["synthetic"]))
        self._stated = True

    def show_plain(self, in_layout: bool, path: Path) -> None:
        """Ask for the values that an array does not state."""
        self._rows.setRowVisible(self.order, not in_layout)
        if in_layout:
            return
        if self._stated:
            self._start_over()
        if not self.name.text():
            stem = "".join(letter if letter.isalnum() else "-" for letter in path.stem.lower())
            self.name.setText(stem.strip("-0123456789")[:40])

    def _start_over(self) -> None:
        self._stated = False
        for line in (self.name, self.title, self.note):
            line.clear()
        self.axes.set_value(_STARTING_AXES)
        for name, number in self.numbers.items():
            number.set_value(_STARTS.get(name, 0.0))
        for box in (self.left, self.synthetic):
            box.setChecked(False)

    def values(self) -> dict[str, Any]:
        """Return the typed fields of `skinsource.limbs.own_limbs.OwnLimb`."""
        numbers = {name: field.value_si for name, field in self.numbers.items()}
        numbers["hand_length_mm"] /= _METRES
        lowest_hz, highest_hz = (numbers.pop(name) for name in _BAND)
        return {
            "name": self.name.text().strip(),
            "title": self.title.text().strip(),
            "note": self.note.text().strip(),
            "axes": self.axes.value,
            "left": self.left.isChecked(),
            "mirrored": self.mirrored.isChecked(),
            "synthetic": self.synthetic.isChecked(),
            "band_hz": (lowest_hz, highest_hz) if highest_hz > 0.0 else None,
            **numbers,
        }

    def _lay_out(self) -> None:
        self._add_file("responses")
        for label, field, hint in (
            ("Name", self.name, f"Name in designs: {NAME_RULE}"),
            ("Title", self.title, "Title in the window; empty: the name"),
            ("Note", self.note, "Note for users"),
            ("Order", self.order, "Dimensions of the array: i input, o output, a axis, t tap"),
        ):
            add_row(self._rows, f"limb_{label.lower()}", label, field, hint)
            field.textChanged.connect(self.changed)
        self.order.setPlaceholderText("ioat")
        self.axes.edited.connect(self.changed)
        self._rows.addRow("Axes", self.axes)
        named(
            self.synthetic,
            title="Computed, not measured",
            hint=tooltip("Computed", "Pictures and files say that it is synthetic"),
        )
        self.synthetic.toggled.connect(self.changed)
        self._rows.addRow("Origin", self.synthetic)
        for name, field in self.numbers.items():
            add_row(self._rows, f"limb_{name}", _NUMBERS[name].label, field)
            field.edited.connect(self.changed)
        for box in (self.left, self.mirrored):
            box.toggled.connect(self.changed)
        self._rows.addRow("Hand", in_row(self.left, self.mirrored, None))
        for what in ("outline", "inputs", "outputs", "photograph"):
            self._add_file(what)

    def _add_file(self, what: str) -> None:
        label, hint = _FILES[what]
        button: QtWidgets.QPushButton = page_button(f"choose_{what}", "Choose…", hint)
        button.setAccessibleName(f"Choose {label.lower()}")
        button.clicked.connect(lambda: self.file_requested.emit(what))
        chosen = named(QtWidgets.QLabel("none"), f"chosen_{what}")
        set_tone(chosen, "dim")
        self._chosen[what] = chosen
        self._rows.addRow(label, in_row(button, (chosen, 1)))
