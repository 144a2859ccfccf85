"""What a row of the list of inputs shows."""

from dataclasses import dataclass

from skinsource.design import Input
from skinsource_gui.widgets.inputs.input_words import duration_text, figure_text


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
    unit
        Of the amplitude.
    """

    shown: Input
    silent: bool
    selected: bool
    last: bool
    list_focused: bool
    unit: str

    @property
    def figure(self) -> str:
        """What the input plays, and for how long."""
        waveform = self.shown.waveform
        return f"{figure_text(waveform)} · {duration_text(waveform)}"

    @property
    def frame(self) -> tuple[bool, bool, bool]:
        """What the ground of the row shows."""
        return self.selected, self.last, self.list_focused
