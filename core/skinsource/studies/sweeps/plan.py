"""The plan of a sweep: its stimuli, their levels, and the order of their presentation."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from difflib import get_close_matches
from hashlib import sha256
from itertools import groupby
from typing import Literal, get_args

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt, load
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.prediction import Limits
from skinsource.base.arguments import checking, integer, one_of, real_number
from skinsource.base.conventions import Axes
from skinsource.base.errors import InvalidInputError, counted, quoted
from skinsource.base.json_text import Tree
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View
from skinsource.lab.matching import Strengths
from skinsource.signals.projection import Method
from skinsource.specs import models
from skinsource.specs.codec import to_text
from skinsource.specs.models import specs_of

Level = Literal["drive", "loudest_100ms", "above_threshold", "matched"]
LEVELS: tuple[Level, ...] = get_args(Level)
#: Levels that are predicted, and brought to `level_db`.
PREDICTED: tuple[Level, ...] = ("loudest_100ms", "above_threshold")


def equally_strong(design: Design, strengths: Strengths) -> Design:
    """Return the design with the drive of each input as people matched it.

    An amplitude then stands for the perceived strength of a reference of this amplitude.

    Raises
    ------
    InvalidInputError
        An input plays no single frequency, or its frequency or place was not matched.
    """
    inputs = (
        track if track.muted else _matched_track(number, track, strengths)
        for number, track in enumerate(design.inputs, start=1)
    )
    return replace(design, inputs=tuple(inputs))


def _matched_track(number: int, track: Input, strengths: Strengths) -> Input:
    played_hz = {
        getattr(clip.waveform, "frequency_hz", None) for clip in track.clips if not clip.muted
    }
    frequencies_hz = [each for each in played_hz if isinstance(each, float)]
    if not played_hz:
        return track
    if len(played_hz) != 1 or len(frequencies_hz) != 1:
        raise InvalidInputError(
            f"input {number} does not play one frequency, expected waveforms of one frequency_hz: "
            "only such vibrations were matched"
        )
    level_db = strengths.level_db(frequencies_hz[0], track.location)
    return replace(track, amplitude=track.amplitude * float(np.power(10.0, level_db / 20.0)))


#: Values of a variable.
Value = bool | int | float | str | tuple[int, ...]

#: An actuator at all places, with the equaliser of the design; predictions then go through it.
ACTUATOR = "actuator"
OF_DESIGN = ("limb", "scaling", ACTUATOR)
OF_INPUT = ("location", "amplitude", "muted")
OF_CLIP = ("onset_s", "gain")
#: Inputs are numbered in their order: "2.frequency_hz" is that of the second one alone.
_NUMBER_SEPARATOR = "."


@checking
def varied(design: Design, name: str, value: Value) -> Design:
    """Return ``design`` with the variable ``name`` set to ``value``.

    Parameters
    ----------
    name
        ``"limb"``, ``"scaling"`` and ``"actuator"`` (at all places) of the design; ``"location"``,
        ``"amplitude"``, ``"muted"`` of inputs; ``"onset_s"`` and ``"gain"`` of clips; any field of
        waveforms: ``"frequency_hz"``.  Every input gets the value, clip by clip where they have the
        field; ``"2.frequency_hz"`` is of the second input alone.
    value
        A list of places for ``"location"`` goes to the inputs in their order.

    Raises
    ------
    InvalidInputError
        Nothing in the design has such a field, or the value does not fit it.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> print(ss.sweeps.varied(design, "frequency_hz", 50.0).clips[0].waveform.frequency_hz)
    50.0
    """
    if name == "limb":
        # Any limb of this name: the digest is that of the limb before.
        return replace(design, limb=value, limb_digest="")  # type: ignore[arg-type]
    if name == ACTUATOR:
        return replace(design, actuation=_actuation(design, value))
    if name in OF_DESIGN:
        return replace(design, **{name: value})  # type: ignore[arg-type]
    number, field = _target_of(name, len(design.inputs))
    if field == "location" and isinstance(value, tuple):
        return _with_locations(design, number, value)
    changed = [
        _input_with(track, field, value) if number in (None, index) else None
        for index, track in enumerate(design.inputs)
    ]
    if all(track is None for track in changed):
        raise InvalidInputError(
            f"nothing in the design has {quoted(name)}; a sweep can vary "
            f"{', '.join(names_in(design))}"
        )
    inputs = (after or before for before, after in zip(design.inputs, changed, strict=True))
    return replace(design, inputs=tuple(inputs))


def names_in(design: Design) -> tuple[str, ...]:
    """Return the names that can be varied in ``design``, without the numbers of inputs."""
    of_waveforms = {
        name: None for clip in design.clips for name in specs_of(clip.waveform) if clip.waveform
    }
    return (
        *OF_DESIGN,
        *(OF_INPUT if design.inputs else ()),
        *(OF_CLIP if design.clips else ()),
        *of_waveforms,
    )


def _check_variable(name: str, designs: Sequence[Design]) -> None:
    """Raise `InvalidInputError` where ``name`` can be varied in none of the designs."""
    number, dot, field = name.rpartition(_NUMBER_SEPARATOR)
    known = list(dict.fromkeys(each for design in designs for each in names_in(design)))
    if dot:
        _target_of(name, max(len(design.inputs) for design in designs))
        known = [each for each in known if each not in OF_DESIGN]
    if field not in known:
        close = get_close_matches(field, known, n=1)
        nearest = f"perhaps {quoted(f'{number}{dot}{close[0]}')} is meant; " if close else ""
        raise InvalidInputError(
            f"nothing in the design has {quoted(name)}; {nearest}a sweep can vary "
            f"{', '.join(known)}"
        )


def _actuation(design: Design, value: Value) -> Actuation:
    """Return one kind of actuator at all places, with the equaliser of the design, if any."""
    if not isinstance(value, str):
        raise InvalidInputError(f"actuator is {quoted(value)}, expected a name")
    equaliser = RegularisedInverse() if design.actuation is None else design.actuation.equaliser
    return Actuation(
        actuators=(ActuatorAt(actuator=value, model=load(value)),), equaliser=equaliser
    )


def _target_of(name: str, n_inputs: int) -> tuple[int | None, str]:
    """Return the index of the input in ``name``, None: all inputs; and the field."""
    before, dot, field = name.partition(_NUMBER_SEPARATOR)
    if not dot:
        return None, name
    if not (before.isdecimal() and len(before) < 10 and 1 <= int(before) <= n_inputs):
        raise InvalidInputError(
            f"the variable {quoted(name)} names input {quoted(before)}, expected 1 to {n_inputs}"
        )
    return int(before) - 1, field


def _with_locations(design: Design, number: int | None, places: tuple[int, ...]) -> Design:
    if number is not None or len(places) != len(design.inputs):
        raise InvalidInputError(
            f"location is {quoted(places)}, expected one place for each of the "
            f"{len(design.inputs)} inputs"
        )
    inputs = (
        replace(track, location=place) for track, place in zip(design.inputs, places, strict=True)
    )
    return replace(design, inputs=tuple(inputs))


def _input_with(track: Input, field: str, value: Value) -> Input | None:
    """Return the input with ``field`` set; None: it has no such field."""
    if field in OF_INPUT:
        return replace(track, **{field: value})  # type: ignore[arg-type]
    changed = [_clip_with(clip, field, value) for clip in track.clips]
    if all(clip is None for clip in changed):
        return None
    clips = (after or before for before, after in zip(track.clips, changed, strict=True))
    return replace(track, clips=tuple(clips))


def _clip_with(clip: Clip, field: str, value: Value) -> Clip | None:
    if field in OF_CLIP:
        return replace(clip, **{field: value})  # type: ignore[arg-type]
    if field not in specs_of(clip.waveform):
        return None
    return replace(clip, waveform=replace(clip.waveform, **{field: value}))  # type: ignore[type-var]


Kind = Literal["given", "random", "counterbalanced"]
KINDS: tuple[Kind, ...] = get_args(Kind)
_MOST = 10_000
_MOST_TRIALS = 10_000_000
_MOST_SEED = 2**63 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """Order of trials: blocks for each participant.

    Attributes
    ----------
    kind
        ``"given"``: as in the sweep.  ``"random"``: each block is a permutation of its own.
        ``"counterbalanced"``: rows of a balanced Latin square, so that over as many blocks as there
        are stimuli (twice as many where their number is odd) each stimulus stands in each place,
        and follows each other one, equally often (Williams, "Experimental designs balanced for the
        estimation of residual effects of treatments", Aust. J. Chem. 2, 1949).
    seed
        Seed of the permutations, or of the assignment of stimuli to letters of the square.
    participants
        Number of participants; each has blocks of its own.
    blocks
        Number of blocks for each participant; every block holds every stimulus once.
    """

    kind: Kind = "given"
    seed: int = 0
    participants: int = 1
    blocks: int = 1

    def __post_init__(self) -> None:
        one_of("order", self.kind, KINDS)
        integer("seed", self.seed, 0, _MOST_SEED)
        integer("participants", self.participants, 1, _MOST)
        integer("blocks", self.blocks, 1, _MOST)


@dataclass(frozen=True, slots=True)
class Trial:
    """One presentation; all numbers from 1."""

    participant: int
    block: int
    trial: int
    stimulus: int


@checking
def trials(order: Order, stimuli: Sequence[int]) -> tuple[Trial, ...]:
    """Return all presentations of ``stimuli``, their numbers, participant by participant.

    Raises
    ------
    InvalidInputError
        There would be too many.

    Examples
    --------
    >>> import skinsource as ss
    >>> order = ss.sweeps.Order(kind="counterbalanced")
    >>> print([trial.stimulus for trial in ss.sweeps.trials(order, [1, 2, 3, 4])])
    [3, 1, 4, 2]
    """
    n_stimuli = len(stimuli)
    n_blocks = order.participants * order.blocks
    if n_blocks * n_stimuli > _MOST_TRIALS:
        raise InvalidInputError(
            f"{counted(n_blocks, 'block')} of {counted(n_stimuli, 'stimulus', 'stimuli')} are "
            f"{n_blocks * n_stimuli} trials, expected at most {_MOST_TRIALS}"
        )
    rng = np.random.default_rng(order.seed)
    # The assignment of stimuli to letters: the square itself is the same for all seeds.
    letters = rng.permutation(n_stimuli)
    presented = []
    for block in range(n_blocks):
        if order.kind == "random":
            sequence = rng.permutation(n_stimuli)
        elif order.kind == "counterbalanced":
            sequence = letters[latin_row(block, n_stimuli)]
        else:
            sequence = np.arange(n_stimuli)
        participant, of_participant = divmod(block, order.blocks)
        presented += [
            Trial(participant + 1, of_participant + 1, k + 1, stimuli[stimulus])
            for k, stimulus in enumerate(sequence)
        ]
    return tuple(presented)


def latin_row(row: int, n: int) -> np.ndarray:
    """Return row ``row`` of a balanced Latin square of ``n`` letters, (n,), from 0.

    For odd n the square is followed by its mirror image: balance takes 2 n rows.
    """
    steps = np.arange(n)
    # 0, 1, n-1, 2, n-2, …: the steps between adjacent letters are all different.
    first = np.where(steps % 2 == 1, (steps + 1) // 2, (n - steps // 2) % n)
    which, mirrored = row % n, n % 2 == 1 and (row // n) % 2 == 1
    letters: np.ndarray = (first + which) % n
    return letters[::-1] if mirrored else letters


MOST_STIMULI = 1_000_000
#: Stimuli in a batch: what they have in common is computed once.
BATCH_SIZE = 16
#: Range of the predicted level that stimuli are brought to, in dB.
LOWEST_DB, HIGHEST_DB = -100.0, 100.0
_FORMAT = "skinsource sweep"


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """All combinations of some designs and of values of variables.

    Attributes
    ----------
    designs
        Name and design of each.
    variables
        Name and values of each.  The last one varies first, the designs last.
    outputs
        Outputs that are measured besides the loudest one.
    axes, method
        Projection of the axes of an output onto one signal, see `skinsource.View`.
    level
        Level of the stimuli: ``"drive"``: that of the designs; ``"loudest_100ms"`` and
        ``"above_threshold"``: brought to ``level_db``, see
        `skinsource.studies.sweeps.measuring.Measurer.measure`; ``"matched"``: the strength that
        people perceived, by ``strengths``.  None: it follows from ``level_db`` and ``strengths``:
        the loudest 100 ms, matched, or the drive.
    level_db
        Level that predicted levels are brought to: dB re 1 m/s², or above threshold.
    strengths
        Matches of people.
    limits
        Limits of actuators besides their own; where designs are predicted through actuators.
    people
        Whether the range between people is measured too, which plays each stimulus on all limbs of
        a kind.
    """

    designs: tuple[tuple[str, Design], ...]
    variables: tuple[tuple[str, tuple[Value, ...]], ...] = ()
    outputs: tuple[int, ...] = ()
    axes: Axes = "xyz"
    method: Method = "pca"
    level: Level | None = None
    level_db: float | None = None
    strengths: Strengths | None = None
    limits: Limits = field(default_factory=Limits)
    people: bool = False

    def __post_init__(self) -> None:
        if not self.designs:
            raise InvalidInputError("the sweep has no design, expected at least one")
        for name, values in self.variables:
            if not values:
                raise InvalidInputError(f"{quoted(name)} has no values, expected at least one")
        if len({name for name, _ in self.variables}) < len(self.variables):
            raise InvalidInputError("a variable is named twice, expected different ones")
        if len(self) > MOST_STIMULI:
            raise InvalidInputError(
                f"the sweep has {len(self)} stimuli, expected at most {MOST_STIMULI}. Leave some "
                "values out, or make several sweeps."
            )
        self._set_level()
        # A view checks axes, method and outputs.
        View(axes=self.axes, method=self.method, outputs=self.outputs)
        for name, _ in self.variables:
            _check_variable(name, [design for _, design in self.designs])

    def _set_level(self) -> None:
        default: Level = "drive"
        if self.strengths is not None:
            default = "matched"
        elif self.level_db is not None:
            default = "loudest_100ms"
        level = default if self.level is None else one_of("level", self.level, LEVELS)
        object.__setattr__(self, "level", level)
        if (level in PREDICTED) != (self.level_db is not None):
            raise InvalidInputError(
                f"level is {quoted(level)} and level_db is {quoted(self.level_db)}, expected a "
                f"number with {' and '.join(PREDICTED)}, and with nothing else"
            )
        if (level == "matched") != (self.strengths is not None):
            raise InvalidInputError(
                f"level is {quoted(level)}, expected 'matched' with a table of matches, and with "
                "nothing else"
            )
        if self.level_db is not None:
            expected = f"{LOWEST_DB:g} to {HIGHEST_DB:g} dB"
            level_db = real_number(
                "level_db", self.level_db, expected, least=LOWEST_DB, most=HIGHEST_DB
            )
            # The same level has the same digest.
            object.__setattr__(self, "level_db", level_db)

    @property
    def drives_actuators(self) -> bool:
        """Whether designs are predicted through actuators, so that their demand is measured."""
        is_varied = any(name == ACTUATOR for name, _ in self.variables)
        return is_varied or any(design.actuated is not None for _, design in self.designs)

    def __len__(self) -> int:
        """Return the number of stimuli."""
        return len(self.designs) * math.prod(len(values) for _, values in self.variables)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the variables; the design is the first one where there are several."""
        of_designs = ("design",) if len(self.designs) > 1 else ()
        return (*of_designs, *(name for name, _ in self.variables))

    def values_of(self, number: int) -> dict[str, Value]:
        """Return the values of the variables in stimulus ``number``, from 1."""
        which, picked = self._picked(number)
        of_designs = {"design": self.designs[which][0]} if len(self.designs) > 1 else {}
        return {**of_designs, **dict(picked)}

    def design_of(self, number: int) -> Design:
        """Return the design of stimulus ``number``, from 1; matched, but not at `level_db`.

        Raises
        ------
        InvalidInputError
            A value does not fit the design.
        """
        which, picked = self._picked(number)
        design = self.designs[which][1]
        for name, value in picked:
            design = varied(design, name, value)
        return design if self.strengths is None else equally_strong(design, self.strengths)

    def neighbours(self, number: int) -> range:
        """Return the numbers of the batch of stimulus ``number``."""
        first = number - (number - 1) % BATCH_SIZE
        return range(first, min(first + BATCH_SIZE, len(self) + 1))

    @property
    def varying(self) -> frozenset[int]:
        """Ids of the inputs that vary within a batch; all where more than inputs varies.

        They follow from the plan and not from earlier measurements, so that a stimulus has the
        same metrics to the last bit wherever and whenever it is measured.
        """
        all_ids = frozenset(id for _, design in self.designs for id in design.ids)
        if len(self) == 1:
            return all_ids
        try:
            first, second = self.design_of(1), self.design_of(2)
        except InvalidInputError:
            return all_ids
        if first.limb != second.limb or first.scaling != second.scaling or first.ids != second.ids:
            return all_ids
        pairs = zip(first.inputs, second.inputs, strict=True)
        return frozenset(after.id for before, after in pairs if before != after)

    @property
    def digest(self) -> str:
        """SHA-256 of the plan, hexadecimal."""
        return sha256(self.text.encode()).hexdigest()

    @property
    def text(self) -> str:
        """The whole plan as text."""
        tree: Tree = {
            "designs": [[name, models.encode(design)] for name, design in self.designs],
            "variables": [[name, list(values)] for name, values in self.variables],
            "outputs": list(self.outputs),
            "axes": self.axes,
            "method": self.method,
            "level": self.level,
            "level_db": self.level_db,
            "strengths": None if self.strengths is None else asdict(self.strengths),
            "limits": models.encode(self.limits),
            **({"people": True} if self.people else {}),
        }
        return to_text(tree, _FORMAT)

    def _picked(self, number: int) -> tuple[int, tuple[tuple[str, Value], ...]]:
        """Return the index of the design, and one value of each variable."""
        if not 1 <= number <= len(self):
            raise InvalidInputError(f"there is no stimulus {number}, expected 1 to {len(self)}")
        rest = number - 1
        picked: list[tuple[str, Value]] = []
        for name, values in reversed(self.variables):
            rest, which = divmod(rest, len(values))
            picked.append((name, values[which]))
        return rest, tuple(reversed(picked))


def chunks(numbers: Iterable[int]) -> Iterator[tuple[int, ...]]:
    """Yield numbers of stimuli in their order, a batch at a time."""
    for _, chunk in groupby(numbers, lambda number: (number - 1) // BATCH_SIZE):
        yield tuple(chunk)
