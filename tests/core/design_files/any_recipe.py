"""Any recipe that fits its fields, for Hypothesis to choose: designs, views, whole files."""

import dataclasses
from dataclasses import replace
from functools import cache
from math import isfinite

from hypothesis import reject
from hypothesis import strategies as st

from skinsource import Actuation, Design, Input
from skinsource.base.conventions import LIMB_NAMES
from skinsource.base.errors import InvalidInputError
from skinsource.specs import numbers as number_specs
from skinsource.specs import spec as specs
from skinsource.specs.breakpoints import SEGMENTS, BreakpointsSpec
from skinsource.specs.models import specs_of
from skinsource.specs.samples import Samples


def numbers(spec: number_specs.NumberSpec) -> st.SearchStrategy:
    if spec.whole:
        return st.integers(int(spec.minimum), int(spec.maximum))
    least, most = (x if isfinite(x) else None for x in (spec.minimum, spec.maximum))
    return st.floats(least, most, allow_nan=False, allow_infinity=False)


def texts(spec: specs.TextSpec) -> st.SearchStrategy:
    if spec.reader is not None:
        return st.sampled_from(["sin(2*pi*90*t)", "t < 0.1", "noise(3)·hann()", "\t1 - t "])
    characters = st.characters(exclude_categories=["Cs", "Cc", "Zl", "Zp"])
    return st.text(characters, max_size=min(spec.longest, 30))


def ranges(spec: number_specs.RangeSpec) -> st.SearchStrategy:
    end = st.floats(spec.minimum, spec.maximum, allow_nan=False)
    return st.none() | st.tuples(end, end).filter(lambda ends: ends[0] < ends[1])


def signals(spec: number_specs.SamplesSpec) -> st.SearchStrategy:
    held = st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=5)  # layers multiply them
    rates = st.floats(1e-3, 1e9)
    units = st.sampled_from(["", "m/s²"]) if spec.unit is None else st.just(spec.unit)
    return st.builds(Samples, values=held, sample_rate_hz=rates, unit=units)


def curves(spec: number_specs.CurveSpec) -> st.SearchStrategy:
    points = st.tuples(numbers(spec.x), numbers(spec.y))
    return st.lists(points, max_size=5).map(lambda drawn: tuple(sorted(drawn)))


PANELS = st.dictionaries(
    st.text("abc", min_size=1, max_size=4),
    st.dictionaries(
        st.text("xyz_", min_size=1, max_size=4),
        st.none()
        | st.booleans()
        | st.integers(-9, 9)
        | st.floats(allow_nan=False, allow_infinity=False)
        | st.text("ä b", max_size=5)
        | st.tuples(st.floats(-1, 1), st.integers(0, 3)),
        max_size=3,
    ).map(lambda held: tuple(sorted(held.items()))),
    max_size=3,
).map(lambda panels: tuple(sorted(panels.items())))


def any_of(spec: number_specs.ModelSpec) -> st.SearchStrategy:
    kinds = spec.kinds()
    # Clips hold waveforms, of which one kind holds clips.
    later = [st.deferred(lambda kind=kind: recipes(kind)) for kind in kinds]
    return st.one_of(later) if kinds else st.nothing()


def most(spec: number_specs.ListSpec) -> int:
    """Parts of the longest list that is tried; none of kinds of which there are none."""
    empty = isinstance(spec.of, number_specs.ModelSpec) and not spec.of.kinds()
    return 0 if empty else min(spec.most, 3)


def values(spec: specs.Spec) -> st.SearchStrategy:
    """Any value that fits."""
    return specs.made_for(
        spec,
        {
            number_specs.NumberSpec: numbers,
            specs.ChoiceSpec: lambda spec: st.sampled_from([option for option, _ in spec.options]),
            specs.SwitchSpec: lambda _: st.booleans(),
            specs.TextSpec: texts,
            number_specs.RangeSpec: ranges,
            number_specs.CurveSpec: curves,
            specs.BytesSpec: lambda _: st.binary(max_size=300),
            specs.PlainSpec: lambda _: PANELS,
            number_specs.ListSpec: lambda spec: st.lists(
                values(spec.of), min_size=spec.fewest, max_size=most(spec), unique=spec.different
            ).map(tuple),
            number_specs.OptionalSpec: lambda spec: st.none() | values(spec.of),
            number_specs.SamplesSpec: signals,
            number_specs.PointsSpec: lambda spec: st.lists(
                st.tuples(*map(values, spec.columns)), min_size=spec.fewest, max_size=6
            ).map(lambda points: tuple(sorted(points))),
            BreakpointsSpec: lambda spec: st.lists(
                st.tuples(values(spec.x), values(spec.y), st.sampled_from(SEGMENTS)),
                min_size=1,
                max_size=6,
            ).map(lambda points: tuple(sorted(points))),
            number_specs.ModelSpec: any_of,
        },
    )(spec)


@cache
def recipes(kind: type) -> st.SearchStrategy:
    if kind is Design:
        own = {name: values(spec) for name, spec in specs_of(Design).items() if name != "inputs"}
        inputs = st.lists(recipes(Input), max_size=3, unique_by=lambda track: track.id).map(alone)
        limbs = st.sampled_from(LIMB_NAMES)
        return st.builds(Design, **{**own, "inputs": inputs, "limb": limbs})
    parts = {name: values(spec) for name, spec in specs_of(kind).items()}
    return st.fixed_dictionaries(parts).map(lambda given: made(kind, given))


def alone(inputs: list[Input]) -> tuple[Input, ...]:
    """The inputs, with clips that no other one has."""
    return tuple(
        replace(track, clips=tuple(replace(clip, id=0) for clip in track.clips)) for track in inputs
    )


def made(kind: type, given: dict):
    """A recipe; one of defaults where these values, each for itself allowed, do not go together."""
    needed = {
        field.name
        for field in dataclasses.fields(kind)
        if field.default is field.default_factory is dataclasses.MISSING
    }
    few = {name: value for name, value in given.items() if name in needed}
    if kind is Actuation:  # one for each place, and one at least
        few["actuators"] = few["actuators"][:1]
    for values_of_fields in (given, few):
        try:
            return kind(**values_of_fields)
        except InvalidInputError:
            continue
    return reject()
