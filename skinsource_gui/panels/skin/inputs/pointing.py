"""Which input is pointed at on the map, and which one a click means."""

from PySide6.QtCore import QObject, QPointF, Signal

from skinsource.limbs.locations import input_words
from skinsource_gui.panels.skin.inputs.marks import InputMark, marks_at
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.stage.map_layout import MapLayout
from skinsource_gui.widgets.outputs.picking import output_at

#: Of inputs on each other, so many are named.
_NAMED = 3


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
    found = _inputs_at(content, layout, at)
    return found[0].id if found else None


def input_meant(
    content: MapContent, layout: MapLayout | None, at: QPointF, last: str
) -> int | None:
    """Id of the input that a click means; None: the output there, or nothing.

    What lies on each other takes turns, click by click: an output, then one input after the other.
    ``last`` is what the click before selected: "input" or "outputs".
    """
    if layout is None:
        return None
    inputs = [one.id for one in _inputs_at(content, layout, at)]
    output = output_at(layout.points, at)
    here = [*([] if output is None else [None]), *inputs]
    chosen = selected_inputs(content)
    if len(chosen) == 1 and chosen[0] in inputs and (output is None or last == "input"):
        turn = here.index(chosen[0]) + 1
    else:
        turn = int(output is not None and last == "outputs" and content.outputs == (output,))
    return here[turn % len(here)] if here else None


def inputs_words(content: MapContent, layout: MapLayout | None, at: QPointF) -> str:
    """The inputs at a place of the screen, a line for each, and how to come to those below."""
    found = _inputs_at(content, layout, at)
    numbers = {one.id: number for number, one in enumerate(content.inputs, 1)}
    lines = [
        f"Input {numbers[one.id]}: {one.location} · {input_words(one.location, content.limb).name}"
        for one in found[:_NAMED]
    ]
    lines += ["…"] * (len(found) > _NAMED)
    covered = layout is not None and output_at(layout.points, at) is not None
    if len(found) + covered > 1:
        lines.append("Click again for the next one here")
    return "\n".join(lines)


def _inputs_at(content: MapContent, layout: MapLayout | None, at: QPointF) -> tuple[InputMark, ...]:
    if content.limb_map is None or layout is None:
        return ()
    return marks_at(content.inputs, content.limb_map, layout, at)


def selected_inputs(content: MapContent) -> tuple[int, ...]:
    """Ids of the inputs that are selected."""
    return tuple(one.id for one in content.inputs if one.selected)
