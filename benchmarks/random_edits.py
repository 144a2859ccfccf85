"""Edits of every kind, at random but always the same ones, as a user could make them."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from skinsource.base.conventions import AXES, N_INPUTS, N_OUTPUTS
from skinsource.design.design import Design, Input, track
from skinsource.design.panel_settings import with_settings
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.catalog import available_limbs
from skinsource.limbs.scaling import SCALINGS
from skinsource.signals.projection import METHODS
from skinsource_gui.panels.spectra.panel import SpectraSettings
from skinsource_gui.state.document import Document

_MOST_INPUTS = 8
_DURATIONS_S = (0.05, 0.1, 0.2, 0.5, 1.0)


class RandomEdits:
    """Edits one document.

    Parameters
    ----------
    document
        What is edited.
    seed
        Start of the random numbers.
    """

    def __init__(self, document: Document, seed: int = 1) -> None:
        self._document = document
        self._random = np.random.default_rng(seed)
        kinds: dict[Callable[[], None], float] = {
            self._change_amplitude: 18,
            self._change_onset: 10,
            self._change_frequency: 14,
            self._change_waveform: 8,
            self._move_input: 4,
            self._add_input: 5,
            self._remove_input: 5,
            self._mute: 4,
            self._solo: 2,
            self._select_input: 6,
            self._select_outputs: 6,
            self._look_otherwise: 5,
            self._zoom: 3,
            self._change_scaling: 0.5,
            self._change_limb: 0.05,
            self._undo: 6,
            self._redo: 3,
        }
        weights = np.array(list(kinds.values()))
        self._kinds = list(kinds)
        self._shares = weights / weights.sum()

    def make_one(self) -> str:
        """Make the next edit; its name."""
        edit = self._kinds[self._random.choice(len(self._kinds), p=self._shares)]
        edit()
        return edit.__name__.strip("_").replace("_", " ")

    def _change_amplitude(self) -> None:
        self._change("Change amplitude", amplitude=float(self._random.uniform(-2, 2)))

    def _change_onset(self) -> None:
        self._change_clip("Change onset", onset_s=float(self._random.uniform(0, 0.3)))

    def _change_frequency(self) -> None:
        track = self._selected_track()
        waveform = None if track is None else track.clips[0].waveform
        if isinstance(waveform, Tone):
            frequency_hz = float(self._random.uniform(25, 600))
            self._change_clip("Change", waveform=replace(waveform, frequency_hz=frequency_hz))

    def _change_waveform(self) -> None:
        duration_s = float(self._random.choice(_DURATIONS_S))
        made = (
            Tone(duration_s=duration_s),
            Noise(seed=int(self._random.integers(1000)), duration_s=duration_s),
            Tap(),
            Impulse(),
        )
        self._change_clip("Change waveform", waveform=made[self._random.integers(len(made))])

    def _move_input(self) -> None:
        self._change("Move", location=self._place())

    def _add_input(self) -> None:
        design = self._document.design
        if len(design.inputs) < _MOST_INPUTS:
            self._edit("Add", design.adding(track(location=self._place())))

    def _remove_input(self) -> None:
        selected = self._document.view.selected_input
        design = self._document.design
        if selected is not None and len(design.inputs) > 1:
            self._edit("Remove", design.without_input(design.index_of(selected)))

    def _mute(self) -> None:
        track = self._selected_track()
        self._change("Mute", muted=track is not None and not track.muted)

    def _solo(self) -> None:
        track = self._selected_track()
        self._change("Solo", solo=track is not None and not track.solo)

    def _select_input(self) -> None:
        ids = self._document.design.ids
        self._look(selected_inputs=(int(self._random.choice(ids)),) if ids else ())

    def _select_outputs(self) -> None:
        count = self._random.integers(1, 7)
        chosen = self._random.choice(N_OUTPUTS, count, replace=False) + 1
        self._look(outputs=tuple(int(number) for number in chosen))

    def _look_otherwise(self) -> None:
        axes = AXES[self._random.integers(len(AXES))]
        method = METHODS[self._random.integers(len(METHODS))]
        view = replace(self._document.view, axes=axes, method=method)
        settings = SpectraSettings(log_frequency=bool(self._random.integers(2)))
        self._document.look(with_settings(view, "spectra", settings))

    def _zoom(self) -> None:
        start_s = float(self._random.uniform(0, 0.2))
        self._look(time_range_s=(start_s, start_s + 0.1) if self._random.integers(2) else None)

    def _change_scaling(self) -> None:
        scaling = SCALINGS[self._random.integers(len(SCALINGS))]
        self._edit("Scaling", replace(self._document.design, scaling=scaling))

    def _change_limb(self) -> None:
        limbs = available_limbs()
        limb = limbs[self._random.integers(len(limbs))]
        self._edit("Limb", replace(self._document.design, limb=limb))

    def _undo(self) -> None:
        self._document.undo_stack.undo()

    def _redo(self) -> None:
        self._document.undo_stack.redo()

    def _place(self) -> int:
        return int(self._random.integers(N_INPUTS)) + 1

    def _selected_track(self) -> Input | None:
        selected = self._document.view.selected_input
        return None if selected is None else self._document.design.input(selected)

    def _change(self, label: str, **changes: object) -> None:
        selected = self._document.view.selected_input
        if selected is not None:
            design = self._document.design
            self._edit(label, design.with_input(design.index_of(selected), **changes))

    def _change_clip(self, label: str, **changes: object) -> None:
        track = self._selected_track()
        if track is not None:
            self._edit(label, self._document.design.with_clip(track.clips[0].id, **changes))

    def _edit(self, label: str, design: Design) -> None:
        self._document.edit(label, design)

    def _look(self, **changes: object) -> None:
        self._document.look(replace(self._document.view, **changes))
