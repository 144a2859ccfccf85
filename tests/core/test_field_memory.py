import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from skinsource.design import Input
from skinsource.field_memory import FieldMemory
from skinsource.limb import Limb, LimbMap
from skinsource.response import SCALINGS, predict
from skinsource.waveforms import Noise, Tap, Tone

RATE_HZ = 1300.0
FIELD_BYTES = 72 * 3 * (130 + 521) * 8


def made_up_response(place: int) -> np.ndarray:
    return np.random.default_rng(place).standard_normal((72, 3, 522))


def made_up_limb(name: str = "made-up") -> Limb:
    nowhere = LimbMap(
        outline=np.zeros((3, 2)),
        output_positions=np.zeros((72, 2)),
        input_positions=np.zeros((20, 2)),
        hand_length_px=1.0,
    )
    return Limb(
        name=name,
        hand_length_mm=175.0,
        synthetic=True,
        map=nowhere,
        read_response=made_up_response,
    )


def inputs_of_100_ms(count: int) -> tuple[Input, ...]:
    return tuple(
        Input(location=1 + k % 20, waveform=Tone(frequency_hz=50.0 + k, duration_s=0.1))
        for k in range(count)
    )


def drives_of(inputs: tuple[Input, ...], n_times: int = 130) -> np.ndarray:
    drives = np.zeros((len(inputs), n_times))
    for row, one in zip(drives, inputs, strict=True):
        samples = one.waveform.samples(RATE_HZ)
        row[: samples.size] = samples
    return drives


def fields_of(memory, limb, inputs, scaling="upstream", n_times=130):
    return memory.unit_fields(limb, inputs, drives_of(inputs, n_times), scaling)


@pytest.mark.parametrize("scaling", SCALINGS)
def test_a_field_and_its_gain_make_the_prediction_bit_for_bit(scaling):
    limb, inputs = made_up_limb(), inputs_of_100_ms(3)
    for _ in range(2):
        for one, field in zip(inputs, fields_of(FieldMemory(), limb, inputs, scaling), strict=True):
            expected = predict(limb, drives_of((one,)), one.location, 1.25, scaling)
            np.testing.assert_array_equal(field.acceleration * (1.25 * field.gain), expected)


def test_the_same_field_is_computed_once_and_handed_out_again():
    memory, limb, inputs = FieldMemory(), made_up_limb(), inputs_of_100_ms(4)
    first = fields_of(memory, limb, inputs)
    second = fields_of(memory, limb, inputs)
    assert memory.fields_computed == 4
    assert all(one is other for one, other in zip(first, second, strict=True))


def test_amplitude_muting_solo_and_colour_need_no_new_field():
    memory, limb, inputs = FieldMemory(), made_up_limb(), inputs_of_100_ms(4)
    fields_of(memory, limb, inputs)
    changed = tuple(replace(one, amplitude=-3.0, solo=True, colour=9) for one in inputs)
    fields_of(memory, limb, changed)
    fields_of(memory, limb, changed[1:])
    fields_of(memory, limb, changed[::-1])
    assert memory.fields_computed == 4


@pytest.mark.parametrize(
    "changes",
    [
        {"location": 20},
        {"waveform": Tone(frequency_hz=51.0, duration_s=0.1)},
        {"waveform": Noise(duration_s=0.1)},
        {"waveform": Tap()},
        {"onset_s": 0.001},
    ],
)
def test_a_change_of_one_of_four_inputs_needs_one_new_field(changes):
    memory, limb, inputs = FieldMemory(), made_up_limb(), inputs_of_100_ms(4)
    fields_of(memory, limb, inputs)
    fields_of(memory, limb, (replace(inputs[0], **changes), *inputs[1:]))
    assert memory.fields_computed == 5


def test_limb_length_and_scaling_tell_fields_apart():
    memory, inputs = FieldMemory(), inputs_of_100_ms(1)
    fields_of(memory, made_up_limb("one"), inputs)
    fields_of(memory, made_up_limb("other"), inputs)
    fields_of(memory, made_up_limb("one"), inputs, n_times=131)
    for scaling in SCALINGS:
        fields_of(memory, made_up_limb("one"), inputs, scaling)
    assert memory.fields_computed == 5


def test_fields_cannot_be_written_to():
    (field,) = fields_of(FieldMemory(), made_up_limb(), inputs_of_100_ms(1))
    with pytest.raises(ValueError, match="read-only"):
        field.acceleration[0, 0, 0] = 1.0


def test_no_more_is_held_than_the_budget_allows_and_the_oldest_goes_first():
    memory, limb, inputs = FieldMemory(3 * FIELD_BYTES), made_up_limb(), inputs_of_100_ms(4)
    for one in (*inputs[:3], inputs[0], inputs[3]):
        fields_of(memory, limb, (one,))
    assert memory.fields_computed == 4
    for kept in (inputs[0], inputs[2], inputs[3]):
        fields_of(memory, limb, (kept,))
    assert memory.fields_computed == 4
    fields_of(memory, limb, (inputs[1],))
    assert memory.fields_computed == 5


def test_memory_stays_bounded_over_many_edits():
    memory, limb = FieldMemory(4 * FIELD_BYTES), made_up_limb()
    limb.response_to(1)
    tracemalloc.start()
    try:
        for k in range(60):
            tone = Tone(frequency_hz=100.0 + k, duration_s=0.1)
            fields_of(memory, limb, (Input(location=1, waveform=tone),))
        held, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert memory.fields_computed == 60
    assert held < 5 * FIELD_BYTES


def test_a_budget_too_small_for_one_field_changes_nothing_in_what_comes_out():
    limb, inputs = made_up_limb(), inputs_of_100_ms(2)
    forgetful, memory = FieldMemory(0), FieldMemory()
    for _ in range(2):
        for one, other in zip(
            fields_of(forgetful, limb, inputs), fields_of(memory, limb, inputs), strict=True
        ):
            np.testing.assert_array_equal(one.acceleration, other.acceleration)
            assert one.gain == other.gain
    assert forgetful.fields_computed == 4
    assert memory.fields_computed == 2
