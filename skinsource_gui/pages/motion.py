"""The page that makes up a motion on a path of places and adds its tracks to the design.

A draft holds the motion; the path is clicked on the hand or typed, and fields set the rest.
"""

from contextlib import suppress
from dataclasses import replace
from html import escape
from itertools import pairwise
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal

from skinsource.base.errors import InvalidInputError, counted, sentence
from skinsource.design import edits
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit, Refusal, leading_clip
from skinsource.design.edits.motions import motion_of
from skinsource.design.motions import (
    LEVEL,
    MOTIONS,
    Motion,
    path_of,
    with_motion_field,
    with_path_of,
)
from skinsource.design.target import Target
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import ModelSpec
from skinsource_gui.fields.editors import new_editor
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.parts import PartFields
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.panels.hand.panel import HandDiagram
from skinsource_gui.panels.hand.picture import HandLayout, Marker, drawing_of, paint_occupied
from skinsource_gui.plots.preview import ClipStrip, Lane, strip_clip
from skinsource_gui.qt.buttons import page_button, page_label, scrolled
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.overlays import Overlay
from skinsource_gui.qt.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.state.document import Document


class Draft(QObject):
    """Holds the motion that is made up, and the latest motion of each other kind.

    Parameters
    ----------
    design, view
        Design that the motion is to be added to, or in which it is changed.
    index
        Which motion of the design is changed; None: it is a new one.

    Attributes
    ----------
    motion
        The motion; while the path is not valid, with the last valid path.
    path
        The path as it was clicked or typed.
    problem
        Why the motion cannot follow that path, or "".
    """

    changed = Signal()

    def __init__(
        self, design: Design, view: View, parent: QObject, index: int | None = None
    ) -> None:
        super().__init__(parent)
        self._design, self._view, self._index = design, view, index
        self._limb = facts_of(design.limb)
        self._left: dict[str, Motion] = {kind.__name__: kind() for kind in MOTIONS}
        self.motion: Motion = self._left[MOTIONS[0].__name__]
        if index is not None:
            self.motion = design.motions[index].motion
        else:
            # The playhead may be later than the latest onset.
            with suppress(InvalidInputError):
                self.motion = with_motion_field(self.motion, "onset_s", view.playhead_s)
        self.path, self.problem = self.motion.path, ""
        # A phantom takes two places only; the next kind gets all of them back.
        self._whole_path = self.path

    def change(self, motion: Motion) -> None:
        """Change fields of the motion, or its kind, to the latest of that; the path stays."""
        if type(motion) is type(self.motion):
            self._set(motion, self.path, self.problem)
            return
        self._left[type(self.motion).__name__] = self.motion
        motion = with_path_of(self._left[type(motion).__name__], self.motion)
        with suppress(InvalidInputError):
            motion = with_motion_field(motion, "path", self._whole_path)
        self._set(motion)

    def change_path(self, path: tuple[int, ...]) -> None:
        """Change the path; one that is not valid yet is shown, but the motion does not follow."""
        self._whole_path = path
        problem = _why_no_path(self.motion, path, self._limb.n_inputs)
        if problem:
            self.path, self.problem = path, problem
            self.changed.emit()
        else:
            self._set(with_motion_field(self.motion, "path", path))

    def lanes(self) -> tuple[Lane, ...]:
        """Return the tracks of the motion as they would be added.

        Raises
        ------
        InvalidInputError
            A clip would start too late, there would be too many inputs, or something is in it that
            the limb cannot play at its rate.
        """
        outcome = self.outcome(self._design, self._view)
        if isinstance(outcome, Refusal):
            raise InvalidInputError(outcome.sentence)
        after = outcome.design
        group = after.motions[-1 if self._index is None else self._index]
        tracks = [after.input(id) for id in outcome.view.selected_inputs]
        largest = max(abs(track.amplitude) for track in tracks) or 1.0
        return tuple(
            Lane(
                place=track.location,
                colour=track.colour,
                clips=tuple(
                    strip_clip(clip, track.amplitude / largest, self._limb.sample_rate_hz)
                    for clip in track.clips
                    if clip.id in group.clips
                ),
            )
            for track in tracks
        )

    def outcome(self, design: Design, view: View) -> Edit | Refusal:
        """Return the edit that adds or changes the motion."""
        if self._index is None:
            return edits.add_motion(design, view, self.motion)
        return edits.change_motion(design, view, self._index, self.motion)

    def _set(self, motion: Motion, path: tuple[int, ...] | None = None, problem: str = "") -> None:
        self.motion = motion
        self.path, self.problem = motion.path if path is None else path, problem
        self.changed.emit()


