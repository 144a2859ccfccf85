"""All that a limb of a lab's own holds besides its responses."""

import re
from dataclasses import dataclass, replace

import numpy as np

from skinsource.arguments import one_of, real_array, real_number, whole_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.limb import AXES, Axes, Band, LimbMap
from skinsource.quoting import quoted

MOST_INPUTS, MOST_OUTPUTS, MOST_TAPS = 256, 512, 2**20
#: Of all responses together: 256 x 512 x 3 of half a second at 4 kHz take 6.3 GB.
MOST_BYTES = 8 * 10**9
MOST_VERTICES = 20_000
LEAST_RATE_HZ, MOST_RATE_HZ = 100.0, 768_000.0
NAME_RULE = "small letters, digits and '-', at most 40, a letter first"
_NAME = re.compile(r"[a-z][a-z0-9-]{0,39}")
# As the limbs that come with the studio, and those that are published.
_TAKEN = ("measured-", "synthetic-")
_LONGEST_TITLE, _LONGEST_NOTE, _LONGEST_PLACE = 100, 2000, 80
# Coordinates beyond this are no places on a hand, in whatever unit.
_FARTHEST = 1e6


def is_free_name(name: object) -> bool:
    """Whether an own limb may be called so: `NAME_RULE`, and no limb that comes with the studio."""
    return isinstance(name, str) and bool(_NAME.fullmatch(name)) and not name.startswith(_TAKEN)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OwnLimb:
    """Checked when it is made.

    Attributes
    ----------
    name
        What designs and commands call it, see `NAME_RULE`.
    title, note
        What the window calls it, and what users should know of it.
    n_taps, axes, sample_rate_hz, pre_trigger_delay_s, band_hz, per_unit_drive, synthetic
        As of `skinsource.Limb`.
    hand_length_mm
        Tip of the middle finger to the middle of the wrist.
    hand_length_px
        The same in the unit of the coordinates.
    outline : (n_vertices, 2)
        Closed polygon, x to the right, y up; the back of the hand, fingertips up.
    input_positions : (n_inputs, 2)
        Seen through the hand from the back.
    output_positions : (n_outputs, 2)
        NaN where an output has no place on the back.
    input_names, output_names
        One for each; empty: none has a name.
    left
        Whether it is a left hand.
    mirrored
        Whether it is shown as a right hand.
    """

    name: str
    title: str = ""
    note: str = ""
    n_taps: int
    axes: Axes
    sample_rate_hz: float
    pre_trigger_delay_s: float = 0.0
    band_hz: Band | None = None
    per_unit_drive: bool = True
    synthetic: bool = False
    hand_length_mm: float
    hand_length_px: float
    outline: Floats
    input_positions: Floats
    output_positions: Floats
    input_names: tuple[str, ...] = ()
    output_names: tuple[str, ...] = ()
    left: bool = False
    mirrored: bool = False

    def __post_init__(self) -> None:
        if not is_free_name(self.name):
            raise InvalidInputError(
                f"the name of the limb is {quoted(self.name)}, expected {NAME_RULE}, not beginning "
                f"with {' or '.join(_TAKEN)}"
            )
        self._put(title=_line("title", self.title, _LONGEST_TITLE))
        self._put(note=_line("note", self.note, _LONGEST_NOTE))
        one_of("axes", self.axes, AXES)
        self._put(n_taps=whole_number("n_taps", self.n_taps, 1, MOST_TAPS))
        for name, least, most, unit in (
            ("sample_rate_hz", LEAST_RATE_HZ, MOST_RATE_HZ, "Hz"),
            ("pre_trigger_delay_s", 0.0, 10.0, "s"),
            ("hand_length_mm", 20.0, 2000.0, "mm"),
            ("hand_length_px", 1e-3, _FARTHEST, "of the unit of the outline"),
        ):
            expected = f"a number from {least:g} to {most:g} {unit}"
            number = real_number(name, getattr(self, name), expected, least=least, most=most)
            self._put(**{name: number})
        self._put(band_hz=_band(self.band_hz, self.sample_rate_hz))
        self._check_places()
        n_bytes = 8 * self.n_inputs * self.n_outputs * len(self.axes) * self.n_taps
        if n_bytes > MOST_BYTES:
            raise InvalidInputError(
                f"the responses would take {n_bytes / 1e9:.1f} GB, expected at most "
                f"{MOST_BYTES / 1e9:g}. Shorten them, or leave places out."
            )

    def _check_places(self) -> None:
        outline = _points("outline", self.outline, 3, MOST_VERTICES, missing=False)
        if len(outline) > 3 and np.array_equal(outline[0], outline[-1]):
            outline = outline[:-1]
        x, y = outline.T
        extent = np.ptp(outline, axis=0).max()
        area = 0.5 * abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))
        if not area > 1e-6 * extent**2:
            raise InvalidInputError(
                "outline encloses no area, expected the corners of a polygon in their order"
            )
        self._put(
            outline=outline,
            input_positions=_points("input_positions", self.input_positions, 1, MOST_INPUTS),
            output_positions=_points("output_positions", self.output_positions, 1, MOST_OUTPUTS),
        )
        for what, names, n in (
            ("input_names", self.input_names, self.n_inputs),
            ("output_names", self.output_names, self.n_outputs),
        ):
            texts = tuple(_line(what, one, _LONGEST_PLACE) for one in names)
            if texts and len(texts) != n:
                raise InvalidInputError(
                    f"{what} are {len(texts)}, expected {n}, one for each place"
                )
            self._put(**{what: texts})

    def _put(self, **checked: object) -> None:
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    @property
    def n_inputs(self) -> int:
        """How many input places there are."""
        return len(self.input_positions)

    @property
    def n_outputs(self) -> int:
        """How many outputs there are."""
        return len(self.output_positions)

    @property
    def shape(self) -> tuple[int, int, int, int]:
        """Of the responses: (n_inputs, n_outputs, n_axes, n_taps)."""
        return self.n_inputs, self.n_outputs, len(self.axes), self.n_taps

    def map(self) -> LimbMap:
        """Outline and places, as they are shown."""
        # About the middle of the outline, so that it stays where it is.
        both = self.outline[:, 0].min() + self.outline[:, 0].max()

        def shown(points: Floats) -> Floats:
            return np.column_stack((both - points[:, 0], points[:, 1])) if self.mirrored else points

        return LimbMap(
            outline=shown(self.outline),
            output_positions=shown(self.output_positions),
            input_positions=shown(self.input_positions),
            hand_length_px=self.hand_length_px,
            axes_shown=False,
        )

    def shown_mirrored(self, mirrored: bool) -> "OwnLimb":
        """The same, shown the other way round or not."""
        return replace(self, mirrored=mirrored)


