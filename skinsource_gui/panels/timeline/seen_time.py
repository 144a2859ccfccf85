"""Which part of the time the lanes show."""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QWheelEvent

from skinsource.design.view import View
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.widgets.time.time_scale import Range, within, zoomed
from skinsource_gui.widgets.time.time_wheel import range_by_wheel


class SeenTime(QObject):
    """Zooms and pans, by asking for another view.

    Parameters
    ----------
    content
        Gives what the lanes show at present.
    """

    #: The view to look at.
    looked = Signal(object)

    def __init__(self, content: Callable[[], Content], parent: QObject) -> None:
        super().__init__(parent)
        self._content = content
        self._held_s: Range | None = None

    def range_s(self, view: View, whole_s: Range) -> Range:
        """What to show of the whole."""
        return view.time_range_s or self._held_s or whole_s

    def hold(self) -> None:
        """Something is dragged: what is seen stays, though the design may become longer."""
        self._held_s = self._content().scale.shown_s

    def let_go(self) -> None:
        """The drag has ended."""
        self._held_s = None

    def zoom(self, factor: float, anchor_s: float | None = None) -> None:
        """See a part so many times narrower: around a time, the playhead, or the middle."""
        content = self._content()
        shown, playhead_s = content.scale.shown_s, content.view.playhead_s
        if anchor_s is None:
            inside = shown[0] <= playhead_s <= shown[1]
            anchor_s = playhead_s if inside else sum(shown) / 2
        self._look_at(zoomed(shown, anchor_s, factor, content.whole_s))

    def turn(self, event: QWheelEvent) -> None:
        """Follow the wheel."""
        content = self._content()
        self._look_at(range_by_wheel(event, content.scale, content.whole_s))

    def show_range(self, wanted_s: Range) -> None:
        """See this part."""
        self._look_at(within(wanted_s, self._content().whole_s))

    def show_everything(self) -> None:
        """See all of it."""
        self._look_at(None)

    def _look_at(self, shown_s: Range | None) -> None:
        self._held_s = None
        view = self._content().view
        if shown_s != view.time_range_s:
            self.looked.emit(replace(view, time_range_s=shown_s))