def _why_no_path(motion: Motion, path: tuple[int, ...], n_places: int) -> str:
    """Return why ``motion`` cannot follow ``path``; "" where it can."""
    spec: Any = specs_of(motion)["path"]
    unknown = next((place for place in path if not 1 <= place <= n_places), None)
    if unknown is not None:
        return f"There is no place {unknown}; the hand has 1 to {n_places}."
    if len(path) < spec.fewest:
        return f"Click {counted(spec.fewest - len(path), 'more place')}."
    if len(path) > spec.most:
        return f"{motion.title} takes {spec.most} places; remove the last."
    try:
        with_motion_field(motion, "path", path)
    except InvalidInputError as error:
        return sentence(str(error))
    return ""


_ARROW_PX = 9.0
_BADGE_PX = 15.0


class PathLayer(Overlay):
    """Paints a path of places over a hand, which gets the events of the pointer."""

    def __init__(self, hand: HandDiagram) -> None:
        super().__init__(hand)
        self._hand = hand
        self._path: tuple[int, ...] = ()
        self._colours: dict[int, QtGui.QColor] = {}
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        # Places move with the zoom of the hand.
        hand.stage.changed.connect(self.update)

    def show_path(self, path: tuple[int, ...], colours: dict[int, QtGui.QColor]) -> None:
        """Show a path, and the colour of the track of each of its places."""
        self._path, self._colours = path, colours
        self.update()

    @property
    def _places(self) -> HandLayout:
        return self._hand.stage.layout

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        on_hand = [place for place in self._path if self._places.has(place)]
        for place in dict.fromkeys(on_hand):
            self._paint_place(painter, place)
        for here, there in pairwise(on_hand):
            self._paint_leg(painter, here, there)
        for place in dict.fromkeys(on_hand):
            self._paint_order(painter, place)

    def _paint_place(self, painter: QtGui.QPainter, number: int) -> None:
        place = Marker(
            site=number,
            centre=self._places.centre(number),
            radius_px=self._places.radius_in_use_px(number),
            push=self._places.push(number),
        )
        colour = self._colours.get(number, QtGui.QColor(current_theme().accent))
        paint_occupied(painter, place, current_theme(), [colour], silent=False)

    def _paint_leg(self, painter: QtGui.QPainter, here: int, there: int) -> None:
        if here == there:
            return
        way = self._places.centre(there) - self._places.centre(here)
        length = (way.x() ** 2 + way.y() ** 2) ** 0.5
        unit = way / length
        across = QPointF(-unit.y(), unit.x())
        start = self._places.centre(here) + unit * (self._places.radius_in_use_px(here) + 1.0)
        tip = self._places.centre(there) - unit * (self._places.radius_in_use_px(there) + 1.0)
        base = tip - unit * _ARROW_PX
        half = across * (0.5 * _ARROW_PX)
        for colour, width in ((current_theme().base, 5.0), (current_theme().accent, 2.0)):
            painter.setPen(QtGui.QPen(QtGui.QColor(colour), width))
            painter.drawLine(start, base)
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().base), 1.0))
        painter.setBrush(QtGui.QColor(current_theme().accent))
        painter.drawPolygon(QtGui.QPolygonF([tip, base + half, base - half]))

    def _paint_order(self, painter: QtGui.QPainter, number: int) -> None:
        turns = [str(k) for k, place in enumerate(self._path, 1) if place == number]
        label = ",".join(turns[:3]) + ("…" if len(turns) > 3 else "")
        font = tabular(self.font())
        font.setPixelSize(11)
        painter.setFont(font)
        width = max(painter.fontMetrics().horizontalAdvance(label) + 6.0, _BADGE_PX)
        off = 0.75 * self._places.radius_in_use_px(number)
        corner = self._places.centre(number) + QPointF(off, -off)
        area = QRectF(corner.x() - _BADGE_PX / 2, corner.y() - _BADGE_PX / 2, width, _BADGE_PX)
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().accent), 1.0))
        painter.setBrush(QtGui.QColor(current_theme().base))
        painter.drawRoundedRect(area, _BADGE_PX / 2, _BADGE_PX / 2)
        painter.setPen(QtGui.QColor(current_theme().text))
        painter.drawText(area, Qt.AlignmentFlag.AlignCenter, label)


