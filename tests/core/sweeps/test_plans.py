"""Which stimuli a sweep consists of, and in which order they are presented."""

import pickle
from collections import Counter
from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.studies.sweeps.plan import Order, Plan, trials, varied


def design(*locations):
    tones = (ss.track(location, ss.waveforms.Tone(frequency_hz=100.0)) for location in locations)
    return ss.Design(limb="synthetic-1", inputs=tuple(tones))


def test_a_field_of_waveforms_is_set_in_every_input_that_has_it():
    mixed = ss.Design(
        limb="synthetic-1",
        inputs=(ss.track(1, ss.waveforms.Tap()), ss.track(2, ss.waveforms.Tone())),
    )
    varied_design = varied(mixed, "frequency_hz", 320.0)
    assert varied_design.inputs[0] == mixed.inputs[0]
    assert varied_design.inputs[1].clips[0].waveform.frequency_hz == 320.0


def test_a_number_before_the_name_means_one_input_alone():
    varied_design = varied(design(3, 7), "2.frequency_hz", 320.0)
    assert [track.clips[0].waveform.frequency_hz for track in varied_design.inputs] == [
        100.0,
        320.0,
    ]
    assert varied(design(3, 7), "1.location", 12).inputs[0].location == 12


def test_design_inputs_and_clips_are_varied():
    varied_design = varied(varied(design(3, 7), "limb", "synthetic-2"), "scaling", "relative")
    assert (varied_design.limb, varied_design.scaling) == ("synthetic-2", "relative")
    assert [track.amplitude for track in varied(design(3, 7), "amplitude", 2.0).inputs] == [
        2.0,
        2.0,
    ]
    onsets = [track.clips[0].onset_s for track in varied(design(3), "onset_s", 0.3).inputs]
    assert onsets == [0.3]
    assert [track.location for track in varied(design(3, 7), "location", (5, 9)).inputs] == [5, 9]


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("colour_of_sky", 1.0, "nothing in the design"),
        ("3.frequency_hz", 1.0, "expected 1 to 2"),
        ("0.frequency_hz", 1.0, "names input"),
        ("x.frequency_hz", 1.0, "names input"),
        ("frequency_hz", "loud", "frequency_hz"),
        ("location", (1, 2, 3), "each of the 2 inputs"),
        ("amplitude", 1e9, "amplitude"),
        ("scaling", "loud", "scaling"),
    ],
)
def test_what_cannot_be_varied_is_refused(name, value, message):
    with pytest.raises(InvalidInputError, match=message):
        varied(design(3, 7), name, value)


def test_a_plan_is_all_combinations_and_the_last_variable_varies_first():
    plan = Plan(
        designs=(("a", design(3)), ("b", design(7))),
        variables=(("frequency_hz", (50.0, 80.0)), ("amplitude", (1.0, 2.0, 3.0))),
    )
    assert len(plan) == 12
    assert plan.names == ("design", "frequency_hz", "amplitude")
    rows = [tuple(plan.values_of(number).values()) for number in range(1, 13)]
    assert rows == [
        (name, frequency, amplitude)
        for name in "ab"
        for frequency in (50.0, 80.0)
        for amplitude in (1.0, 2.0, 3.0)
    ]
    made = plan.design_of(8)
    assert made.inputs[0].location == 7
    assert made.inputs[0].amplitude == 2.0
    assert made.inputs[0].clips[0].waveform.frequency_hz == 50.0


def test_a_plan_reaches_other_processes_as_it_is():
    drawn = ss.waveforms.Drawn(ss.waveforms.Noise(seed=1, duration_s=0.1).samples(1300.0))
    inputs = (ss.track(3, drawn), ss.track(7))
    plan = Plan(
        designs=(("a", ss.Design(limb="synthetic-1", inputs=inputs)),),
        variables=(("location", ((1, 2), (3, 4))), ("amplitude", (0.1, 1)), ("muted", (False,))),
        outputs=(3, 19),
        level_db=-3.0,
    )
    again = pickle.loads(pickle.dumps(plan))  # noqa: S301  our own
    assert again == plan
    assert again.digest == plan.digest
    assert replace(plan, level_db=-2.0).digest != plan.digest


@pytest.mark.parametrize("level_db", [-3, np.float32(-3.0)])
def test_a_level_that_is_written_in_another_way_makes_the_same_plan(level_db):
    plan = Plan(designs=(("a", design(3)),), level_db=-3.0)
    assert replace(plan, level_db=level_db).digest == plan.digest


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"designs": ()}, "no design"),
        ({"variables": (("amplitude", ()),)}, "no values"),
        ({"variables": (("amplitude", (1.0,)), ("amplitude", (2.0,)))}, "named twice"),
        ({"variables": tuple((f"x{k}", tuple(range(100))) for k in range(4))}, "at most 1000000"),
        ({"outputs": (3, 3)}, "outputs"),
        ({"axes": "w"}, "axes"),
    ],
)
def test_a_plan_that_cannot_be_is_refused(changes, message):
    with pytest.raises(InvalidInputError, match=message):
        Plan(**({"designs": (("a", design(3)),)} | changes))


def test_the_inputs_that_neighbours_differ_in_are_known_from_the_plan():
    both = (("a", design(3, 7)),)

    def varying(*variables):
        return Plan(designs=both, variables=variables).varying

    assert varying(("amplitude", (1.0, 2.0)), ("2.amplitude", (1.0, 2.0))) == {2}
    assert varying(("amplitude", (1.0, 2.0))) == {1, 2}
    assert varying(("limb", ("synthetic-1", "synthetic-2"))) == {1, 2}
    assert varying() == {1, 2}


def test_random_blocks_hold_every_stimulus_once_and_follow_the_seed():
    def sequences(seed):
        presented = trials(Order(kind="random", seed=seed, participants=2, blocks=3), (2, 3, 5, 8))
        blocks = [presented[k : k + 4] for k in range(0, 24, 4)]
        numbers = [(each.participant, each.block, each.trial) for each in presented]
        assert numbers == list(product((1, 2), (1, 2, 3), (1, 2, 3, 4)))
        return [tuple(each.stimulus for each in block) for block in blocks]

    assert all(sorted(sequence) == [2, 3, 5, 8] for sequence in sequences(5))
    assert sequences(5) == sequences(5) != sequences(6)
    assert len(set(sequences(5))) > 2


@pytest.mark.parametrize("n", [4, 5, 8])
def test_counterbalanced_blocks_balance_places_and_what_comes_before(n):
    participants = n if n % 2 == 0 else 2 * n
    order = Order(kind="counterbalanced", seed=11, participants=participants)
    presentations = trials(order, range(1, n + 1))
    sequences = np.array([presentation.stimulus for presentation in presentations]).reshape(
        participants, n
    )
    for place in sequences.T:
        assert set(Counter(place.tolist()).values()) == {participants // n}
    pairs = Counter(pair for row in sequences.tolist() for pair in pairwise(row))
    assert len(pairs) == n * (n - 1)
    assert set(pairs.values()) == {participants // n}


@pytest.mark.parametrize("changes", [{"kind": "odd"}, {"seed": -1}, {"blocks": 0}])
def test_an_order_that_cannot_be_is_refused(changes):
    with pytest.raises(InvalidInputError):
        Order(**changes)
