"""The library panel without a studio, and what it lists."""

import pytest

from skinsource.design.design import Design, track
from skinsource.design.presets import presets
from skinsource.design.view import View
from skinsource_gui.panels.library.panel import LibraryPanel


class Bench:
    """The panel, with a design of one track; ``labels`` are those of its edits."""

    def __init__(self, qtbot):
        self.panel, self.outcomes = LibraryPanel(), []
        qtbot.addWidget(self.panel)
        self.panel.edited.connect(lambda outcome, gesture: self.outcomes.append(outcome))
        self.show(View(selected_inputs=(1,)))
        self.panel.resize(300, 560)
        with qtbot.waitActive(self.panel):
            self.panel.show()
            self.panel.activateWindow()

    def show(self, view):
        self.panel.show_state(Design(limb="synthetic-1", inputs=(track(7),)), view)

    @property
    def labels(self):
        return [outcome.label for outcome in self.outcomes]

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