class PathRow(QtWidgets.QWidget):
    """Shows a path as text; it can be typed, reversed, shortened and cleared."""

    #: Another path was typed or made by a button.
    path_changed = Signal(tuple)
    #: Why the typed text is no path.
    misread = Signal(str)
    #: Typing is over.
    finished = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._path: tuple[int, ...] = ()
        self.field = QtWidgets.QLineEdit()
        named(self.field, "path_field", "Path", "Numbers of places, in their order: 16, 18, 20")
        self._buttons = (
            page_button("reverse_path", "Reverse", "Reverse the order of places"),
            page_button("remove_last", "Remove last", "Remove the last place of the path"),
            page_button("clear_path", "Clear", "Remove all places of the path"),
        )
        self._lay_out()
        self.field.textEdited.connect(self._type)
        self.field.editingFinished.connect(self._finish)
        reverse, remove, clear = self._buttons
        reverse.clicked.connect(lambda: self.path_changed.emit(self._path[::-1]))
        remove.clicked.connect(self.remove_last)
        clear.clicked.connect(lambda: self.path_changed.emit(()))

    def show_path(self, path: tuple[int, ...]) -> None:
        """Show a path; a text that is being typed and means the same path stays."""
        self._path = path
        if not self.field.hasFocus() or _typed(self.field.text()) != path:
            self.field.setText(_path_text(path))
        for button in self._buttons:
            button.setEnabled(bool(path))

    def append(self, place: int) -> None:
        """Append a place to the path."""
        self.path_changed.emit((*self._path, place))

    def remove_last(self) -> None:
        """Remove the last place of the path."""
        self.path_changed.emit(self._path[:-1])

    def _lay_out(self) -> None:
        label = QtWidgets.QLabel("Path")
        label.setBuddy(self.field)
        in_column(in_row(label, (self.field, 1)), in_row(*self._buttons), of=self, margins=0)

    def _type(self, text: str) -> None:
        try:
            self.path_changed.emit(path_of(text))
        except InvalidInputError as error:
            self.misread.emit(sentence(str(error)))

    def _finish(self) -> None:
        self.field.setText(_path_text(self._path))
        self.finished.emit()


def _path_text(path: tuple[int, ...]) -> str:
    return ", ".join(map(str, path))


def _typed(text: str) -> tuple[int, ...] | None:
    """Return the path in a text; None where the text is no path."""
    try:
        return path_of(text)
    except InvalidInputError:
        return None


TITLE = "Motion"
_HEIGHT_PX = 660


