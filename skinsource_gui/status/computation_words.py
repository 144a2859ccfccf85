"""What an evaluation computed and what it left out, in words."""

from dataclasses import dataclass

from skinsource.base.work import Work
from skinsource.design.design import audible_inputs
from skinsource.engine.transforms import BLOCK_FFT
from skinsource.limbs.limb import Limb
from skinsource_gui.state.engine import Outcome

#: Quantities that it asks for beside those of the panels.
NEEDS = frozenset({"limb_data", "streamed"})
_IN_TIME = frozenset({"selected_traces", "selected_spectra", "selected_axis_spectra"})
#: The selected input, and all others together.
_PARTS = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Scope:
    """What was computed for the panels.

    Attributes
    ----------
    inputs, heard
        Inputs of the design, and those that are neither muted nor beside a solo one.
    channels
        Outputs times axes that were brought back to time; 0 where no panel shows them.
    all_channels
        Outputs times axes of the limb.
    has_map
        Whether the map was computed.
    streamed
        Whether the scene is too long to be transformed at once.
    work
        What it took.
    """

    inputs: int
    heard: int
    channels: int
    all_channels: int
    has_map: bool
    streamed: bool
    work: Work

    @property
    def method(self) -> str:
        """Precision and method."""
        return f"float64, overlap-save {BLOCK_FFT}" if self.streamed else "float64, spectra"

    @property
    def map_transforms(self) -> int:
        """Inverse transforms beyond those that the search and the channels can have needed."""
        others = self.work.search_transforms + _PARTS * self.channels
        return max(self.work.inverse_transforms - others, 0)

    def phrases(self) -> tuple[str, ...]:
        """Words for the status bar, from all to the least."""
        if not self.inputs:
            return ("No input yet", "No input")
        felt = felt_words(self.inputs, self.heard)
        long = " · long scene, summed piece by piece" if self.streamed else ""
        return (*([f"{felt} · up to date{long}"] if long else []), f"{felt} · up to date", felt)

    def sentences(self) -> str:
        """All of it in whole sentences, one on a line."""
        silent = self.inputs - self.heard
        lines = [
            f"{self.heard} of {self.inputs} inputs are felt"
            + (f"; {silent} muted or silenced by solo cost nothing." if silent else "."),
            f"{self.channels} of {self.all_channels} channels were brought back to time: the "
            "selected outputs, on the chosen axes."
            if self.channels
            else "No channel was brought back to time: no traces or spectra are shown.",
            self._about_map(),
            self._about_work(),
            f"Precision and method: {self.method}.",
        ]
        return "\n".join(line for line in lines if line)

    def _about_map(self) -> str:
        if not self.has_map:
            return "The map is not shown and was not computed."
        if self.streamed:
            return f"The map is summed up block by block, over all {self.all_channels} channels."
        count = self.map_transforms
        word = "transform" if count == 1 else "transforms"
        return f"The map took {count} inverse {word}: its levels follow from spectra."

    def _about_work(self) -> str:
        work = self.work
        search = (
            f", {work.search_transforms} of them in search of exact maxima"
            if work.search_transforms
            else ""
        )
        return (
            f"New work: {work.forward_transforms} forward and {work.inverse_transforms} inverse "
            f"transforms{search}; {work.samples_drawn} samples drawn, "
            f"{work.bytes_read / 1e6:.1f} MB read."
        )


def felt_words(inputs: int, heard: int) -> str:
    """Say how many inputs there are, and how many of them are felt."""
    words = "input" if inputs == 1 else "inputs"
    return f"{inputs} {words}" if heard == inputs else f"{heard} of {inputs} {words} felt"


def scope_of(outcome: Outcome) -> Scope:
    """What ``outcome`` has computed."""
    given, wanted = outcome.request.given, outcome.request.wanted
    values = outcome.values or {}
    limb: Limb = values["limb_data"]
    shows_channels = bool(wanted & _IN_TIME)
    return Scope(
        inputs=len(given["inputs"]),
        heard=len(audible_inputs(given["inputs"])),
        channels=len(given["outputs"]) * len(given["axes"]) if shows_channels else 0,
        all_channels=limb.n_outputs * limb.n_axes,
        has_map="output_levels_db" in wanted,
        streamed=values["streamed"],
        work=outcome.work,
    )
