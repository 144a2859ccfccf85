"""Which input is pointed at on the map."""

from PySide6.QtCore import QObject, QPointF, Signal

from skinsource_gui.panels.skin.inputs.marks import mark_at
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.stage.map_layout import MapLayout


class InputPointer(QObject):
    """Tells which input is pointed at, once for each."""

    #: Its id, or None.
    pointed_at = Signal(object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._now: int | None = None

    def follow(self, input_id: int | None) -> None:
        """Take over what is under the pointer."""
        if input_id != self._now:
            self._now = input_id
            self.pointed_at.emit(input_id)


def input_at(content: MapContent, layout: MapLayout | None, at: QPointF) -> int | None:
    """Id of the input whose mark is at a place of the screen."""
    if content.limb_map is None or layout is None:
        return None
    found = mark_at(content.inputs, content.limb_map, layout, at)
    return None if found is None else found.id


def selected_inputs(content: MapContent) -> tuple[int, ...]:
    """Ids of the inputs that are selected."""
    return tuple(one.id for one in content.inputs if one.selected)
