"""How strong the stimuli of a sweep are: as drawn, as predicted, or as people matched them."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from hashlib import sha256
from itertools import groupby
from typing import Any, Literal, get_args

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.catalog import load
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.prediction import Limits
from skinsource.base.arguments import integer, one_of
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.json_text import Tree
from skinsource.base.published import Axes
from skinsource.base.quoting import quoted
from skinsource.base.work import counted
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.view import View
from skinsource.lab.matching import Strengths
from skinsource.perception.sensation import sensation_levels_db
from skinsource.signals.projection import Method
from skinsource.specs import models
from skinsource.specs.codec import from_text, to_text
from skinsource.specs.models import specs_of
from skinsource.specs.spec import Address

Level = Literal["drive", "loudest_100ms", "above_threshold", "matched"]
LEVELS: tuple[Level, ...] = get_args(Level)
#: Those that are predicted, and brought to so many decibels.
PREDICTED: tuple[Level, ...] = ("loudest_100ms", "above_threshold")
# A level below it is that of silence.
_SILENCE_DB = -290.0


def equally_strong(design: Design, strengths: Strengths) -> Design:
    """The design with the drive of each input as people matched it.

    An amplitude then means how strong it feels: that of a reference of this amplitude.

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


def above_threshold(acceleration: Floats, sample_rate_hz: float, scaling: str) -> float:
    """How far the most sensitive channel at the loudest output is above threshold, as a ratio.

    Parameters
    ----------
    acceleration : (n_outputs, n_axes, n_times)
        m/s².
    scaling
        Of the design.

    Raises
    ------
    InvalidInputError
        Amplitudes are no accelerations, or nothing is known of the outputs of the limb.
    """
    if scaling != "probe":
        raise InvalidInputError(
            f"the scaling is {quoted(scaling)}, and levels above threshold need m/s². Choose the "
            "scaling Probe acceleration."
        )
    levels_db = sensation_levels_db(acceleration, sample_rate_hz)
    highest_db = max(float(channel_db.max()) for channel_db in levels_db.values())
    return float(10.0 ** (highest_db / 20.0)) if highest_db > _SILENCE_DB else 0.0


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


# What a sweep can vary: a name and a value make one design of another.

#: What a variable can be set to.
Value = bool | int | float | str | tuple[int, ...]

