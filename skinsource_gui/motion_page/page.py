"""The page that makes up a motion."""

from dataclasses import replace
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QDialog,
    QFrame,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import sentence
from skinsource.design import edits
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.edits import Refusal
from skinsource.design.edits.edit import kind_spec
from skinsource.design.motions import MOTIONS, Motion
from skinsource.design.waveforms import kinds
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.fields import ChoiceSpec, NumberSpec, Spec
from skinsource_gui.motion_page.draft import Draft
from skinsource_gui.motion_page.path_layer import PathLayer
from skinsource_gui.motion_page.path_row import PathRow
from skinsource_gui.motion_page.recipe_fields import RecipeFields
from skinsource_gui.panels.hand.drawings import drawing_of
from skinsource_gui.panels.hand.hand_diagram import HandDiagram
from skinsource_gui.state.document import Document
from skinsource_gui.theme import UNIT_PX, current_theme, set_tone
from skinsource_gui.widgets.inputs.clip_strip import ClipStrip
from skinsource_gui.widgets.page_button import page_button

TITLE = "Motion"
_MOTION_KINDS = ChoiceSpec(
    label="Motion",
    options=tuple((kind.__name__, kind.title) for kind in MOTIONS),
    hint="What seems to happen on the skin",
)
_HEIGHT_PX = 660


class MotionPage(QDialog):
    """Makes up a motion on a path of places, shows it, and adds it in one step.

    Parameters
    ----------
    document
        What it is added to.
    """

    def __init__(self, document: Document, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("motion_page")
        self.setWindowTitle(TITLE)
        self.resize(980, _HEIGHT_PX)
        self._document = document
        self.draft = Draft(document.design, document.view.playhead_s, self)
        self.hand = HandDiagram(drawing_of(document.design.limb), self)
        self.hand.setAccessibleName("Path on the hand, palm side")
        self._path = PathLayer(self.hand)
        self.path_row = PathRow()
        self.strip = ClipStrip()
        self.motion_fields = RecipeFields(self._of_motion, self)
        limb = facts_of(document.design.limb)
        self.waveform_fields = RecipeFields(
            lambda _, spec: spec.at_rate(limb.sample_rate_hz, limb.band_hz), self
        )
        self._summary, self._about = QLabel(), QLabel()
        self._buttons()
        self._lay_out()
        self._connect()
        self._show()

    def _buttons(self) -> None:
        self._add = page_button("add_motion", "Add", "Add the tracks to the design, in one step")
        self._cancel = page_button("cancel_motion", "Cancel", "Close; nothing is changed")
        for label, name in (
            (self._summary, "motion_summary"),
            (self._about, "motion_about"),
        ):
            label.setObjectName(name)
            label.setWordWrap(True)
        self._about.setTextFormat(Qt.TextFormat.RichText)
        set_tone(self._about, "dim")

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.addWidget(self.hand, 1)
        left.addWidget(self.path_row)
        grids = QHBoxLayout()
        grids.setSpacing(3 * UNIT_PX)
        for grid in (self.motion_fields.grid, self.waveform_fields.grid):
            grids.addWidget(grid, 1, Qt.AlignmentFlag.AlignTop)
        inside = QWidget()
        inside.setLayout(grids)
        grids.setContentsMargins(0, 0, UNIT_PX, 0)
        scroll = QScrollArea()
        scroll.setObjectName("motion_fields")
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        scroll.setWidget(inside)
        ends = QHBoxLayout()
        ends.addStretch(1)
        ends.addWidget(self._add)
        ends.addWidget(self._cancel)
        right = QVBoxLayout()
        right.setSpacing(UNIT_PX)
        right.addWidget(scroll, 3)
        right.addWidget(self._summary)
        right.addWidget(self.strip, 2)
        right.addWidget(self._about)
        right.addLayout(ends)
        columns = QHBoxLayout(self)
        columns.setSpacing(2 * UNIT_PX)
        columns.addLayout(left, 4)
        columns.addLayout(right, 7)

    def _connect(self) -> None:
        self.draft.changed.connect(self._show)
        self.draft.field_refused.connect(self._show_refused)
        self.draft.waveform_field_refused.connect(self._show_waveform_refused)
        self.hand.add_requested.connect(self.path_row.append)
        self.hand.add_besides_requested.connect(self.path_row.append)
        self.hand.remove_requested.connect(self.path_row.remove_last)
        self.path_row.path_wanted.connect(self.draft.change_path)
        self.path_row.misread.connect(self._show_problem)
        self.path_row.finished.connect(self._show_lanes)
        self.motion_fields.kind_chosen.connect(self.draft.change_kind)
        self.motion_fields.edited.connect(self.draft.change_field)
        self.waveform_fields.kind_chosen.connect(self.draft.change_waveform_kind)
        self.waveform_fields.edited.connect(self.draft.change_waveform_field)
        self._add.clicked.connect(self._keep)
        self._cancel.clicked.connect(self.reject)

    def _show_refused(self, name: str, why: str) -> None:
        self.motion_fields.show_refused(self.draft.motion, name, why)

    def _show_waveform_refused(self, name: str, why: str) -> None:
        self.waveform_fields.show_refused(self.draft.motion.waveform, name, why)

    def _keep(self) -> None:
        outcome = edits.add_motion(self._document.design, self._document.view, self.draft.motion)
        if isinstance(outcome, Refusal):
            self._show_problem(outcome.sentence)
            return
        self._document.apply(outcome)
        self.accept()

    def _show(self) -> None:
        motion = self.draft.motion
        self.motion_fields.show_recipe(motion, _MOTION_KINDS)
        self.waveform_fields.show_recipe(motion.waveform, _waveform_kinds(self.draft))
        self._summary.setText(motion.summary)
        self._about.setText(_about(motion))
        self.path_row.show_path(self.draft.path)
        self._show_lanes()

    def _show_lanes(self) -> None:
        colours: dict[int, QColor] = {}
        problem = self.draft.problem
        try:
            lanes = self.draft.lanes()
            colours = {one.place: current_theme().input_colour(one.colour) for one in lanes}
            self.strip.show_lanes(lanes)
        except InvalidInputError as error:
            problem = problem or sentence(str(error))
        self._path.show_path(self.draft.path, colours)
        self._show_problem(problem)

    def _show_problem(self, problem: str) -> None:
        self._add.setEnabled(not problem)
        self._summary.setVisible(not problem)
        if problem:
            self.strip.show_words(problem)

    def _of_motion(self, name: str, spec: Spec) -> Spec | None:
        if name in ("path", "waveform"):
            return None
        if name == "amplitude" and isinstance(spec, NumberSpec):
            design = self._document.design
            return replace(spec, unit=amplitude_unit(design))
        return spec


def _about(motion: Motion) -> str:
    parts = (("Law", motion.law), ("Source", motion.source), ("On the palm", motion.limits))
    return "<br>".join(f"<b>{name}.</b> {escape(words)}" for name, words in parts)


def _waveform_kinds(draft: Draft) -> ChoiceSpec:
    if draft.waveform_kinds == kinds():
        return kind_spec()
    return ChoiceSpec(
        label="Waveform",
        options=tuple((kind.__name__, kind.title) for kind in draft.waveform_kinds),
        hint="What plays at each place",
    )
