"""Undo and redo bring back the selection that belonged to the design, whatever was done."""

import random
from dataclasses import dataclass, replace

import pytest

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.edits.edit import Edit
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.state.document import Document

START = Design(
    limb="synthetic-1",
    inputs=tuple(
        Input(location=place, clips=(Clip(waveform=Tone()), Clip(onset_s=0.4, waveform=Tap())))
        for place in (7, 3, 15)
    ),
)


def selection(view):
    return view.selected_inputs, view.selected_clips, view.outputs


@dataclass(frozen=True)
class Seen:
    """A design as the history has it, with what was selected."""

    design: Design
    selected: tuple


class Model:
    """What a history has to be: for each step, what there was before it and after it."""

    def __init__(self, document):
        self.document = document
        self.steps, self.done = [], 0

    @property
    def now(self):
        return Seen(self.document.design, selection(self.document.view))

    def do(self, outcome, gesture):
        document, before, stack = self.document, self.now, self.document.undo_stack
        index = stack.index()
        document.apply(outcome, gesture)
        if stack.count() == stack.index():
            # What was taken back before cannot be done again.
            del self.steps[self.done :]
        if stack.index() > index:
            self.steps.append([before, self.now])
            self.done += 1
        elif stack.index() < index:
            # A gesture that came back to where it began.
            self.steps.pop()
            self.done -= 1
        elif self.done and self.now.design != before.design:
            self.steps[-1][1] = self.now

    def undo(self):
        if self.done:
            self.done -= 1
            self.document.undo_stack.undo()
            assert self.now == self.steps[self.done][0]

    def redo(self):
        if self.done < len(self.steps):
            self.done += 1
            self.document.undo_stack.redo()
            assert self.now == self.steps[self.done - 1][1]


def some(chance, ids, least=0):
    ids = list(ids)
    return tuple(chance.sample(ids, chance.randint(min(least, len(ids)), len(ids))))


def edit_of(chance, design, view):
    """An edit of the design by chance, of what is selected or of anything else."""
    clips = view.selected_clips or some(chance, [clip.id for clip in design.clips])
    tracks = view.selected_inputs or some(chance, design.ids)
    return chance.choice(
        (
            lambda: edits.move_clips(design, view, clips, chance.choice((0.1, 0.02)), 0),
            lambda: edits.move_clips(design, view, clips, 0.0, chance.choice((-1, 1))),
            lambda: edits.copy_clips(design, view, clips, 0.2, 1),
            lambda: edits.remove_clips(design, view, clips),
            lambda: edits.duplicate_clips(design, view, clips),
            lambda: edits.split_clips(design, view, clips, 0.05),
            lambda: edits.move_clips_to_place(design, view, clips, chance.randint(1, 20)),
            lambda: edits.place_input(design, view, chance.randint(1, 20)),
            lambda: edits.remove_inputs(design, view, tracks),
            lambda: edits.duplicate_inputs(design, view, tracks),
            lambda: edits.toggle_mute(design, view, tracks),
            lambda: edits.shift_inputs(design, view, tracks, down=chance.random() < 0.5),
            lambda: edits.group_clips(design, view, clips),
            lambda: edits.ungroup_clips(design, view, clips),
        )
    )()


def look_of(chance, design, view):
    """Another selection, or something else that is only looked at."""
    return chance.choice(
        (
            lambda: (
                edits.select_clips(
                    design, view, some(chance, [clip.id for clip in design.clips])
                ).view
            ),
            lambda: edits.select_inputs(design, view, some(chance, design.ids)).view,
            lambda: replace(view, playhead_s=chance.random()),
            lambda: replace(view, time_range_s=(0.0, 0.1 + chance.random())),
        )
    )()


@pytest.mark.parametrize("seed", range(12))
def test_the_selection_that_belonged_to_a_design_comes_back_with_it(qapp, seed):
    chance = random.Random(seed)  # noqa: S311
    document = Document(START, View(selected_inputs=(1,), selected_clips=(1,)))
    model, gesture = Model(document), 1
    for _ in range(60):
        what = chance.random()
        if what < 0.4:
            outcome = edit_of(chance, document.design, document.view)
            if isinstance(outcome, Edit) and len(outcome.design.clips) < 60:
                held = chance.random() < 0.4
                model.do(outcome, gesture if held else None)
        elif what < 0.6:
            document.look(look_of(chance, document.design, document.view))
            gesture += chance.random() < 0.5
        elif what < 0.82:
            model.undo()
            gesture += 1
        else:
            model.redo()
            gesture += 1
    while model.done:
        model.undo()
    while model.done < len(model.steps):
        model.redo()
