"""What is told again as it is costs nothing: no layout, no tooltip, no painting."""

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication

from skinsource.design import edits

_Type = QEvent.Type
_COSTLY = {_Type.LayoutRequest, _Type.ToolTipChange, _Type.Paint}


class Events(QObject):
    """Counts costly events, of all widgets."""

    def __init__(self):
        super().__init__()
        self.events = []

    def eventFilter(self, watched, event):
        if event.type() in _COSTLY:
            self.events.append((watched.objectName() or type(watched).__name__, event.type().name))
        return False


def test_edits_lay_nothing_out_and_paint_no_more_than_looks_different(window, qtbot, qapp):
    document, changes = window.document, []
    clock = window.status_line.clock

    def edit(hz):
        document.apply(edits.change_field(document.design, document.view, (1,), "frequency_hz", hz))
        window.catch_up()
        QApplication.processEvents()

    for hz in (101.0, 102.0):
        edit(hz)
    qtbot.waitUntil(lambda: bool(clock.times.seconds()), timeout=10_000)
    for _ in range(3):
        QApplication.processEvents()
    spy = Events()
    qapp.installEventFilter(spy)
    clock.noted.connect(lambda: changes.append(1))
    for hz in (103.0, 104.0, 105.0):
        edit(hz)
    qapp.removeEventFilter(spy)
    assert changes
    assert [event for event in spy.events if event[1] == "LayoutRequest"] == []
    painted = {name for name, kind in spy.events if kind == "Paint"}
    assert "skin_map" in painted
    assert painted.isdisjoint({"hand_diagram", "range_low_field", "range_high_field"})
