"""Wavelets of a train made alike on the skin: predicted away from the GUI thread, then edited."""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.job import Job
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits.edit import clip_of
from skinsource.design.view import View
from skinsource.design.waveforms import WaveletTrain
from skinsource.engine.levelling import MEASURE, wavelet_levels_db
from skinsource_gui.state.document import Document
from skinsource_gui.state.job_runner import JobRunner

_CHANGED = "The wavelet train was changed while it was predicted; equalise it once more."


@dataclass(frozen=True, slots=True)
class _Asked:
    """What is predicted, as it was when the user asked for it."""

    design: Design
    clip_id: int

    def is_as_in(self, design: Design) -> bool:
        """Whether the levels hold for this design too."""
        return _what_counts(self.design, self.clip_id) == _what_counts(design, self.clip_id)


class WaveletLevelling(QObject):
    """Gives the wavelets of the selected clip gains with which all arrive alike.

    Parameters
    ----------
    document, runner
        What is edited; who predicts.
    """

    #: Why nothing came of it.
    failed = Signal(str)

    def __init__(self, document: Document, runner: JobRunner, parent: QObject) -> None:
        super().__init__(parent)
        self._document, self._runner = document, runner
        self._asked: dict[Job[Any], _Asked] = {}
        runner.done.connect(self._apply)
        runner.cancelled.connect(self._forget)
        runner.failed.connect(self._tell)

    def equalise(self) -> None:
        """Predict each wavelet of the selected train alone; the edit follows."""
        design = self._document.design
        clip = selected_train(design, self._document.view)
        if clip is not None:
            job = Job("Equalising wavelets", partial(wavelet_levels_db, design, clip.id))
            self._asked[job] = _Asked(design, clip.id)
            self._runner.add(job)

    def _apply(self, job: Job[Any], levels_db: tuple[float, ...]) -> None:
        asked = self._asked.pop(job, None)
        if asked is None:
            return
        design, view = self._document.design, self._document.view
        if asked.is_as_in(design):
            outcome = edits.equalise_on_skin(design, view, asked.clip_id, levels_db, MEASURE)
            self._document.apply(outcome)
        else:
            self.failed.emit(_CHANGED)

    def _tell(self, job: Job[Any], error: Exception) -> None:
        if self._asked.pop(job, None) is not None:
            self.failed.emit(str(error))

    def _forget(self, job: Job[Any]) -> None:
        self._asked.pop(job, None)


def selected_train(design: Design, view: View) -> Clip | None:
    """The clip that stands apart, if it plays a wavelet train."""
    if view.selected_input not in design.ids:
        return None
    clip = clip_of(design.input(view.selected_input), view)
    return clip if clip is not None and isinstance(clip.waveform, WaveletTrain) else None


def _what_counts(design: Design, clip_id: int) -> object:
    """All of a design that the level of a wavelet on the skin depends on."""
    if clip_id not in {one.id for one in design.clips}:
        return None
    clip, track = design.clip(clip_id), design.track_of(clip_id)
    train = clip.waveform
    if isinstance(train, WaveletTrain):
        train = replace(train, gains_db=())
    curve = track.gain_curve and (track.gain_curve, clip.onset_s)
    return design.limb, track.location, curve, train, clip.effects
