"""Which stimuli a sweep consists of."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from hashlib import sha256
from itertools import groupby

from skinsource import codec
from skinsource.actuators import Limits
from skinsource.arguments import one_of
from skinsource.codec.text import from_text, to_text
from skinsource.design import Design
from skinsource.errors import InvalidInputError
from skinsource.fields import Address, Tree
from skinsource.matching import Strengths
from skinsource.projection import Axes, Method
from skinsource.quoting import quoted
from skinsource.sweeps.levels import LEVELS, PREDICTED, Level, equally_strong
from skinsource.sweeps.variables import ACTUATOR, Value, varied
from skinsource.view import View

MOST_STIMULI = 1_000_000
#: Neighbours that are measured together: what they have in common is computed once for them.
TOGETHER = 16
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
        ``"above_threshold"``: brought to ``level_db``, see `skinsource.sweeps.Measurer.measure`;
        ``"matched"``: as strong as people found them, by ``strengths``.  None: what ``level_db``
        and ``strengths`` ask for: the loudest 100 ms, matched, or the drive.
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
        first = number - (number - 1) % TOGETHER
        return range(first, min(first + TOGETHER, len(self) + 1))

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
            one, other = self.design_of(1), self.design_of(2)
        except InvalidInputError:
            return everything
        if one.limb != other.limb or one.scaling != other.scaling or one.ids != other.ids:
            return everything
        pairs = zip(one.inputs, other.inputs, strict=True)
        return frozenset(after.id for before, after in pairs if before != after)

    @property
    def digest(self) -> str:
        """What tells this plan from others, hexadecimal."""
        return sha256(self.text.encode()).hexdigest()

    @property
    def text(self) -> str:
        """All of it, for `plan_of`."""
        tree: Tree = {
            "designs": [[name, codec.encode(design)] for name, design in self.designs],
            "variables": [[name, list(values)] for name, values in self.variables],
            "outputs": list(self.outputs),
            "axes": self.axes,
            "method": self.method,
            "level": self.level,
            "level_db": self.level_db,
            "strengths": None if self.strengths is None else _tree_of(self.strengths),
            "limits": codec.encode(self.limits),
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
            (name, codec.decode(content, (Design,), Address(("designs", name))))
            for name, content in tree["designs"]
        ),
        variables=tuple((name, tuple(map(_value, values))) for name, values in tree["variables"]),
        outputs=tuple(tree["outputs"]),
        axes=tree["axes"],
        method=tree["method"],
        level=tree["level"],
        level_db=tree["level_db"],
        strengths=_strengths(tree["strengths"]),
        limits=codec.decode(tree["limits"], (Limits,), Address(("limits",))),
    )


def chunks(numbers: Iterable[int]) -> Iterator[tuple[int, ...]]:
    """Numbers of stimuli in their order, those that are measured together in one piece."""
    for _, chunk in groupby(numbers, lambda number: (number - 1) // TOGETHER):
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


def _value(found: Tree) -> Value:
    return tuple(found) if isinstance(found, list) else found
