"""The controls around the map: they show the settings, and what they tell is chosen."""

from PySide6.QtCore import QPoint, Qt

from skinsource.design.view import View
from skinsource_gui.panels.skin.map_choices import MapChoices
from skinsource_gui.panels.skin.map_menu import open_colours_menu
from skinsource_gui.panels.skin.map_quantity import Z
from skinsource_gui.panels.skin.map_toolbar import MapToolbar
from skinsource_gui.panels.skin.scale.colour_bar import ColourBar
from skinsource_gui.panels.skin.time.time_view import TimeView


class MapControls:
    """Connects the controls around the map to what is chosen, and shows them what was."""

    def __init__(
        self, choices: MapChoices, toolbar: MapToolbar, time: TimeView, colour_bar: ColourBar
    ) -> None:
        self._choices = choices
        self._toolbar, self._time, self._colour_bar = toolbar, time, colour_bar
        toolbar.style_chosen.connect(choices.choose_style)
        toolbar.sensors_switched.connect(choices.switch_sensors)
        colour_bar.range_chosen.connect(choices.choose_range)
        colour_bar.strip.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        colour_bar.strip.customContextMenuRequested.connect(self._open_colours)
        time.bar.limits_chosen.connect(choices.choose_limits)
        time.row.quantity_chosen.connect(choices.choose_quantity)
        time.row.window_chosen.connect(choices.choose_window)
        time.row.pace_chosen.connect(choices.choose_pace)

    def show_settings(self, view: View) -> None:
        """Show what is chosen; of the two colour bars the one for it."""
        settings = self._choices.settings
        signed = settings.quantity == Z
        self._toolbar.show_settings(settings)
        self._time.show_state(settings, view)
        self._time.bar.setVisible(signed)
        self._colour_bar.setVisible(not signed)
        self._colour_bar.choose(self._choices.chosen_range)

    def _open_colours(self, at: QPoint) -> None:
        strip, choices = self._colour_bar.strip, self._choices
        over = strip.mapToGlobal(at)
        open_colours_menu(strip, over, choices.settings.colours, choices.choose_colours)
