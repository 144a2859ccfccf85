"""What every gesture is."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from PySide6.QtCore import QPointF, QRectF, Qt

from skinsource.design.design import Design
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.widgets.drop_place import DropPlace
from skinsource_gui.widgets.fields.gesture import new_gesture

Held = Qt.KeyboardModifier


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """What is painted over the lanes while a gesture lasts.

    Attributes
    ----------
    guide_s
        The time that something snapped to.
    covered
        What a rectangle covers, px.
    words
        What a small label beside the pointer says.
    """

    guide_s: float | None = None
    covered: QRectF | None = None
    words: str = ""


@dataclass(slots=True, kw_only=True)
class Stage:
    """What a gesture can see and do.

    Attributes
    ----------
    content
        Returns what is shown now.
    apply
        Takes an edit, or a refusal, and the number of the gesture.
    look
        Takes another view.
    put_playhead
        Takes where the playhead shall be, s.
    number
        Number of this gesture: all its edits are one step of the history.
    elsewhere
        Returns where in another panel something goes that is held over a place, px; None: it is
        let go.
    before
        What was shown when the button went down.
    made
        What the last edit led to; None before there is any.
    """

    content: Callable[[], Content]
    apply: Callable[[Edit | Refusal, int], None]
    look: Callable[[View], None]
    put_playhead: Callable[[float], None]
    elsewhere: Callable[[QPointF | None], DropPlace | None]
    before: Content
    number: int = field(default_factory=new_gesture)
    made: Design | None = None

    @property
    def disturbed(self) -> bool:
        """Whether something else has changed the design since the button went down."""
        now, expected = self.content().design, self.made or self.before.design
        return now is not expected and now != expected

    def edit(self, outcome: Edit | Refusal) -> None:
        """Show an edit of the design that there was before, unless that has become another."""
        if self.disturbed:
            return
        if isinstance(outcome, Edit):
            self.made = outcome.design
        self.apply(outcome, self.number)

    def take_back(self) -> None:
        """Put the design back as if the gesture had not begun."""
        if self.made is not None and not self.disturbed:
            before = self.before
            self.apply(Edit(label="", design=before.design, view=before.view), self.number)
            # It may go on from there.
            self.made = None


class Gesture(Protocol):
    """What happens between pressing a button and letting it go."""

    def move(self, at: QPointF, held: Held) -> Shown:
        """The pointer is ``at``, with these keys held."""

    def finish(self) -> None:
        """The button went up."""

    def cancel(self) -> None:
        """Everything is as if it had not begun."""
