"""The map in time: its frames, and the controls that only it has."""

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QWidget

from skinsource.base.decibels import decibels
from skinsource.design.view import View
from skinsource.engine.time_rules import block_of
from skinsource_gui.panels.skin.map_quantity import STILL
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.skin.time.frames import NEEDS, Frames
from skinsource_gui.panels.skin.time.quantity_row import QuantityRow
from skinsource_gui.panels.skin.time.scrub_bar import ScrubBar
from skinsource_gui.panels.skin.time.signed_bar import SignedBar
from skinsource_gui.widgets.map.colour_maps import DIVERGING


class TimeView(QObject):
    """Turns what is kept of the skin in time into what the map shows at the playhead.

    Attributes
    ----------
    frames
        Who makes frames.
    row, scrub, bar
        What is shown, and how slowly; play and scrub; the colour bar of signed values.
    """

    #: Signals of another part of the response are wanted.
    part_wanted = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._parent = parent
        self.frames = Frames()
        self.row, self.scrub, self.bar = QuantityRow(parent), ScrubBar(parent), SignedBar(parent)
        self._asked_block = -1
        # Else Space, which plays, would open the list again.
        self.row.quantity.chosen.connect(self._leave_lists)
        self.row.pace.chosen.connect(self._leave_lists)

    def put_behind(self, widget: QWidget) -> None:
        """Let the keyboard come to what stands below the map after ``widget``."""
        order = (
            widget,
            self.bar.limit,
            self.bar.auto_button,
            self.scrub.play,
            self.scrub.slider,
        )
        for before, after in pairwise(order):
            QWidget.setTabOrder(before, after)

    def needs(self, settings: SkinSettings) -> frozenset[str]:
        """Quantities from which frames are made; none while levels are shown."""
        name = NEEDS.get(settings.quantity)
        return frozenset() if name is None else frozenset({name})

    def take(self, results: Mapping[str, Any], settings: SkinSettings, view: View) -> None:
        """Take over signals, where ``results`` have any."""
        if settings.quantity not in STILL and NEEDS[settings.quantity] in results:
            self.frames.take(results, settings.quantity, view)
            self._asked_block = -1
        else:
            self.frames.forget()

    def show_state(self, settings: SkinSettings, view: View) -> None:
        """Show what is chosen."""
        moves = settings.quantity not in STILL
        self.row.show_settings(settings, view.slow_motion)
        self.scrub.setVisible(moves)
        if moves:
            limits = self.frames.value_range(settings)
            self.bar.show_limits(limits, automatic=settings.z_limits is None)
            self.scrub.show_time(view.playhead_s, self.frames.end_s(view))

    def levels_of_largest(self) -> np.ndarray:
        """The largest level there can be, dB, (1,): what the automatic range follows."""
        return decibels(np.array([self.frames.largest]))

    def changes(self, settings: SkinSettings, view: View, surface: Any) -> dict[str, Any] | None:
        """What the map shows at the playhead; None: that is not known yet, and was asked for."""
        self.scrub.show_time(view.playhead_s, self.frames.end_s(view))
        block = block_of(view.playhead_s)
        if self.frames.runs_out(view) and block != self._asked_block:
            self._asked_block = block
            self.part_wanted.emit()
        if not self.frames.has(view):
            return None
        frame = self.frames.frame(view, settings)
        signed = frame.quantity.signed
        chosen = settings.z_limits if signed else settings.moving_range_db
        return {
            "values": frame.values,
            "field_values": None if surface is None else surface.interpolate(frame.values),
            "quantity": frame.quantity,
            "value_range": self.frames.value_range(settings),
            "fixed": chosen is not None,
            "colours": DIVERGING if signed else settings.colours,
        }

    def _leave_lists(self) -> None:
        self._parent.setFocus(Qt.FocusReason.OtherFocusReason)