class MotionPage(ToolPage):
    """Makes up a motion on a path of places, shows it, and adds it in one step."""

    def __init__(self, document: Document, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent, "motion_page", TITLE, (980, _HEIGHT_PX))
        self._document = document
        clip = leading_clip(document.design, document.view)
        index = None if clip is None else motion_of(document.design, clip.id)
        if index is not None and isinstance(document.design.motions[index].motion, Target):
            index = None  # it has a panel
        self.draft = Draft(document.design, document.view, self, index)
        self.hand = HandDiagram(drawing_of(document.design.limb), self)
        self.hand.setAccessibleName("Path on the hand, palm side")
        self._path = PathLayer(self.hand)
        self.path_row = PathRow()
        self.strip = ClipStrip()
        limb = facts_of(document.design.limb)
        spec = ModelSpec(label="Motion", kinds=lambda: MOTIONS, hint="Kind of motion")
        self.fields = PartFields(spec.at_rate(limb.sample_rate_hz, limb.band_hz), new_editor, self)
        self._grid = FieldGrid()
        self._summary = page_label("motion_summary")
        self._about = page_label("motion_about", tone="dim")
        self._about.setTextFormat(Qt.TextFormat.RichText)
        name, hint = "Add", "Add the inputs to the design, in one step"
        if index is not None:
            name, hint = "Change", "Change the inputs of the selected motion, in one step"
        self._add = self.add_button("add_motion", name, hint, self._keep)
        self._cancel = self.add_button(
            "cancel_motion", "Cancel", "Close; nothing is changed", self.reject
        )
        self._lay_out()
        self.draft.changed.connect(self._show)
        self.hand.add_requested.connect(self.path_row.append)
        self.hand.remove_requested.connect(self.path_row.remove_last)
        self.path_row.path_changed.connect(self.draft.change_path)
        self.path_row.misread.connect(self._show_problem)
        self.path_row.finished.connect(self._show_lanes)
        self.fields.edited.connect(self.draft.change)
        self._show()

    def _lay_out(self) -> None:
        left = in_column((self.hand, 1), self.path_row)
        inside = QtWidgets.QWidget()
        in_column(self._grid, None, of=inside, margins=(0, 0, UNIT_PX, 0))
        scroll = scrolled(inside, "motion_fields")
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        ends = in_row(None, self._add, self._cancel)
        right = in_column(
            (scroll, 3), self._summary, (self.strip, 2), self._about, ends, gap_px=UNIT_PX
        )
        in_row((left, 4), (right, 7), of=self, gap_px=2 * UNIT_PX)

    def _keep(self) -> None:
        outcome = self.draft.outcome(self._document.design, self._document.view)
        if isinstance(outcome, Refusal):
            self._show_problem(outcome.sentence)
            return
        self._document.apply(outcome)
        self.accept()

    def _show(self) -> None:
        motion = self.draft.motion
        before = self.fields.cells
        self.fields.show_model(motion)
        if self.fields.cells != before:
            self._show_cells()
        self._summary.setText(motion.summary)
        self._about.setText(_about(motion))
        self.path_row.show_path(self.draft.path)
        self._show_lanes()

    def _show_cells(self) -> None:
        unit = amplitude_unit(self._document.design)
        for cell in self.fields.cells:
            if cell.name == "amplitude":
                cell.set_spec(replace(LEVEL, unit=unit))
        self._grid.show_cells(self.fields.cells)

    def _show_lanes(self) -> None:
        colours: dict[int, QtGui.QColor] = {}
        problem = self.draft.problem
        try:
            lanes = self.draft.lanes()
            colours = {lane.place: current_theme().input_colour(lane.colour) for lane in lanes}
            self.strip.show_lanes(lanes)
        except InvalidInputError as error:
            problem = problem or sentence(str(error))
        self._path.show_path(self.draft.path, colours)
        self._show_problem(problem)

    def _show_problem(self, problem: str) -> None:
        self._add.setEnabled(not problem)
        self._summary.setVisible(not problem)
        if problem:
            self.strip.show_message(problem)


def _about(motion: Motion) -> str:
    parts = (("Law", motion.law), ("Source", motion.source), ("On the palm", motion.limits))
    return "<br>".join(f"<b>{name}.</b> {escape(text)}" for name, text in parts)
