"""A gesture whose way says what it is."""

from collections.abc import Callable

from PySide6.QtCore import QPointF

from skinsource_gui.panels.timeline.gestures.gesture import Gesture, Held, Shown


class Either:
    """Goes up or down: one gesture; goes along: another one.

    A gain curve lies over the clips of its track: pulled up or down it is the curve that is meant,
    pushed along it is the clip.

    Parameters
    ----------
    at
        Where the button went down.
    upright, along
        Make the gestures, once it is known which is meant.
    """

    def __init__(
        self, at: QPointF, upright: Callable[[], Gesture], along: Callable[[], Gesture]
    ) -> None:
        self._at, self._upright, self._along = at, upright, along
        self._meant: Gesture | None = None

    def move(self, at: QPointF, held: Held) -> Shown:
        if self._meant is None:
            way = at - self._at
            self._meant = self._along() if abs(way.x()) > abs(way.y()) else self._upright()
        return self._meant.move(at, held)

    def finish(self) -> None:
        """What has become of it stays."""
        if self._meant is not None:
            self._meant.finish()

    def cancel(self) -> None:
        """Everything is as if it had not begun."""
        if self._meant is not None:
            self._meant.cancel()
