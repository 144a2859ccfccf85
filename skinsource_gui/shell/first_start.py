"""Three hints on the first start, which never come back."""

from PySide6.QtCore import QObject

from skinsource_gui.shell.notice import Notice
from skinsource_gui.state.preferences import Preferences

HINTS = (
    "Click a place on the hand: an input is added there, and the skin map shows what reaches the "
    "skin.",
    "Turn its numbers in the inspector: drag on a field, scroll over it, or type. The map follows "
    "while you drag.",
    "Click outputs on the skin map: traces and spectra show them. File > Scenes opens figures of "
    "the paper to begin with.",
)
NEXT, DONE, ENOUGH = "Next", "Done", "No more hints"


class FirstStart(QObject):
    """Says three hints, one after the other, where the studio was never started before.

    Parameters
    ----------
    preferences
        Know whether it was; they remember that the hints were shown as soon as the first one is.
    notice
        Says them; also the parent.
    """

    def __init__(self, preferences: Preferences, notice: Notice) -> None:
        super().__init__(notice)
        self._preferences, self._notice = preferences, notice

    def offer(self) -> None:
        """Begin, unless it was done before or there is something more urgent to say."""
        if self._preferences.hinted or self._notice.text:
            return
        self._preferences.hinted = True
        self._preferences.flush()
        self._say(0)

    def _say(self, step: int) -> None:
        words = f"{step + 1} of {len(HINTS)}: {HINTS[step]}"
        last = step == len(HINTS) - 1
        if last:
            choices = ((DONE, self._end),)
        else:
            choices = ((NEXT, lambda: self._say(step + 1)), (ENOUGH, self._end))
        self._notice.say(words, choices=choices)

    def _end(self) -> None:
        """Nothing is left to say: the notice has gone already."""
