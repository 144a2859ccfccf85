"""The motion that is being made up, before it is kept."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import sentence
from skinsource.base.work import counted
from skinsource.design.design import MAX_INPUTS, Design
from skinsource.design.edits.edit import as_kind
from skinsource.design.motions import MOTIONS, Motion, following, with_field
from skinsource.design.waveforms import Waveform
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.fields import RecipeSpec, specs_of
from skinsource_gui.widgets.inputs.clip_strip import Lane, ShownClips


class Draft(QObject):
    """Holds one motion, and those of other kinds as they were left.

    Parameters
    ----------
    design
        What it is to be added to; colours follow from it.
    onset_s
        When it begins at first.

    Attributes
    ----------
    motion
        As it is; while the path is not one, with the last one that was.
    path
        As it was clicked or typed.
    problem
        Why that is no path for the motion, or "".
    """

    changed = Signal()
    #: Name of a field, and why its value stays as it was.
    field_refused = Signal(str, str)
    waveform_field_refused = Signal(str, str)

    def __init__(self, design: Design, onset_s: float, parent: QObject) -> None:
        super().__init__(parent)
        self._design, self._limb = design, facts_of(design.limb)
        self._left: dict[str, Motion] = {kind.__name__: kind() for kind in MOTIONS}
        self.motion: Motion = self._left[MOTIONS[0].__name__]
        # The playhead may stand later than anything can begin.
        with suppress(InvalidInputError):
            self.motion = with_field(self.motion, "onset_s", onset_s)
        self.path, self.problem = self.motion.path, ""
        # A phantom has room for two places; the way back leads to all of them.
        self._whole_path = self.path

    def change_kind(self, name: str) -> None:
        """Go over to another kind of motion, along the same path."""
        self._left[type(self.motion).__name__] = self.motion
        found = following(self._left[name], self.motion)
        with suppress(InvalidInputError):
            found = with_field(found, "path", self._whole_path)
        self._take(found)

    def change_field(self, name: str, value: Any) -> None:
        """Give a field of the motion another value."""
        self._try(lambda: with_field(self.motion, name, value), name, self.field_refused)

    def change_path(self, path: tuple[int, ...]) -> None:
        """Take another path; what is none yet is shown, but not taken."""
        self._whole_path = path
        problem = _why_no_path(self.motion, path, self._limb.n_inputs)
        if problem:
            self.path, self.problem = path, problem
            self.changed.emit()
        else:
            self._take(with_field(self.motion, "path", path))

    def change_waveform_kind(self, name: str) -> None:
        """Play another kind of waveform."""
        kind = next(one for one in self.waveform_kinds if one.__name__ == name)
        new = as_kind(self.motion.waveform, kind, self._limb.sample_rate_hz)
        self._try(
            lambda: with_field(self.motion, "waveform", new), "kind", self.waveform_field_refused
        )

    def change_waveform_field(self, name: str, value: Any) -> None:
        """Give a field of the waveform another value."""
        recipe: Any = self.motion.waveform
        self._try(
            lambda: with_field(self.motion, "waveform", replace(recipe, **{name: value})),
            name,
            self.waveform_field_refused,
        )

    @property
    def waveform_kinds(self) -> tuple[type[Waveform], ...]:
        """What may play."""
        spec = specs_of(self.motion)["waveform"]
        return spec.kinds() if isinstance(spec, RecipeSpec) else ()

    def lanes(self) -> tuple[Lane, ...]:
        """Its tracks as they would be added.

        Raises
        ------
        InvalidInputError
            A clip would start too late, there would be too many inputs, or something is in it that
            the limb cannot play at its rate.
        """
        tracks = self.motion.tracks()
        if len(self._design.inputs) + len(tracks) > MAX_INPUTS:
            raise InvalidInputError(
                f"it takes {counted(len(tracks), 'input')} more, and a design holds at most "
                f"{MAX_INPUTS}; remove some first"
            )
        after = self._design
        for one in tracks:
            after = after.adding(one)
        added = after.inputs[len(self._design.inputs) :]
        largest = max(abs(one.amplitude) for one in added) or 1.0
        shown = ShownClips(self._limb.sample_rate_hz)
        return tuple(
            Lane(
                place=one.location,
                colour=one.colour,
                clips=tuple(shown.of(clip, one.amplitude / largest) for clip in one.clips),
            )
            for one in added
        )

    def _try(self, change: Callable[[], Motion], name: str, refused: Any) -> None:
        path, problem = self.path, self.problem
        try:
            self._take(change(), path, problem)
        except InvalidInputError as error:
            refused.emit(name, sentence(str(error)))

    def _take(self, motion: Motion, path: tuple[int, ...] | None = None, problem: str = "") -> None:
        self.motion = motion
        self.path, self.problem = motion.path if path is None else path, problem
        self.changed.emit()


def _why_no_path(motion: Motion, path: tuple[int, ...], n_places: int) -> str:
    """Why ``motion`` cannot go there; "" where it can."""
    spec: Any = specs_of(motion)["path"]
    strange = next((place for place in path if not 1 <= place <= n_places), None)
    if strange is not None:
        return f"There is no place {strange}; the hand has 1 to {n_places}."
    if len(path) < spec.fewest:
        return f"Click {counted(spec.fewest - len(path), 'more place')}."
    if len(path) > spec.most:
        return f"{motion.title} takes {spec.most} places; remove the last."
    try:
        with_field(motion, "path", path)
    except InvalidInputError as error:
        return sentence(str(error))
    return ""