def _line(what: str, text: object, longest: int) -> str:
    if not isinstance(text, str) or len(text) > longest or not (text.isprintable()):
        raise InvalidInputError(
            f"{what} is {quoted(text)}, expected one line of at most {longest} characters"
        )
    return text.strip()


def _band(band_hz: object, sample_rate_hz: float) -> Band | None:
    if band_hz is None:
        return None
    found = real_array("band_hz", band_hz, "two frequencies")  # type: ignore[arg-type]
    highest = sample_rate_hz / 2.0
    if found.shape != (2,) or not 0.0 <= found[0] < found[1] <= highest:
        raise InvalidInputError(
            f"band_hz is {quoted(band_hz)}, expected a lower and a higher frequency, up to half "
            f"the sample rate, {highest:g} Hz"
        )
    return float(found[0]), float(found[1])


def _points(what: str, points: object, fewest: int, most: int, *, missing: bool = True) -> Floats:
    """Checked places, (n, 2); a row without a number is no place, where that may be."""
    found = np.array(real_array(what, points, "(n, 2)"))  # type: ignore[arg-type]
    if found.ndim != 2 or found.shape[1] != 2 or not fewest <= len(found) <= most:
        raise InvalidInputError(
            f"{what} has shape {found.shape}, expected (n, 2) with {fewest} to {most} rows: x, y"
        )
    unusable = ~(np.abs(found) <= _FARTHEST)
    if missing:
        found[np.isnan(found).any(axis=1)] = np.nan
        unusable = ~(np.abs(found) <= _FARTHEST) & ~np.isnan(found)
    if unusable.any():
        row, column = np.argwhere(unusable)[0]
        raise InvalidInputError(
            f"{what}, row {row + 1}: {'xy'[column]} is {found[row, column]}, expected a number of "
            f"at most {_FARTHEST:g}"
        )
    found.flags.writeable = False
    return found
