"""Where a step of the history begins or ends."""

from dataclasses import replace

from skinsource.design.comparing import brought_back
from skinsource.design.design import Design
from skinsource.design.view import View


class StepEnd:
    """A design and a view, of which the history keeps selections and snapshots."""

    def __init__(self, design: Design, view: View):
        self.design, self.view = design, view

    def is_same(self, other: "StepEnd") -> bool:
        """Whether the history need not tell them apart: going on to ``other`` loses nothing."""
        mine, theirs = self.view, other.view
        same = mine.outputs == theirs.outputs and self.design == other.design
        if not same:
            return False
        # How loud one was shown last is nothing that could be lost.
        kept = {one.number: one.design for one in theirs.snapshots}
        return all(kept.get(one.number) == one.design for one in mine.snapshots)

    def is_before(self, other: "StepEnd") -> bool:
        """Whether ``other`` goes on from this one, with the same inputs and clips selected."""
        return (
            self.design is other.design
            and self.view.selected_inputs == other.view.selected_inputs
            and self.view.selected_clips == other.view.selected_clips
        )

    def seen_as(self, view: View, other: "StepEnd") -> View:
        """Return ``view`` with the inputs, clips and outputs that were selected then.

        It has the snapshots as they were then where they differ from those of the ``other`` end of
        the step, and all others as they are now.
        """
        return replace(
            view,
            outputs=self.view.outputs,
            selected_inputs=self.view.selected_inputs,
            selected_clips=self.view.selected_clips,
            snapshots=brought_back(self.view.snapshots, other.view.snapshots, view.snapshots),
        )
