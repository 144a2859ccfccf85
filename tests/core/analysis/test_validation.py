"""Predictions against measurements, and the checks of linearity, against made-up truths."""

import numpy as np
import pytest

from skinsource.base.conventions import BAND_HZ
from skinsource.base.errors import InvalidInputError, RecordingError
from skinsource.signals.resampling import resample
from skinsource.studies.checking import agreement, aligned, open_recorded, proportion

RNG = np.random.default_rng(21)
FIELD = RNG.normal(size=(6, 3, 400)) * RNG.uniform(0.5, 2.0, (6, 3, 1))


def test_a_field_agrees_with_itself_whatever_its_strength():
    result = agreement(FIELD, 7.0 * FIELD, 0.0)
    assert result.counted.all()
    assert result.error == pytest.approx(np.zeros((6, 3)), abs=1e-12)
    assert result.amplitude_percent == pytest.approx(np.zeros((6, 3)), abs=1e-9)
    assert result.correlation == pytest.approx(np.ones((6, 3)))


def test_each_figure_is_its_definition():
    other = FIELD + 0.5 * RNG.normal(size=FIELD.shape)
    result = agreement(FIELD, other, 0.0)
    p = FIELD / np.mean([np.sqrt(np.mean(signals**2)) for signals in FIELD.reshape(18, -1)])
    m = other / np.mean([np.sqrt(np.mean(signals**2)) for signals in other.reshape(18, -1)])
    a, b = p[4, 1], m[4, 1]
    assert result.error[4, 1] == pytest.approx(np.mean(np.abs(a - b)))
    rms = [np.sqrt(np.mean(field**2)) for field in (a, b)]
    assert result.amplitude_percent[4, 1] == pytest.approx(100 * abs(rms[0] - rms[1]) / rms[1])
    assert result.correlation[4, 1] == pytest.approx(np.corrcoef(a, b)[0, 1])
    assert result.medians[2] == pytest.approx(np.median(result.correlation))


def test_channels_below_twice_the_noise_do_not_count():
    rms = np.sqrt(np.mean(FIELD**2, axis=-1))
    noise = rms / 2.0
    noise[2, 0] *= 1.01
    result = agreement(FIELD, FIELD, noise * (1 - 1e-12))
    assert np.argwhere(~result.counted).tolist() == [[2, 0]]
    assert np.isnan(result.error[2, 0])
    assert not agreement(FIELD, FIELD, 1e9).counted.any()
    assert np.isnan(agreement(FIELD, FIELD, 1e9).medians).all()


@pytest.mark.parametrize("lag", [-67, 0, 40])
def test_a_shifted_measurement_is_brought_back(lag):
    pulse = np.zeros((2, 1, 500))
    pulse[..., 200:260] = np.hanning(60) * [[[1.0]], [[0.3]]]
    late = np.roll(pulse, -lag, axis=-1)[..., :450]
    field, shift = aligned(late, pulse, 100)
    assert shift == lag
    assert field == pytest.approx(pulse, abs=1e-12)


def test_the_adjusted_share_is_that_of_its_formula():
    levels = np.array([1.0, 2.0, 3.0, 4.0])
    heights = np.array([1.0, 2.2, 2.7, 4.1])
    tone = np.sin(2 * np.pi * 100.0 * np.arange(1300) / 1300.0)
    fit = proportion(levels, heights[:, None, None] * tone, 1300.0, BAND_HZ)
    k = int(np.argmin(np.abs(fit.frequency_hz - 100.0)))
    r2 = np.corrcoef(levels, heights)[0, 1] ** 2
    assert fit.adjusted_r2[0, k] == pytest.approx(1 - (1 - r2) * 3 / 2)


def write_csv(path, time_s):
    table = np.column_stack([time_s, FIELD.reshape(18, -1).T])
    head = ",".join(["time_s", *(f"s{k}" for k in range(18))])
    np.savetxt(path, table, delimiter=",", header=head, comments="", fmt="%.12g")


@pytest.mark.parametrize("n_times", [5, 18, 400])
@pytest.mark.parametrize("turned", [False, True])
def test_an_array_of_two_dimensions_has_as_many_channels_as_the_limb_however_many_times(
    tmp_path, n_times, turned
):
    path, field = tmp_path / "field.npz", FIELD[..., :n_times]
    table = field.reshape(18, -1).T
    if turned and n_times == 18:
        return  # a square is times by channels
    np.savez(path, field=table.T if turned else table, time_s=np.arange(n_times) / 650.0)
    assert open_recorded(path, 6, 3, 650.0) == pytest.approx(field)
    with pytest.raises(RecordingError, match="expected 21 of one length"):
        open_recorded(path, 7, 3, 650.0)


@pytest.mark.parametrize("order", ["toa", "oat", "aot"])
def test_an_array_of_three_dimensions_is_read_in_any_order_with_the_rate_of_its_file(
    tmp_path, order
):
    path = tmp_path / "field.npz"
    np.savez(path, field=FIELD.transpose(["oat".index(axis) for axis in order]), fs=2600.0)
    assert open_recorded(path, 6, 3, 2600.0) == pytest.approx(FIELD)
    assert open_recorded(path, 6, 3, 1300.0) == pytest.approx(resample(FIELD, 2600, 1300))


def test_the_rate_is_that_of_the_file_of_its_times_or_else_the_one_given(tmp_path):
    time = np.arange(400) / 650.0
    expected = resample(FIELD, 650, 1300)
    stamped, plain = tmp_path / "stamped.csv", tmp_path / "plain.npz"
    write_csv(stamped, time)
    np.savez(plain, field=FIELD.reshape(18, -1).T)
    assert open_recorded(stamped, 6, 3, 1300.0, rate_hz=99.0) == pytest.approx(expected)
    assert open_recorded(plain, 6, 3, 1300.0, rate_hz=650.0) == pytest.approx(expected)
    assert open_recorded(plain, 6, 3, 1300.0) == pytest.approx(FIELD)
    write_csv(stamped, np.where(time < time[100], time, time + 0.01))
    with pytest.raises(RecordingError, match="not steady"):
        open_recorded(stamped, 6, 3, 1300.0)


def test_rates_that_are_no_whole_number_and_shapes_that_differ_are_refused(tmp_path):
    path = tmp_path / "field.npz"
    np.savez(path, field=FIELD.reshape(18, -1).T, fs=2000.5)
    with pytest.raises(RecordingError, match=r"2000\.5 Hz, expected a whole number"):
        open_recorded(path, 6, 3, 1300.0)
    np.savez(path, field=np.ones((40, 5, 3)), fs=1300.0)
    with pytest.raises(RecordingError, match="40 × 5 × 3, expected times × 6 outputs × 3 axes"):
        open_recorded(path, 6, 3, 1300.0)
    np.savez(path, field=np.ones((40, 5)), fs=1300.0)
    with pytest.raises(RecordingError, match=r"5 signals, expected 6 .* outputs by axes\.$"):
        open_recorded(path, 6, 1, 1300.0)
    np.savez(path, field=np.where(FIELD > 1.0, np.nan, FIELD), fs=1300.0)
    with pytest.raises(RecordingError, match="not finite numbers"):
        open_recorded(path, 6, 3, 1300.0)
    with pytest.raises(InvalidInputError, match="silent"):
        agreement(FIELD, 0.0 * FIELD, 0.0)
