"""The page that finds where a few actuators serve best: a question, ranked layouts, and the hand.

A job places them; the layouts are then judged on each limb like that of the design.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt

from skinsource.base.job import Job, Progress, Stop
from skinsource.design import edits
from skinsource.design.design import OUTPUTS
from skinsource.design.edits.edit import Refusal
from skinsource.design.labels import short_limb_title
from skinsource.design.target import Target, target_in
from skinsource.inverse.placement import FINGERTIPS, Layout, Placement, layout, place
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.editors import NumbersEditor
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.units import minus
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.panels.hand.panel import HandDiagram
from skinsource_gui.panels.hand.picture import Mark, drawing_of
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.labels import RowTable
from skinsource_gui.qt.layouts import add_row, form_of, in_column, in_row, named
from skinsource_gui.qt.questions import tab_separated
from skinsource_gui.qt.resources import choice_of, columns_of, number_named
from skinsource_gui.qt.theme import UNIT_PX, current_theme
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner, PageJobs
from skinsource_gui.state.preferences import InstalledLimbs

TITLE = "Where to put actuators"
_MEANING = (
    "Each output alone is made strong and the rest of the hand quiet, with drives found for each "
    "limb. The score is the mean of its contrast from 50 to 300 Hz; a path has no direction."
)
_OF, _ON = choice_of("placement_of"), choice_of("placement_on")
_WHICH = replace(OUTPUTS, hint="Outputs to make strong, each alone")
_COUNT = number_named("placement_count")
_FIRST_COUNT = 3
_COLUMNS = columns_of("placement")
_LOSS_THERE = "Loss on this limb, with drives of its own, dB"
_EMPTY = "Type outputs, or paint strong ones on the skin map."
_ALL_TRIED = "Every set was tried."
_EXCHANGED = "Inputs were added and exchanged one by one: a better set may exist."
_BEHIND = "On each limb, the chosen layout is at most {:.1f} dB below the best found there."
_SIZE_PX = (1120, 600)


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """The layouts, how well each serves on all limbs of the question, and the best there."""

    placement: Placement
    there: tuple[tuple[Layout, ...], ...]
    best_there: tuple[Layout, ...]

    @property
    def rows(self) -> list[tuple[Layout, tuple[Layout, ...]]]:
        """Each layout, and how well it serves on all limbs."""
        return list(zip(self.placement.ranked, self.there, strict=True))

    def behind_db(self, row: int) -> float:
        """Return by how much a layout is below the best of some limb, at most."""
        pairs = zip(self.there[row], self.best_there, strict=True)
        return max(0.0, *(best.score_db - there.score_db for there, best in pairs))


_UNANSWERED = Answer(placement=Placement(ranked=(), exhaustive=True), there=(), best_there=())


def answered(
    people: Mapping[str, str],
    everywhere: bool,
    target: Target,
    outputs: tuple[int, ...],
    *,
    progress: Progress,
    stop: Stop,
    **chosen: Any,
) -> Answer:
    """Place actuators, and judge the layouts on each limb.

    Parameters
    ----------
    people
        Digests of limbs by their names: of that of the design, and then of all others like it.
    everywhere
        Whether the layouts are to be good for all of them, or for the first alone.
    target
        Says along which axes, and how strong or sharp.
    outputs, chosen
        As of `skinsource.inverse.place`; count and keep_apart.
    """
    limbs = {name: load_limb(name, digest) for name, digest in people.items()}
    axes = axes_on(next(iter(people)), target.axes)
    judging: dict[str, Any] = {"targets": outputs, "axes": axes, "beta": target.beta}
    best: list[Placement] = []
    for name, limb in limbs.items():
        progress(len(best), len(limbs), f"Trying layouts on {short_limb_title(name)}")
        best.append(place(limb, stop=stop, **judging, **chosen))
    found = best[0]
    if everywhere:
        found = place(list(limbs.values()), stop=stop, **judging, **chosen)
    return Answer(
        placement=found,
        there=tuple(
            tuple(layout(limb, inputs=each.inputs, **judging) for limb in limbs.values())
            for each in found.ranked
        ),
        best_there=tuple(each.ranked[0] for each in best),
    )


class PlacementPage(ToolPage):
    """Asks how many actuators for which outputs, and shows the best layouts."""

    def __init__(
        self,
        runner: JobRunner,
        limbs: InstalledLimbs,
        document: Document,
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent, "placement_page", TITLE, _SIZE_PX)
        self._document, self.run = document, PageJobs(runner, self)
        self.answer = _UNANSWERED
        limb, found = document.design.limb, target_in(document.design)
        self._target = found[1] if found else None
        kind, published = limb.rpartition("-")[0], limb in PUBLISHED
        others = [name for name in limbs.names if published and name.startswith(f"{kind}-")]
        self._people = (limb, *(name for name in others if name in PUBLISHED and name != limb))
        self._outputs = {"strong": self._target.strong if self._target else (), "path": ()}
        if published:
            self._outputs["tips"] = FINGERTIPS
        self.of, self.on = ChoiceField(_OF), ChoiceField(_ON)
        self.of.set_options([each for each in _OF.options if each[0] in self._outputs])
        self.of.set_value(next((of for of in ("strong", "tips") if self._outputs.get(of)), "path"))
        most = min(_COUNT.maximum, facts_of(limb).n_inputs)
        self.which = NumbersEditor(_WHICH, self)
        self.count = NumberField(replace(_COUNT, maximum=most))
        self.count.set_value(min(_FIRST_COUNT, most))
        self.pairs = QtWidgets.QCheckBox("Two per fingertip")
        titles = {f"{short_limb_title(name)}\nloss, dB": _LOSS_THERE for name in self._people}
        self.table = RowTable(
            "placement_table", "Layouts, the best first", _COLUMNS | titles, wide=(1,)
        )
        self.hand = HandDiagram(drawing_of(limb), self)
        self.hand.setAccessibleName("Layout on the hand, palm side")
        self._find = self.add_button("find_places", "Find", "Find places", self._find_or_stop)
        self._copy = self.add_button("copy_layouts", "Copy", "Copy the table", self.copy)
        self._use = self.add_button(
            "use_inputs", "Use these inputs", "Have the target play these inputs alone", self._take
        )
        self._close = self.add_button("close_page", "Close", "Close this page (Esc)", self.close)
        self._lay_out()
        self.of.edited.connect(self._choose)
        self.which.edited.connect(self._type)
        for edited in (self.count.edited, self.on.edited, self.pairs.clicked):
            edited.connect(self.ask)
        self.table.currentCellChanged.connect(self._show_layout)
        self.run.changed.connect(lambda: self._find.setText("Stop" if self.run.busy else "Find"))
        self.follow_jobs(self.run, self._show, cancelled="Stopped.")
        self.finished.connect(self.run.give_up)
        self._choose()

    def ask(self, *_: object) -> None:
        """Find the layouts for what the fields say."""
        self.run.give_up()
        self._clear()
        if not self.which.value:
            self.say(_EMPTY)
            return
        design = self._document.design
        work = partial(
            answered,
            dict.fromkeys(self._people, "") | {design.limb: design.limb_digest},
            self.on.value == "people",
            self._target or Target(),
            self.which.value,
            count=round(self.count.value_si),
            keep_apart=not self.pairs.isChecked(),
        )
        self.say("Waiting for other work…")
        self.run.add(Job(TITLE, work))

    def _lay_out(self) -> None:
        form, fields = QtWidgets.QWidget(), {"of": self.of, "outputs": self.which}
        rows = form_of(form)
        for (name, field), spec in zip(fields.items(), (_OF, _WHICH), strict=True):
            add_row(rows, f"placement_{name}", spec.label, field, spec.hint)
        add_row(rows, "placement_count", _COUNT.label, self.count, _COUNT.hint)
        if len(self._people) > 1:
            add_row(rows, "placement_on", _ON.label, self.on, _ON.hint)
        if self._people[0] in PUBLISHED:
            hint = "Whether a fingertip may carry two actuators"
            rows.addRow("", named(self.pairs, "placement_pairs", hint=hint))
        self.hand.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.hand.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        policy = self.hand.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.hand.setSizePolicy(policy)
        left = in_column(form, (self.hand, 1), gap_px=UNIT_PX)
        below = in_row((self.message, 1), self._find, self._copy, self._use, self._close)
        meaning = page_label("placement_meaning", _MEANING, tone="dim")
        right = in_column(meaning, (self.table, 1), below, gap_px=UNIT_PX)
        in_row((left, 2), (right, 5), of=self, gap_px=2 * UNIT_PX)

    def _choose(self, *_: object) -> None:
        self._outputs["path"] = self._outputs["path"] or self.which.value
        self.which.set_value(self._outputs[self.of.value])
        self.ask()

    def _type(self, outputs: tuple[int, ...], *_: object) -> None:
        self._outputs["path"] = outputs
        self.of.set_value("path")
        self.ask()

    def _find_or_stop(self) -> None:
        if self.run.busy:
            self.run.cancel()
        else:
            self.ask()

    def _clear(self) -> None:
        self.answer = _UNANSWERED
        self.table.fill(())
        for part in (self._copy, self._use):
            part.setEnabled(False)
        self.hand.hide()

    def _show(self, _job: Job[Answer], answer: Answer) -> None:
        self.answer = answer
        self.table.fill([self._cells(*each) for each in answer.rows])
        for part in (self._copy, self._use):
            part.setEnabled(True)
        self.hand.show()

    def _words(self, inputs: tuple[int, ...]) -> tuple[str, str]:
        names = (input_name(number, self._people[0]).short_name for number in inputs)
        return ", ".join(map(str, inputs)), ", ".join(names)

    def _cells(self, of: Layout, there: tuple[Layout, ...]) -> list[tuple[str, str]]:
        """Return text and tooltip of each cell of a row."""
        words = [(text, text) for text in self._words(of.inputs)]
        numbers = [(f"{of.score_db:.1f}", ""), (f"{of.loss_db:.1f}", "")]
        numbers += [(f"{each.loss_db:.1f}", f"Score {each.score_db:.1f} dB") for each in there]
        return [*words, *((minus(text), minus(hint)) for text, hint in numbers)]

    def _show_layout(self, row: int, *_: int) -> None:
        if row < 0:
            return
        inputs = self.answer.placement.ranked[row].inputs
        colour = current_theme().input_colour(0)
        self.hand.show_inputs(tuple(Mark(site=each, colour=colour) for each in inputs), None)
        tried = _ALL_TRIED if self.answer.placement.exhaustive else _EXCHANGED
        behind = _BEHIND.format(self.answer.behind_db(row)) if len(self._people) > 1 else ""
        self.say(f"{tried} {behind}".strip())

    def copy(self) -> None:
        """Copy the layouts as a table, with the score on each limb as well."""
        names = [short_limb_title(name) for name in self._people]
        heads = ["Inputs", "Where", "Score, dB", "Loss, dB"]
        heads += [f"{what} on {name}, dB" for name in names for what in ("Score", "Loss")]
        lines: list[Sequence[str | float]] = [heads]
        for of, there in self.answer.rows:
            numbers = [db for each in (of, *there) for db in (each.score_db, each.loss_db)]
            lines.append([*self._words(of.inputs), *numbers])
        QtGui.QGuiApplication.clipboard().setText(tab_separated(lines))

    def _take(self) -> None:
        """Give the target the chosen inputs; where there is none, one of the asked outputs."""
        inputs = self.answer.placement.ranked[self.table.currentRow()].inputs
        target = replace(self._target or Target(strong=self.which.value), inputs=inputs, most=0)
        outcome = edits.change_target(self._document.design, self._document.view, target)
        if isinstance(outcome, Refusal):
            self.complain(outcome.sentence)
            return
        self._document.apply(outcome)
        self.accept()
