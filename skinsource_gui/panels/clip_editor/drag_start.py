"""What there was before a drag, so that it can be given up."""

from skinsource.design.design import Design
from skinsource.design.edits import Edit
from skinsource.design.view import View


class DragStart:
    """Remembers the design and the view that the first edit of a drag was made of."""

    def __init__(self) -> None:
        self._gesture: int | None = None
        self._before: Edit | None = None

    def note(self, gesture: int | None, design: Design, view: View) -> None:
        """An edit of these is made; ``gesture`` is the number of its drag, None without one."""
        if gesture is not None and gesture != self._gesture:
            self._gesture, self._before = gesture, Edit(label="", design=design, view=view)

    def way_back(self, gesture: int) -> Edit | None:
        """The edit that gives up a drag; None where it has changed nothing."""
        return self._before if gesture == self._gesture else None
