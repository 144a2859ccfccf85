"""From the selected input's place to the selected outputs, whatever plays."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np
from PySide6.QtWidgets import QWidget

from skinsource.design.design import Design
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.limbs.locations import input_words
from skinsource.signals.analysis.transfer import LEAST_COHERENCE, Transfer
from skinsource_gui.figure_panel import FigurePanel
from skinsource_gui.panels.transfer.picture import Shown, TransferPicture
from skinsource_gui.panels.transfer.settings import TransferSettings
from skinsource_gui.panels.transfer.unit import OF_UNIT, transfer_unit
from skinsource_gui.widgets.copied_numbers import copied
from skinsource_gui.widgets.empty_words import add_words
from skinsource_gui.widgets.tool_button import tool_button

# More outputs than these are said as ranges.
_MOST_NUMBERS = 12


class TransferPanel(FigurePanel):
    """Magnitude or coherence of each output over frequency, with what can be used of it."""

    title: ClassVar[str] = "Transfer"
    name: ClassVar[str] = "transfer"

    def __init__(self, parent: QWidget | None = None) -> None:
        self.picture = TransferPicture()
        super().__init__(self.picture, parent)
        self._view, self._settings = View(), TransferSettings()
        self._results: Mapping[str, Any] | None = None
        self._has_inputs = True
        hint = "Draw the share of the power that is not noise, in place of the magnitude"
        self.coherence = tool_button(None, "transfer_coherence", "Coherence", hint, checkable=True)
        self.coherence.clicked.connect(self._show_coherence)
        self.place = self.add_above("transfer_place")
        self.choices.addWidget(self.coherence)
        self.choices.addStretch(1)
        self.heads.addWidget(self.place)
        self.copy = self.add_copy(self.table)
        self.figure.say(self.no_outputs)

    @property
    def needs(self) -> frozenset[str]:
        return frozenset({"transfer", "transfer_place", "shown_outputs", *OF_UNIT, "limb_data"})

    def begin_anew(self) -> None:
        self.picture.begin_anew()

    def show_state(self, design: Design, view: View) -> None:
        settings = settings_of(view, self.name, TransferSettings)
        redrawn = settings != self._settings
        self._view, self._settings = view, settings
        self.coherence.setChecked(settings.coherence)
        self._has_inputs = bool(design.inputs)
        if not view.outputs or not design.inputs:
            self._say_empty()
        elif self._results is None:
            self.await_results()
        elif redrawn:
            self._draw(self._results)

    def show_results(self, results: Mapping[str, Any]) -> None:
        if results["transfer"] is None:
            self._say_empty()
            return
        self._results = dict(results)
        self._draw(results)

    def table(self) -> str:
        """The numbers, with tabs between the columns."""
        if self._results is None:
            return ""
        found: Transfer = self._results["transfer"]
        outputs = self._results["shown_outputs"]
        header = ["frequency_hz"]
        for name in ("magnitude", "noise_rms", "coherence"):
            header += [f"{name}_{output}" for output in outputs]
        columns = (found.frequency_hz[None], found.magnitude, found.noise, found.coherence)
        lines = ["\t".join(header)]
        lines += ["\t".join(map(copied, row)) for row in np.vstack(columns).T.tolist()]
        return "\n".join(lines) + "\n"

    def _say_empty(self) -> None:
        self.say_instead(self.no_outputs if self._has_inputs else add_words(self.in_sight))

    def say_instead(self, message: str) -> None:
        self._results = None
        super().say_instead(message)
        self.place.say("")

    def _draw(self, results: Mapping[str, Any]) -> None:
        found, outputs = results["transfer"], results["shown_outputs"]
        self.copy.offer(True)
        unit = transfer_unit(results)
        self.picture.show_transfer(
            Shown(found=found, outputs=outputs, unit=unit, coherence=self._settings.coherence)
        )
        place, limb = results["transfer_place"], results["limb_data"]
        if limb.synthetic:
            note = " · synthetic limb, without noise"
        elif not found.noise.any():
            note = " · noise not known"
        else:
            # Of a coherence nothing dotted is drawn.
            note = "" if self._settings.coherence else " · dotted: noise"
        self.place.say(f"From place {place}, {input_words(place, limb.name).name}{note}")
        self.show_found(_usable_words(found, outputs))

    def _show_coherence(self, wanted: bool) -> None:
        settings = replace(self._settings, coherence=wanted)
        self.view_changed.emit(with_settings(self._view, self.name, settings))


def _usable_words(found: Transfer, outputs: tuple[int, ...]) -> str:
    """Where the response is more than noise; outputs with the same band together."""
    alike: dict[str, list[int]] = {}
    for output, (low, high) in zip(outputs, found.usable_hz, strict=True):
        band = f"{low:.0f}–{high:.0f} Hz" if np.isfinite(low) else "nowhere"
        alike.setdefault(band, []).append(output)
    said = [f"{_numbers(those)}: {band}" for band, those in alike.items()]
    low, high = found.band_hz or (0.0, float(found.frequency_hz[-1]))
    return f"Coherence ≥ {LEAST_COHERENCE:g} from {low:g} to {high:g} Hz: {' · '.join(said)}"


def _numbers(outputs: list[int]) -> str:
    """Outputs by number, many of them as ranges."""
    if len(outputs) <= _MOST_NUMBERS:
        return ", ".join(map(str, outputs))
    ordered = np.unique(outputs)
    runs = np.split(ordered, np.flatnonzero(np.diff(ordered) > 1) + 1)
    said = (f"{run[0]}–{run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs)
    return f"{len(ordered)} outputs ({', '.join(said)})"
