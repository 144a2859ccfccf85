"""From the numbers of a file, of three axes too, to what a waveform plays."""

from dataclasses import replace

import numpy as np
import pytest
import soundfile
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import skinsource as ss
from skinsource.base.errors import InvalidInputError, RecordingError, Stopped
from skinsource.design.recordings import ImportChoice, look, suggested, take, taken
from skinsource.readers.reader import Found, Series, dft321, other_axes
from tests.core.recordings.conftest import write_wav

KEEP = ImportChoice(series="0", rate_hz=1300.0, scale="keep", remove_offset=False)


def values_of(choice, raw, **more):
    return taken(np.asarray(raw), choice, 1300.0, **more).samples


@pytest.mark.parametrize(
    ("unit", "factor", "becomes"),
    [
        ("full scale", 1.0, ""), ("m/s²", 1.0, "m/s²"), ("g", 9.80665, "m/s²"), ("N", 1.0, "N"),
        ("V", 1.0, "V"),
    ],
)  # fmt: skip
def test_units_that_are_only_factors(unit, factor, becomes):
    raw = np.array([0.5, -1.0, 0.25])
    values = values_of(replace(KEEP, unit=unit), raw)
    np.testing.assert_array_equal(values.values, raw * factor)
    assert values.unit == becomes


@pytest.mark.parametrize(("unit", "power"), [("mm/s", 1), ("µm", 2)])
def test_velocities_and_displacements_become_accelerations(unit, power):
    time = np.arange(5200) / 1300.0
    raw = 3.0 * np.sin(2.0 * np.pi * 200.0 * time)
    values = values_of(replace(KEEP, unit=unit), raw)
    si = 3e-3 if unit == "mm/s" else 3e-6
    # Some whole number of periods in the middle: the root of the mean square of a sine.
    middle = values.values[1300:3900]
    expected = si * (2.0 * np.pi * 200.0) ** power / np.sqrt(2.0)
    assert np.sqrt(np.mean(middle**2)) == pytest.approx(expected, rel=1e-4)
    assert values.unit == "m/s²"
    notes = taken(raw, replace(KEEP, unit=unit), 1300.0).notes
    assert any("from 25 Hz on" in note for note in notes)


def test_the_offset_goes_when_it_is_unwanted():
    raw = np.array([3.0, 5.0, 4.0])
    np.testing.assert_array_equal(values_of(KEEP, raw).values, raw)
    whole = taken(raw, replace(KEEP, remove_offset=True), 1300.0)
    np.testing.assert_array_equal(whole.samples.values, [-1.0, 1.0, 0.0])
    assert "An offset of 4 " in whole.notes[0]


def test_missing_numbers_are_refused_or_zero():
    raw = np.array([1.0, np.nan, 3.0, np.inf])
    with pytest.raises(InvalidInputError, match=r"2 of 4 numbers .* the first is number 2 "):
        values_of(KEEP, raw)
    whole = taken(raw, replace(KEEP, missing="zero"), 1300.0)
    np.testing.assert_array_equal(whole.samples.values, [1.0, 0.0, 3.0, 0.0])
    assert "2 missing numbers" in whole.notes[0]


def test_stamps_give_the_rate_and_are_made_steady():
    steady = np.arange(2600) / 2600.0
    raw = np.sin(2.0 * np.pi * 100.0 * steady)
    choice = replace(KEEP, rate_hz=None)
    values = values_of(choice, raw, stamps_s=steady)
    np.testing.assert_array_equal(values.values, ss.resample(raw, 2600, 1300))
    uneven = steady + 0.2 / 2600.0 * np.sin(np.arange(2600) * 1.7)
    values = taken(np.sin(2 * np.pi * 100.0 * uneven), choice, 1300.0, stamps_s=uneven)
    assert "not steady" in values.notes[0]
    expected = np.sin(2.0 * np.pi * 100.0 * (uneven[0] + np.arange(1300) / 1300.0))
    assert np.abs(values.samples.values[100:1200] - expected[100:1200]).max() < 1e-3


def test_a_part_of_a_file_is_taken_and_named(tmp_path, signal, process):
    path = tmp_path / "a.wav"
    write_wav(path, [signal, -signal], 1300)
    choice = replace(KEEP, series="1", rate_hz=None, start_s=0.1, duration_s=0.5)
    converted = take(path, choice, process=process)
    np.testing.assert_array_equal(converted.samples.values, -signal[130:780])
    assert (converted.name, converted.from_hz) == ("a.wav, channel 2", 1300.0)
    assert look(path).rate_hz == 1300.0


def test_a_part_between_stamps_is_taken(files, signal, process):
    choice = suggested(process.look(files["text"]))
    assert (choice.time, choice.unit, choice.rate_hz) == ("0", "g", None)
    choice = replace(choice, start_s=0.25, duration_s=0.25, scale="keep", remove_offset=False)
    converted = take(files["text"], choice, 2000.0, process=process)
    np.testing.assert_array_equal(converted.samples.values, signal[500:1000] * 9.80665)
    assert converted.name == "a.csv"


def test_what_has_a_physical_unit_keeps_its_size_unless_told_otherwise(
    tmp_path, files, signal, process
):
    expected = (signal - signal.mean()) * 9.80665
    samples = take(files["text"], to_hz=2000.0, process=process).samples
    np.testing.assert_allclose(samples.values, expected, rtol=1e-12, atol=1e-12)
    assert (samples.unit, samples.peak) == ("m/s²", pytest.approx(np.abs(expected).max()))
    # Full scale of a sound is no size.
    write_wav(tmp_path / "a.wav", [0.25 * signal], 2000)
    assert take(tmp_path / "a.wav", to_hz=2000.0, process=process).samples.peak == 1.0
    assert ImportChoice(series="0", unit="g").scale == "peak"


