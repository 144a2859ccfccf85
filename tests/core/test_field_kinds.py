"""Every kind of field checks what it is given, and comes back from a tree."""

from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.specs import breakpoints, fields, numbers
from skinsource.specs import spec as specs
from skinsource.specs.breakpoints import Breakpoint, BreakpointsSpec
from skinsource.specs.models import decode, encode, specs_of
from skinsource.specs.samples import Samples
from tests.core.design_files.any_recipe import recipes
from tests.core.frozen.read_frozen import models

#: The public ones; how far each field may go is frozen.
MODELS = models()
UNIT = numbers.NumberSpec(label="Part", minimum=0.0, maximum=1.0)
WHOLE = numbers.NumberSpec(label="Count", minimum=1, maximum=72, whole=True)
SOUND = Samples(values=np.arange(5.0), sample_rate_hz=1300.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Leaf:
    size: float = fields.number(0.5, UNIT)

    def __post_init__(self):
        fields.check(self)


def kinds() -> tuple[type, ...]:
    return (Leaf, Branch)


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    KINDS: ClassVar[int] = 2

    name: str = fields.field(specs.TextSpec(label="Name", longest=9))
    parts: tuple[Any, ...] = fields.field(
        numbers.ListSpec(label="Parts", of=numbers.ModelSpec(label="Part", kinds=kinds)), default=()
    )

    def __post_init__(self):
        fields.check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Everything:
    count: int = fields.number(4, WHOLE)
    size: float = fields.number(0.25, UNIT)
    shape: str = fields.choice(
        "a", specs.ChoiceSpec(label="Shape", options=(("a", "A"), ("b", "B")))
    )
    loud: bool = fields.switch(False, specs.SwitchSpec(label="Loud"))
    title: str = fields.field(specs.TextSpec(label="Title", longest=5, one_line=True), default="")
    notes: str = fields.field(specs.TextSpec(label="Notes", longest=50), default="")
    ends: numbers.Range | None = fields.interval(
        None, numbers.RangeSpec(label="Ends", minimum=0.0, maximum=1.0)
    )
    envelope: tuple[tuple[float, float], ...] = fields.field(
        numbers.CurveSpec(label="Envelope", x=UNIT, y=numbers.NumberSpec(label="Gain")),
        default=((0.0, 1.0), (1.0, 0.0)),
    )
    course: tuple[tuple[float, ...], ...] = fields.field(
        numbers.PointsSpec(label="Course", columns=(UNIT, UNIT, WHOLE), most=3),
        default=((0.0, 1.0, 1), (1.0, 0.0, 1)),
    )
    drawn: tuple[Breakpoint, ...] = fields.field(
        BreakpointsSpec(label="Drawn", x=UNIT, y=UNIT, most=3), default=((0.0, 1.0, "held"),)
    )
    outputs: tuple[int, ...] = fields.field(
        numbers.ListSpec(label="Outputs", of=WHOLE, most=3, different=True), default=()
    )
    inner: Any = fields.field(numbers.ModelSpec(label="Inner", kinds=kinds), default=Leaf())
    sound: Samples | None = fields.field(
        numbers.OptionalSpec(label="Sound", of=numbers.SamplesSpec(label="Sound", most=10)),
        default=None,
    )
    state: bytes = fields.field(specs.BytesSpec(label="State", longest=9), default=b"")
    other: Any = fields.field(specs.PlainSpec(label="Other"), default=())

    def __post_init__(self):
        fields.check(self)


FULL = Everything(
    count=72,
    size=0.0,
    shape="b",
    loud=True,
    title="Größe",
    notes="eins\nzwei\t三",
    ends=(0.25, 1.0),
    envelope=((0.0, -1.0), (0.5, 1e300), (0.5, -0.0)),
    course=((0.0, 0.5, 1), (0.5, 1.0, 2), (0.5, 0.25, 3)),
    drawn=((0.0, 0.5, "smooth"), (0.5, -0.0, "straight"), (0.5, 1.0, "held")),
    outputs=(3, 1, 2),
    inner=Branch(name="all", parts=(Leaf(), Branch(name="", parts=(Leaf(size=1.0),)))),
    sound=SOUND,
    state=b"\0\xff",
    other=(("skin", (("shown", True), ("range", (None, -1.5, 3)))),),
)


@pytest.mark.parametrize("recipe", [Everything(), FULL], ids=["defaults", "full"])
def test_every_kind_of_field_comes_back_from_its_tree(recipe):
    decoded = decode(encode(recipe), (Everything,), specs.Address())
    assert decoded == recipe
    assert repr(decoded) == repr(recipe)  # -0.0 and 0.0, 1 and 1.0 are different here


def test_the_sample_covers_every_kind_of_field():
    used = {type(spec) for spec in specs_of(Everything).values()}
    used |= {spec.of.__class__ for spec in specs_of(Everything).values() if "of" in dir(spec)}
    named = {**vars(breakpoints), **vars(numbers), **vars(specs)}
    leaves = {kind for kind in named.values() if isinstance(kind, type)}
    assert used == {kind for kind in leaves if issubclass(kind, specs.Spec)} - {specs.Spec}


WRONG = {
    "drawn": [(), ((0.0,),), ((0.0, 1.0, "wavy"),), ((0.5, 1.0), (0.0, 1.0)), "ab", 3],
    "count": [0, 1.5, True, "1", None],
    "size": [-1e-7, 1.1, np.nan, np.inf, True, "1", None, 1j, [1.0], 10**400],
    "shape": ["A", "", None, 1],
    "loud": [0, 1, "yes", None],
    "title": ["too long", "a\nb", 5, None, "\ud800"],
    "notes": ["x" * 51, None],
    "ends": [(1.0, 0.0), (0.5, 0.5), (0.0,), (0.0, 2.0), [0.0], 3.0, (0.0, np.nan)],
    "envelope": [
        (),
        ((0.0, 1.0),),
        ((0.5, 1.0), (0.0, 1.0)),
        ((0.0,), (1.0,)),
        ((0.0, np.inf),) * 2,
    ],
    "course": [
        (),
        ((0.0, 1.0, 1),),
        ((0.0, 1.0, 1),) * 4,
        ((0.0, 1.0), (1.0, 1.0)),
        ((0.5, 1.0, 1), (0.0, 1.0, 1)),
        ((0.0, 1.5, 1), (1.0, 1.0, 1)),
        ((0.0, 1.0, 1.5), (1.0, 1.0, 1)),
        [[0.0, 1.0], [1.0, 1.0, 1]],
    ],
    "outputs": [(1, 1), (1, 2, 3, 4), (0,), [0], (1.5,), None],
    "inner": [None, {}, Everything, FULL, 3],
    "sound": [
        np.arange(5.0),
        Samples(values=np.arange(11.0), sample_rate_hz=1300.0),
        Samples(values=np.arange(3.0), sample_rate_hz=1300.0, unit="m/s²"),
    ],
    "state": [b"x" * 10, "text", None, bytearray(1)],
    "other": [
        "\ud800",
        [{}],
        {},
        np.inf,
        object(),
        (np.float64("nan"),),
        ("x" * 10_001,),
        ((0,) * 10_001,),
    ],
}


@pytest.mark.parametrize("name", WRONG)
def test_what_does_not_fit_is_refused_with_the_name_and_what_was_expected(name):
    for value in WRONG[name]:
        with pytest.raises(InvalidInputError, match=rf"Everything\.{name} is .*, expected "):
            Everything(**{name: value})


@pytest.mark.parametrize("kind", MODELS.values(), ids=MODELS)
@settings(max_examples=2, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_every_field_of_every_model_refuses_what_does_not_fit_by_its_name(kind, data):
    model = data.draw(recipes(kind))
    for name in specs_of(kind):
        with pytest.raises(InvalidInputError, match=rf"{kind.__name__}\.{name} is .*, expected "):
            replace(model, **{name: object()})


def test_what_is_kept_has_one_form():
    recipe = Everything(
        size=np.float32(0.5), loud=np.True_, outputs=(np.int64(3), 2.0), ends=(0, np.float64(1))
    )
    assert repr(recipe) == repr(Everything(size=0.5, loud=True, outputs=(3, 2), ends=(0.0, 1.0)))


def test_an_older_tree_lacks_new_fields_which_take_their_defaults():
    tree = encode(FULL)
    del tree["sound"], tree["inner"]
    decoded = decode(tree, (Everything,), specs.Address())
    assert (decoded.sound, decoded.inner, decoded.outputs) == (None, Leaf(), (3, 1, 2))


@pytest.mark.parametrize("name", specs_of(Everything))
@pytest.mark.parametrize("tree", [{}, [[]], [{}], "\x1b", -1e9, [None], [1, [2, "x"]], SOUND])
def test_a_tree_of_another_form_is_refused_or_fits(name, tree):
    try:
        decoded = decode({"kind": "Everything", name: tree}, (Everything,), specs.Address())
    except FileFormatError as error:
        decoded, message = None, str(error)
    if decoded is None:
        assert len(message) < 500
    else:
        assert encode(decoded)[name] == tree


def test_a_kind_of_field_is_never_taken_for_another():
    table = {numbers.NumberSpec: "number", specs.Spec: "anything"}
    assert specs.made_for(UNIT, table) == "number"
    assert specs.made_for(specs.TextSpec(label="Name", longest=9), table) == "anything"
    with pytest.raises(TypeError, match="TextSpec of 'Name'"):
        specs.made_for(specs.TextSpec(label="Name", longest=9), {numbers.NumberSpec: 1})


def test_a_default_is_checked_as_any_value_and_kept_in_the_same_form():
    @dataclass(frozen=True, slots=True, kw_only=True)
    class Careless:
        size: float = fields.number(1, numbers.NumberSpec(label="Size", minimum=0.0))
        count: float = fields.number(-1.0, numbers.NumberSpec(label="Count", minimum=0.0))

        def __post_init__(self):
            fields.check(self)

    for _ in range(2):
        made = Careless(count=2.0)
        assert (made.size, type(made.size)) == (1.0, float)
        with pytest.raises(InvalidInputError, match=r"Careless\.count is -1.0"):
            Careless()
