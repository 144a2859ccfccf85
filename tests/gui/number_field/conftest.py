import pytest

from tests.gui.number_field.bench import Bench


@pytest.fixture
def make_bench(qtbot):
    def make(spec, value):
        widget = Bench(spec, value)
        qtbot.addWidget(widget)
        widget.show()
        qtbot.waitExposed(widget)
        widget.activateWindow()
        widget.other.setFocus()
        qtbot.waitUntil(widget.other.hasFocus)
        return widget

    return make