def test_taking_can_be_stopped_and_tells_how_far_it_is(tmp_path, process):
    path = tmp_path / "long.wav"
    soundfile.write(path, np.zeros(2_000_000), 48_000)
    progress = []
    take(
        path,
        replace(KEEP, rate_hz=None),
        process=process,
        progress=lambda done, total, text: progress.append((done, total, text)),
    )
    assert progress[-1] == (2_000_000, 2_000_000, "Reading long.wav")
    assert len(progress) > 5
    with pytest.raises(Stopped):
        take(path, KEEP, process=process, stop=lambda: len(progress) > 3)
    assert process.look(path).rate_hz == 48_000


def test_what_is_taken_stays_in_the_design(tmp_path, process):
    path = tmp_path / "a.wav"
    tone = np.sin(np.arange(2_400_000) * 0.02)
    soundfile.write(path, np.stack([tone, tone], axis=1), 4000)
    # As long as it may be.
    recording = take(path, process=process).waveform
    assert recording.duration_s == 600.0
    inputs = (ss.track(7, recording), ss.track(13, recording))
    design = ss.Design(limb="synthetic-1", inputs=inputs)
    ss.save_design(tmp_path / "a.skinsource", design)
    path.unlink()
    back = ss.open_design(tmp_path / "a.skinsource").design
    assert back == design
    waveform = back.inputs[1].clips[0].waveform
    assert waveform.samples.digest == recording.samples.digest
    assert (waveform.name, waveform.source_rate_hz) == ("a.wav, channel 1", 4000.0)
    # It is stored once.
    assert (tmp_path / "a.skinsource").stat().st_size < 1.1 * recording.samples.values.nbytes


WORDS = "(DFT321, Landin et al. 2010)"


def test_axes_in_step_become_the_length_of_their_vector():
    wave = np.cos(2 * np.pi * 5 * np.arange(200) / 200 + 0.3)
    together = dft321(np.stack([2.0 * wave, 3.0 * wave, 6.0 * wave]))
    np.testing.assert_allclose(together, 7.0 * wave, rtol=0, atol=1e-12)


@given(
    axes=arrays(np.float64, st.tuples(st.just(3), st.integers(1, 40)), elements=st.floats(-9, 9))
)
def test_no_energy_is_lost_and_no_axis_comes_first(axes):
    together = dft321(axes)
    assert np.sum(together**2) == pytest.approx(np.sum(axes**2), rel=1e-9, abs=1e-12)
    reversed_energy = np.sum(dft321(axes[::-1]) ** 2)
    assert reversed_energy == pytest.approx(np.sum(together**2), rel=1e-9, abs=1e-12)


def file_with(*names, n=100, **more):
    series = [
        Series(key=str(k), name=name, n_samples=n, dtype="f8", **more)
        for k, name in enumerate(names)
    ]
    return Found(format="CSV", series=tuple(series))


@pytest.mark.parametrize(
    ("names", "first", "expected"),
    [
        (("acc_x", "acc_y", "acc_z", "gyr_x", "gyr_y", "gyr_z"), 1, "02"),
        (("acc_x", "acc_y", "acc_z", "gyr_x", "gyr_y", "gyr_z"), 3, "45"),
        (("force", "X", "Y", "Z"), 3, "12"),
        (("channel 1", "channel 2", "channel 3"), 0, "12"),
        (("channel 1", "channel 2"), 0, ""),
        (("force", "x", "y", "z"), 0, ""),
        (("x", "x", "y", "z"), 0, ""),
        (("max", "a", "b"), 0, "12"),
    ],
)
def test_axes_that_belong_together_are_found_by_name_or_number(names, first, expected):
    file = file_with(*names)
    others = other_axes(file, file.series[first])
    assert "".join(series.key for series in others) == expected


def test_three_columns_of_a_file_are_taken_as_one(tmp_path, process):
    rng = np.random.default_rng(7)
    axes = rng.normal(size=(3, 400)) + np.array([[0.0], [1.0], [9.81]])
    rows = "\n".join(",".join(f"{x:.17g}" for x in row) for row in axes.T)
    (tmp_path / "a.csv").write_text(f"ax [m/s^2],ay [m/s^2],az [m/s^2]\n{rows}\n")
    file = process.look(tmp_path / "a.csv")
    others = tuple(axis.key for axis in other_axes(file, file.series[0]))
    assert others == ("1", "2")
    choice = replace(suggested(file), rate_hz=1300.0, scale="keep", others=others)
    whole = take(tmp_path / "a.csv", choice, process=process)
    expected = dft321(axes - axes.mean(axis=1, keepdims=True))
    np.testing.assert_allclose(whole.samples.values, expected, rtol=0, atol=1e-12)
    assert whole.name == "a.csv, ax, ay, az"
    assert whole.samples.unit == "m/s²"
    assert any(note.endswith(f"{WORDS}.") for note in whole.notes)
    assert sum("offset" in note for note in whole.notes) == 3
    with pytest.raises(RecordingError, match="no signal 'gone'"):
        take(tmp_path / "a.csv", replace(choice, others=("1", "gone")), process=process)
