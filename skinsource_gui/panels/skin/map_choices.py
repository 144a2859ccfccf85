"""What is chosen on the skin map and around it."""

from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits import Refusal
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource_gui.panels.skin.map_quantity import LEVELS, SENSATION, STILL
from skinsource_gui.panels.skin.settings import SkinSettings

#: Told where what is to be removed was selected last, and is none.
NO_OUTPUTS = Refusal(
    sentence="Outputs cannot be removed; click an input, a dashed ring on the map, to remove it."
)


class MapChoices(QObject):
    """Turns what map, toolbar and colour bar tell into another choice of outputs, or settings.

    Attributes
    ----------
    settings
        Those of the present view.
    """

    #: `Edit` or `Refusal`, None: no gesture.
    edited = Signal(object, object)
    #: The new `View`.
    view_changed = Signal(object)

    def __init__(self, panel_name: str, parent: QObject) -> None:
        super().__init__(parent)
        self._panel_name = panel_name
        self._design: Design | None = None
        self._view = View()
        self.settings = SkinSettings()

    def show_playhead(self, view: View) -> None:
        """Take over a view in which the playhead alone has moved."""
        self._view = view

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view
        self.settings = settings_of(view, self._panel_name, SkinSettings)

    def choose_outputs(self, outputs: tuple[int, ...]) -> None:
        """Select these outputs."""
        if self._design is not None:
            self.edited.emit(edits.select_outputs(self._design, self._view, outputs), None)

    def choose_inputs(self, ids: tuple[int, ...]) -> None:
        """Select inputs."""
        if self._design is not None:
            self.edited.emit(edits.select_inputs(self._design, self._view, ids), None)

    def remove_inputs(self, outputs_meant: bool) -> None:
        """Remove those that are selected; where none is, or outputs are meant, say so."""
        if self._design is not None:
            removed = edits.remove_inputs(self._design, self._view, self._view.selected_inputs)
            self.edited.emit(NO_OUTPUTS if outputs_meant else removed, None)

    @property
    def chosen_range(self) -> tuple[float, float] | None:
        """Ends of the colours that were chosen for what is shown; None: they follow it."""
        settings = self.settings
        if settings.quantity not in STILL:
            return settings.moving_range_db
        felt = settings.quantity == SENSATION
        return settings.sensation_range_db if felt else settings.map_range_db

    def choose_range(self, range_db: tuple[float, float] | None) -> None:
        """Let colours span these levels, or follow the loudest output."""
        if self.settings.quantity == LEVELS:
            self._change(map_range_db=range_db)
        elif self.settings.quantity == SENSATION:
            self._change(sensation_range_db=range_db)
        else:
            self._change(moving_range_db=range_db)

    def choose_limits(self, limits: tuple[float, float] | None) -> None:
        """Let colours span these accelerations along z, or follow the design."""
        self._change(z_limits=limits)

    def choose_quantity(self, name: str) -> None:
        """Show levels, or the skin in time."""
        self._change(quantity=name)

    def choose_window(self, window_s: float) -> None:
        """Take the sliding RMS over another time."""
        self._change(rms_window_s=window_s)

    def choose_colours(self, name: str) -> None:
        """Show levels in other colours."""
        self._change(colours=name)

    def choose_pace(self, slow_motion: float) -> None:
        """Play so many times slower than it happens."""
        if self._design is not None:
            self.edited.emit(edits.play_slower(self._design, self._view, slow_motion), None)

    def choose_style(self, style: str) -> None:
        """Colour the skin, or the sensors alone."""
        self._change(map_style=style)

    def switch_sensors(self, shown: bool) -> None:
        """Show or hide the sensors on the interpolated map."""
        self._change(sensors_shown=shown)

    def _change(self, **changes: Any) -> None:
        settings = replace(self.settings, **changes)
        self.view_changed.emit(with_settings(self._view, self._panel_name, settings))