#: At all places, with the equaliser of the design; predictions then go through it.
ACTUATOR = "actuator"
OF_DESIGN = ("limb", "scaling", ACTUATOR)
OF_INPUT = ("location", "amplitude", "muted")
OF_CLIP = ("onset_s", "gain")
#: Inputs are numbered as they are listed: "2.frequency_hz" is of the second one alone.
_NUMBER_SEPARATOR = "."


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
    """
    if name == "limb":
        # Whichever has the name; the digest is that of the one before.
        return replace(design, limb=value, limb_digest="")  # type: ignore[arg-type]
    if name == ACTUATOR:
        return replace(design, actuation=_actuation(design, value))
    if name in OF_DESIGN:
        return replace(design, **{name: value})  # type: ignore[arg-type]
    number, field = _target_of(name, len(design.inputs))
    if field == "location" and isinstance(value, tuple):
        return _with_locations(design, number, value)
    chosen = range(len(design.inputs)) if number is None else (number,)
    inputs = list(design.inputs)
    has_field = False
    for index in chosen:
        changed = _input_with(inputs[index], field, value)
        has_field = has_field or changed is not None
        inputs[index] = changed or inputs[index]
    if not has_field:
        raise InvalidInputError(
            f"nothing in the design has {quoted(name)}; a sweep can vary "
            f"{', '.join(names_in(design))}"
        )
    return replace(design, inputs=tuple(inputs))


def names_in(design: Design) -> tuple[str, ...]:
    """What can be varied in ``design``, without the numbers of inputs."""
    of_waveforms = {
        name: None for clip in design.clips for name in specs_of(clip.waveform) if clip.waveform
    }
    return (
        *OF_DESIGN,
        *(OF_INPUT if design.inputs else ()),
        *(OF_CLIP if design.clips else ()),
        *of_waveforms,
    )


def _actuation(design: Design, value: Value) -> Actuation:
    """One kind of actuator at all places; it follows the drives unless the design says else."""
    if not isinstance(value, str):
        raise InvalidInputError(f"actuator is {quoted(value)}, expected a name")
    equaliser = RegularisedInverse() if design.actuation is None else design.actuation.equaliser
    return Actuation(
        actuators=(ActuatorAt(actuator=value, model=load(value)),), equaliser=equaliser
    )


def _target_of(name: str, n_inputs: int) -> tuple[int | None, str]:
    """Index of the input that ``name`` speaks of, None: of all; and the field."""
    before, dot, field = name.partition(_NUMBER_SEPARATOR)
    if not dot:
        return None, name
    if not (before.isdecimal() and len(before) < 10 and 1 <= int(before) <= n_inputs):
        raise InvalidInputError(
            f"the variable {quoted(name)} speaks of input {quoted(before)}; the design has "
            f"{n_inputs}, numbered from 1"
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
    """The input with ``field`` set; None where it has none."""
    if field in OF_INPUT:
        return replace(track, **{field: value})  # type: ignore[arg-type]
    clips = _changed_clips(track.clips, lambda clip: _clip_with(clip, field, value))
    return None if clips is None else replace(track, clips=clips)


def _clip_with(clip: Clip, field: str, value: Value) -> Clip | None:
    if field in OF_CLIP:
        return replace(clip, **{field: value})  # type: ignore[arg-type]
    if field not in specs_of(clip.waveform):
        return None
    return replace(clip, waveform=replace(clip.waveform, **{field: value}))  # type: ignore[type-var]


def _changed_clips(
    clips: Iterable[Clip], change: Callable[[Clip], Clip | None]
) -> tuple[Clip, ...] | None:
    """Clips changed where they can be; None where none can."""
    pairs: list[tuple[Clip, Any]] = [(clip, change(clip)) for clip in clips]
    if all(changed is None for _, changed in pairs):
        return None
    return tuple(changed or clip for clip, changed in pairs)


# In which order stimuli are presented: blocks of trials for each participant.

Kind = Literal["given", "random", "counterbalanced"]
KINDS: tuple[Kind, ...] = get_args(Kind)
_MOST = 10_000
_MOST_TRIALS = 10_000_000
_MOST_SEED = 2**63 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """How trials follow each other.

    Attributes
    ----------
    kind
        ``"given"``: as in the sweep.  ``"random"``: each block is a permutation of its own.
        ``"counterbalanced"``: rows of a balanced Latin square, so that over as many blocks as there
        are stimuli (twice as many where their number is odd) each stimulus stands in each place,
        and follows each other one, equally often (Williams, "Experimental designs balanced for the
        estimation of residual effects of treatments", Aust. J. Chem. 2, 1949).
    seed
        Of what is random: the permutations, or which stimulus is which letter of the square.
    participants
        How many; each has blocks of its own.
    blocks
        For each participant; every block holds every stimulus once.
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


def trials(order: Order, stimuli: Sequence[int]) -> tuple[Trial, ...]:
    """Return all presentations of ``stimuli``, their numbers, participant by participant.

    Raises
    ------
    InvalidInputError
        There would be too many.
    """
    n_stimuli = len(stimuli)
    n_blocks = order.participants * order.blocks
    if n_blocks * n_stimuli > _MOST_TRIALS:
        raise InvalidInputError(
            f"{counted(n_blocks, 'block')} of {counted(n_stimuli, 'stimulus', 'stimuli')} are "
            f"{n_blocks * n_stimuli} trials, expected at most {_MOST_TRIALS}"
        )
    rng = np.random.default_rng(order.seed)
    # Which stimulus is which letter: the square itself is the same for all seeds.
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
    # 0, 1, n-1, 2, n-2, …: the steps between neighbours are all different.
    first = np.where(steps % 2 == 1, (steps + 1) // 2, (n - steps // 2) % n)
    which, mirrored = row % n, n % 2 == 1 and (row // n) % 2 == 1
    letters: np.ndarray = (first + which) % n
    return letters[::-1] if mirrored else letters


# Which stimuli a sweep consists of.

MOST_STIMULI = 1_000_000
#: Neighbours that are measured together: what they have in common is computed once for them.
BATCH_SIZE = 16
#: The predicted level that a sweep can bring its stimuli to, in dB.
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
        What is measured beside the loudest output.
    axes, method
        How the axes of an output become one signal, see `skinsource.View`.
    level
        How strong the stimuli are: ``"drive"``: as the designs say; ``"loudest_100ms"`` and
        ``"above_threshold"``: brought to ``level_db``, see
        `skinsource.studies.sweeps.measuring.Measurer.measure`; ``"matched"``: as strong as people
        found them, by ``strengths``.  None: what ``level_db`` and ``strengths`` ask for: the
        loudest 100 ms, matched, or the drive.
    level_db
        What predicted levels are brought to: dB re 1 m/s², or above threshold.
    strengths
        What people matched.
    limits
        What actuators must not pass, beside their own limits; where designs are predicted
        through actuators.
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
        self._settle_level()
        # Whether axes, method and outputs are known is checked where they are put to use.
        View(axes=self.axes, method=self.method, outputs=self.outputs)

    def _settle_level(self) -> None:
        wanted: Level = "drive"
        if self.strengths is not None:
            wanted = "matched"
        elif self.level_db is not None:
            wanted = "loudest_100ms"
        level = wanted if self.level is None else one_of("level", self.level, LEVELS)
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
        if self.level_db is not None and not LOWEST_DB <= self.level_db <= HIGHEST_DB:
            raise InvalidInputError(
                f"level_db is {quoted(self.level_db)}, expected {LOWEST_DB:g} to {HIGHEST_DB:g} dB"
            )

    @property
    def drives_actuators(self) -> bool:
        """Whether it says what actuators have to do."""
        varied_ones = any(name == ACTUATOR for name, _ in self.variables)
        return varied_ones or any(design.actuated is not None for _, design in self.designs)

    def __len__(self) -> int:
        """How many stimuli there are."""
        return len(self.designs) * math.prod(len(values) for _, values in self.variables)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the variables; the design is the first one where there are several."""
        of_designs = ("design",) if len(self.designs) > 1 else ()
        return (*of_designs, *(name for name, _ in self.variables))

    def values_of(self, number: int) -> dict[str, Value]:
        """Values of the variables in stimulus ``number``, from 1."""
        which, picked = self._picked(number)
        of_designs = {"design": self.designs[which][0]} if len(self.designs) > 1 else {}
        return {**of_designs, **dict(picked)}

    def design_of(self, number: int) -> Design:
        """Design of stimulus ``number``, from 1; as matched, but not brought to `level_db`.

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
        """Numbers of the stimuli that are measured together with ``number``."""
        first = number - (number - 1) % BATCH_SIZE
        return range(first, min(first + BATCH_SIZE, len(self) + 1))

    @property
    def varying(self) -> frozenset[int]:
        """Ids of the inputs that neighbours differ in; all where they differ in more than inputs.

        It follows from the plan and not from what was measured before, so that a stimulus has the
        same metrics to the last bit wherever and after whatever it is measured.
        """
        everything = frozenset(id for _, design in self.designs for id in design.ids)
        if len(self) == 1:
            return everything
        try:
            first, other = self.design_of(1), self.design_of(2)
        except InvalidInputError:
            return everything
        if first.limb != other.limb or first.scaling != other.scaling or first.ids != other.ids:
            return everything
        pairs = zip(first.inputs, other.inputs, strict=True)
        return frozenset(after.id for before, after in pairs if before != after)

    @property
    def digest(self) -> str:
        """What tells this plan from others, hexadecimal."""
        return sha256(self.text.encode()).hexdigest()

    @property
    def text(self) -> str:
        """All of it, for `plan_of`."""
        tree: Tree = {
            "designs": [[name, models.encode(design)] for name, design in self.designs],
            "variables": [[name, list(values)] for name, values in self.variables],
            "outputs": list(self.outputs),
            "axes": self.axes,
            "method": self.method,
            "level": self.level,
            "level_db": self.level_db,
            "strengths": None if self.strengths is None else _tree_of(self.strengths),
            "limits": models.encode(self.limits),
        }
        return to_text(tree, _FORMAT)

    def _picked(self, number: int) -> tuple[int, tuple[tuple[str, Value], ...]]:
        """Which design, and one value of each variable."""
        if not 1 <= number <= len(self):
            raise InvalidInputError(f"there is no stimulus {number}, expected 1 to {len(self)}")
        rest = number - 1
        picked: list[tuple[str, Value]] = []
        for name, values in reversed(self.variables):
            rest, which = divmod(rest, len(values))
            picked.append((name, values[which]))
        return rest, tuple(reversed(picked))


def plan_of(text: str) -> Plan:
    """The plan that `Plan.text` wrote.

    Raises
    ------
    FileFormatError
        The text holds something else.
    """
    tree = from_text(text, _FORMAT)
    return Plan(
        designs=tuple(
            (name, models.decode(content, (Design,), Address(("designs", name))))
            for name, content in tree["designs"]
        ),
        variables=tuple((name, tuple(map(_value, values))) for name, values in tree["variables"]),
        outputs=tuple(tree["outputs"]),
        axes=tree["axes"],
        method=tree["method"],
        level=tree["level"],
        level_db=tree["level_db"],
        strengths=_strengths(tree["strengths"]),
        limits=models.decode(tree["limits"], (Limits,), Address(("limits",))),
    )


def chunks(numbers: Iterable[int]) -> Iterator[tuple[int, ...]]:
    """Numbers of stimuli in their order, those that are measured together in one piece."""
    for _, chunk in groupby(numbers, lambda number: (number - 1) // BATCH_SIZE):
        yield tuple(chunk)


def _tree_of(strengths: Strengths) -> Tree:
    return {
        "points": [list(point) for point in strengths.points],
        "reference": list(strengths.reference),
    }


def _strengths(tree: Tree) -> Strengths | None:
    if tree is None:
        return None
    points = tuple((place, hertz, level_db) for place, hertz, level_db in tree["points"])
    place, hertz = tree["reference"]
    return Strengths(points, (place, hertz))


def _value(tree: Tree) -> Value:
    return tuple(tree) if isinstance(tree, list) else tree
