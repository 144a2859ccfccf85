"""Has designs judged while somebody waits for it: what is taken out of the studio carries it."""

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QEventLoop

from skinsource.perception.validity import Judged
from skinsource_gui.state.engine import FIRST_SLOT, Engine, Outcome, Purpose, Request, Slot

_WANTED = frozenset({"limb_data", "validity"})
_OTHERS = Slot("judged beside")


class Judging:
    """Judges the design in the window, and others beside it.

    Parameters
    ----------
    engine
        Who evaluates.  What it knows of the design in the window is not computed again.
    """

    def __init__(self, engine: Engine) -> None:
        self._engine = engine

    def judge(self, label: str, given: Mapping[str, Any], *, present: bool) -> Judged:
        """Wait until what follows from ``given`` is judged; a reason why it cannot be ends it too.

        Parameters
        ----------
        label
            What it is called.
        given
            What evaluation starts from.
        present
            Whether that is what the window shows.
        """
        slot = FIRST_SLOT if present else _OTHERS
        request = Request(_WANTED, given, purpose=Purpose.EXPORT, slot=slot)
        found = self._outcome(request)
        if not present:
            self._engine.release(slot)
        values = None if found is None else found.values
        if values is None:
            return Judged(label=label)
        return Judged(label=label, note=values["limb_data"].note, findings=values["validity"])

    def _outcome(self, request: Request) -> Outcome | None:
        """What became of a request; None where the engine ends before."""
        loop, found = QEventLoop(), list[Outcome]()

        def note(outcome: Outcome) -> None:
            if outcome.request is request:
                found.append(outcome)
                loop.quit()

        self._engine.finished.connect(note)
        self._engine.rested.connect(loop.quit)
        self._engine.request(request)
        while not found and self._engine.busy:
            loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
        self._engine.finished.disconnect(note)
        self._engine.rested.disconnect(loop.quit)
        return found[0] if found else None
