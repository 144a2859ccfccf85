"""What the mouse means on the map."""

from PySide6.QtCore import QObject, QPointF, QRectF, Signal

from skinsource.base.arrays import Floats
from skinsource_gui.widgets.outputs.picking import (
    Outputs,
    joined,
    output_at,
    outputs_inside,
    toggled,
)

# A press that moves less than this is a click.
_CLICK_PX = 4.0


class OutputMouse(QObject):
    """Turns moves, clicks and rubber bands into outputs.

    Attributes
    ----------
    hovered
        The output under the pointer.
    pointer
        Where the pointer is; ``None`` while it is elsewhere.
    band
        The rubber band, while one is drawn.
    """

    #: The outputs that are meant, whether they are added to the selection.
    meant = Signal(object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.hovered: int | None = None
        self.pointer: QPointF | None = None
        self.band: QRectF | None = None
        self._pressed: QPointF | None = None

    def press(self, at: QPointF) -> None:
        """The left button goes down."""
        self._pressed = at

    def move(self, at: QPointF, points: Floats) -> None:
        """The mouse moves, whether or not the button is held; ``points`` is (n_outputs, 2)."""
        self.pointer = at
        self.hovered = output_at(points, at)
        if self._pressed is not None:
            band = QRectF(self._pressed, at).normalized()
            if self.band is not None or max(band.width(), band.height()) >= _CLICK_PX:
                self.band = band

    def release(self, at: QPointF, points: Floats, outputs: Outputs, *, adds: bool) -> None:
        """The left button goes up; ``adds`` to the present ``outputs``."""
        if self._pressed is None:
            return
        band, self.band, self._pressed = self.band, None, None
        if band is not None:
            found = outputs_inside(points, band)
            self.meant.emit(joined(outputs, found) if adds else found)
            return
        number = output_at(points, at)
        if number is not None:
            self.meant.emit(toggled(outputs, number) if adds else (number,))

    def leave(self) -> None:
        """The pointer is elsewhere, or the keyboard took over."""
        self.pointer = self.hovered = None

    def give_up(self) -> bool:
        """End a press without selecting; return whether there was one."""
        pressed, self._pressed, self.band = self._pressed, None, None
        return pressed is not None
