"""The library panel without a studio, and what it lists."""

import pytest

from skinsource.design.design import Design, track
from skinsource.design.presets import presets
from skinsource.design.view import View
from skinsource_gui.panels.library.panel import LibraryPanel
from tests.gui.panel_host import PanelHost


class Bench(PanelHost):
    """The library, on a design of one track."""

    def __init__(self, qtbot):
        design = Design(limb="synthetic-1", inputs=(track(7),))
        super().__init__(LibraryPanel(), design, View(selected_inputs=(1,)))
        self.appear(qtbot, 300, 560)
        self.activate(qtbot)

    @property
    def names(self):
        model = self.panel.model
        return [model.index(k, 0).data() for k in range(model.rowCount())]

    def go_to(self, name):
        self.panel.rows.go_to(self.names.index(name))
        self.panel.rows.setFocus()

    def save(self, preset):
        """Save one of the user's own, as another program would."""
        path = presets.save_preset(presets.users_folder(), preset)
        self.panel.folders.read()
        return path


@pytest.fixture
def bench(qtbot, user_data):
    return Bench(qtbot)
