"""What the numbers on a map are: levels over a span, or what the skin does at an instant."""

from dataclasses import dataclass

from skinsource.design.labels import AXES, level_words, signal_words, span_words, word_of
from skinsource_gui.widgets.fields.level_text import minus

#: Levels; along z, with its sign; the length of the vector; the RMS of a window that slides.
LEVELS, Z, MAGNITUDE, RMS = "levels", "z", "magnitude", "rms"
#: Level above the threshold of detection.
SENSATION = "sensation"
#: What is the same at any time.
STILL = (LEVELS, SENSATION)
_DB, _MPS2 = "dB re 1 m/s²", "m/s²"


@dataclass(frozen=True, slots=True, kw_only=True)
class MapQuantity:
    """What the numbers on a map are.

    Attributes
    ----------
    name
        `LEVELS`, `SENSATION`, `Z`, `MAGNITUDE` or `RMS`.
    span
        What levels are the RMS over.
    signal
        What the sliding RMS is that of, as in `skinsource.design.labels`.
    window_s
        Its length.
    time_s
        The instant that is shown, as the time axis of traces has it.
    matched
        By how much it is louder or softer than it was stored, or "".
    """

    name: str = LEVELS
    span: str = "record"
    signal: str = ""
    window_s: float = 0.0
    time_s: float = 0.0
    matched: str = ""

    @property
    def signed(self) -> bool:
        """Whether zero lies in the middle of the colours."""
        return self.name == Z

    @property
    def moves(self) -> bool:
        """Whether it is another one at another time."""
        return self.name not in STILL

    @property
    def titles(self) -> tuple[str, ...]:
        """Titles of the colour scale; the longest that fits is shown."""
        if not self.matched:
            return self._plain_titles
        return (*(f"{title}, {self.matched}" for title in self._plain_titles), self.matched)

    @property
    def _plain_titles(self) -> tuple[str, ...]:
        if self.name == LEVELS:
            return f"{_DB}, {level_words(self.span)}", f"{_DB}, {span_words(self.span)}", _DB
        if self.name == SENSATION:
            said = "above the threshold of detection"
            return f"dB {said}, loudest 100 ms", f"dB {said}", "dB above threshold", "dB"
        if self.name == Z:
            return f"{_MPS2}, acceleration along z", f"{_MPS2}, along z", _MPS2
        if self.name == MAGNITUDE:
            return f"{_DB}, magnitude of acceleration", f"{_DB}, magnitude", _DB
        length = f"RMS over {self.window_s * 1e3:g} ms"
        return f"{_DB}, {length}", _DB

    @property
    def heading(self) -> str:
        """What a picture of it is called."""
        if self.name == LEVELS:
            return f"Skin acceleration, {level_words(self.span)}"
        if self.name == SENSATION:
            return "Level above the threshold of detection, loudest 100 ms"
        what = {
            Z: "Skin acceleration along z",
            MAGNITUDE: "Magnitude of skin acceleration",
            RMS: f"Skin acceleration, RMS over {self.window_s * 1e3:g} ms",
        }
        return f"{what[self.name]}, at {time_text(self.time_s)}"

    def details_on(self, axes: str) -> str:
        """What was made of the axes of a limb."""
        if self.name in (Z, SENSATION):
            return "z" if self.name == Z else f"{word_of(AXES, axes).title} together"
        return signal_words(axes, "mag") if self.name == MAGNITUDE else self.signal

    def text(self, value: float) -> str:
        """A value in words."""
        if self.name == SENSATION:
            return minus(f"{value:+z.1f} dB re the threshold of detection")
        if self.name == Z:
            return minus(f"{value:+.3g} m/s² along z")
        amount = 10.0 ** (value / 20.0)
        return minus(f"{value:z.1f} dB re 1 m/s²  ({amount:.3g} m/s²)")


def time_text(time_s: float) -> str:
    """An instant in ms, from a minute on in s."""
    if abs(time_s) < 60.0:
        return minus(f"{time_s * 1e3:.1f} ms")
    return f"{time_s:.3f} s"
