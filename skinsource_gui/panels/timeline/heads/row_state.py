"""What the head of a track shows."""

from dataclasses import dataclass

from skinsource.design.clips import Clip
from skinsource.design.design import Input
from skinsource.specs.fields import NumberSpec
from skinsource_gui.widgets.inputs.input_words import EMPTY, clip_text, clips_text, duration_text


@dataclass(frozen=True, slots=True, kw_only=True)
class RowState:
    """What a row shows.

    Attributes
    ----------
    shown
        The input.
    silent
        Whether it is not heard, for being muted or because another is solo.
    selected, last, list_focused
        Whether the row is selected; whether it is the one that was selected last; whether keys go
        to the list.
    amplitude
        What an amplitude is, and in which unit.
    peak
        The peak that results where the amplitude is a plain factor, else "".
    clip
        The clip that stands for all of them: the selected one, or the first.
    limb
        Whose places have which names.
    """

    shown: Input
    silent: bool
    selected: bool
    last: bool
    list_focused: bool
    amplitude: NumberSpec
    clip: Clip | None
    limb: str = ""
    peak: str = ""

    @property
    def figure(self) -> str:
        """What the input plays, and for how long."""
        if self.clip is None:
            return EMPTY
        others = clips_text(len(self.shown.clips))
        lasts = duration_text(self.clip.duration_s)
        return f"{clip_text(self.clip)} · {lasts}{others}"

    @property
    def title(self) -> str:
        """What the input plays."""
        return EMPTY if self.clip is None else clip_text(self.clip)

    @property
    def words(self) -> tuple[int, int, bool, str, str]:
        """What is painted on it: what it plays is said by its tooltip only."""
        return self.shown.location, self.shown.colour, self.silent, self.limb, self.peak

    @property
    def frame(self) -> tuple[bool, bool, bool]:
        """What the ground of the row shows."""
        return self.selected, self.last, self.list_focused
