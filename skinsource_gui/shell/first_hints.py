"""Three hints on the first start, which come back only when they are asked for."""

from collections.abc import Callable

from PySide6.QtCore import QObject

from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.shell.notice import Notice
from skinsource_gui.state.document import Document
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
LATER = "First steps come once nobody presents"


class FirstHints(QObject):
    """Says three hints, one after the other, where the studio was never started before.

    The next one comes with its button, or once what the hint says was done.  While somebody
    presents they are put away: an audience is not to be told how to begin.

    Parameters
    ----------
    preferences
        Know whether it was; they remember that the hints were shown as soon as the first one is.
    notice
        Says them; also the parent.
    document
        Tells what was done.
    """

    def __init__(self, preferences: Preferences, notice: Notice, document: Document) -> None:
        super().__init__(notice)
        self._preferences, self._notice, self._document = preferences, notice, document
        self._step: int | None = None
        self._away = False
        self._design, self._view = document.design, document.view

    def offer(self) -> None:
        """Begin, unless it was done before or there is something more urgent to say."""
        if self._preferences.hinted or self._notice.text:
            return
        self.show()

    def show(self) -> None:
        """Begin with the first one, whatever was shown before."""
        self._preferences.hinted = True
        self._preferences.flush()
        self._end()
        self._notice.closed.connect(self._end)
        self._document.settled.connect(self._follow)
        self._say(0)
        if self._away:
            self._notice.say(LATER, passes=True)

    def put_away(self, away: bool) -> None:
        """Put them away, whichever is said, or say it again."""
        self._away = away
        if self._step is None:
            return
        if not away:
            self._say(self._step)
        elif self._says_a_hint:
            self._notice.be_quiet()

    @property
    def _says_a_hint(self) -> bool:
        return self._notice.text.endswith(HINTS)

    def _say(self, step: int) -> None:
        self._step = step
        self._design, self._view = self._document.design, self._document.view
        if self._away:
            return
        words = f"{step + 1} of {len(HINTS)}: {HINTS[step]}"
        last = step == len(HINTS) - 1
        choices: tuple[tuple[str, Callable[[], None]], ...]
        if last:
            choices = ((DONE, self._end),)
        else:
            choices = ((NEXT, lambda: self._say(step + 1)), (ENOUGH, self._end))
        self._notice.say(words, choices=choices)

    def _follow(self) -> None:
        """Say what is next where a hint was followed; say it again where an edit took it away."""
        if self._step is None or self._away:
            return
        design, view = self._document.design, self._document.view
        if not _followed(self._step, self._design, self._view, design, view):
            if not self._notice.text:
                self._say(self._step)
        elif self._step + 1 < len(HINTS):
            self._say(self._step + 1)
        else:
            self._end()
            if self._says_a_hint:
                self._notice.be_quiet()

    def _end(self) -> None:
        """Nothing is left to say: the notice has gone already, or goes by itself."""
        if self._step is not None:
            self._step = None
            self._notice.closed.disconnect(self._end)
            self._document.settled.disconnect(self._follow)


def _followed(step: int, was: Design, looked: View, design: Design, view: View) -> bool:
    """Whether what hint ``step`` says was done since it was said."""
    if step == 0:
        return len(design.inputs) > len(was.inputs)
    if step == 1:
        return design.inputs != was.inputs
    return bool(view.outputs) and view.outputs != looked.outputs
