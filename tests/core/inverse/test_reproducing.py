"""Wanted waveforms: the least of the cost, exact and fast, within a peak; movements."""

from dataclasses import replace

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.drives_in_time import Cost

TARGET = 30
BURST = ss.sinusoid(100.0, 0.05, window_name="hanning")
#: Few, so that dense matrices of the same problem are small.
FEW = {"quiet": [9, 20], "inputs": [7, 12, 13], "length_s": 0.08}


@pytest.fixture(scope="module")
def problem():
    """A cost with random responses, (5 rows, 3 inputs, 40 taps), and the wanted rows."""
    rng = np.random.default_rng(2)
    taps = rng.normal(size=(5, 3, 40)) * np.exp(-np.arange(40) / 8.0)
    wanted = np.zeros((5, 99))
    wanted[0, 30:60] = np.hanning(30) * np.sin(np.arange(30))
    n_fft, n_times, load = 99, 60, 0.3
    rows = np.moveaxis(scipy.fft.rfft(taps, n_fft), 2, 0)
    cost = Cost(
        normal=rows.conj().swapaxes(1, 2) @ rows + load * np.eye(3), n_fft=n_fft, n_times=n_times
    )
    b = np.einsum("fri,rf->fi", rows.conj(), scipy.fft.rfft(wanted))
    columns = [
        scipy.linalg.convolution_matrix(taps[row, place], n_times)
        for row in range(5)
        for place in range(3)
    ]
    dense = np.block([columns[3 * row : 3 * row + 3] for row in range(5)])
    least = np.linalg.solve(dense.T @ dense + load * np.eye(180), dense.T @ wanted.ravel())
    return cost, b, least.reshape(3, 60), (dense, wanted.ravel(), load)


def cost_of(drives, dense, wanted, load):
    return np.square(dense @ drives.ravel() - wanted).sum() + load * np.square(drives).sum()


def test_the_fast_drives_cost_little_more(problem):
    cost, b, least, dense = problem
    assert cost_of(least, *dense) <= cost_of(cost.fast(b), *dense) < 1.1 * cost_of(least, *dense)


def test_what_is_wanted_later_is_driven_later(problem):
    cost, b, *_ = problem
    whole = replace(cost, n_times=cost.n_fft)
    turn = np.exp(-2j * np.pi * np.arange(len(b)) * 7 / cost.n_fft)
    np.testing.assert_allclose(
        whole.fast(b * turn[:, None]), np.roll(whole.fast(b), 7, axis=1), atol=1e-12
    )


def test_a_loose_peak_changes_nothing(problem):
    cost, b, least, _ = problem
    peak = 1.01 * np.abs(least).max()
    found = cost.within(peak, cost.cut(b), np.zeros_like(least))
    np.testing.assert_allclose(found, least, atol=1e-5 * peak)


def response(limb, found, output, axis=2):
    drives = [row for row in found.waveforms if row.any()]
    places = np.flatnonzero(found.waveforms.any(axis=1)) + 1
    return ss.predict(limb, drives, places, scaling="relative")[output - 1, axis]


@pytest.mark.parametrize("exact", [True, False])
def test_the_error_is_that_of_the_prediction(limb, exact):
    found = ss.inverse.reproduce(limb, {TARGET: BURST}, quiet=[9], exact=exact)
    seen = response(limb, found, TARGET)
    wanted = np.zeros_like(seen)
    first = round(found.delay_s * limb.sample_rate_hz)
    wanted[first : first + BURST.size] = BURST
    error_db = 10 * np.log10(np.square(seen - wanted).sum() / np.square(BURST).sum())
    np.testing.assert_allclose(found.nmse_db[TARGET], error_db, atol=0.05)
    assert error_db < -15.0


def test_the_event_lies_in_the_middle_behind_the_delay_of_the_responses(limb):
    found = ss.inverse.reproduce(limb, {TARGET: BURST}, **FEW)
    assert round(found.delay_s * 1300.0, 9) == 67 + (104 - 65) // 2
    assert found.waveforms.shape == (20, 104)


def test_silence_needs_no_drive(limb):
    found = ss.inverse.reproduce(limb, {TARGET: np.zeros(50)}, **FEW)
    assert not found.waveforms.any()
    assert np.isnan(found.nmse_db[TARGET])


def test_the_field_of_known_drives_returns_them(limb):
    rng = np.random.default_rng(4)
    known = np.zeros((20, 200))
    rate_hz, band_hz = 1300.0, np.fft.rfftfreq(200, 1 / 1300.0)
    spectra = scipy.fft.rfft(rng.normal(size=(3, 200)))
    spectra[:, (band_hz < 60.0) | (band_hz > 300.0)] = 0.0
    known[[6, 11, 12]] = scipy.fft.irfft(spectra) * np.hanning(200)
    field = ss.predict(limb, known, range(1, 21), scaling="relative")[:42, 2]
    # What lies before the delay is cut off: there is nothing.
    first = int(limb.pre_trigger_delay_s * rate_hz)
    wanted = {output: field[output - 1, first:] for output in range(1, 43)}
    n_times = field.shape[1] - first
    found = ss.inverse.reproduce(
        limb, wanted, quiet=[], inputs=[7, 12, 13], length_s=n_times / rate_hz, beta=1e-6
    )
    error = found.waveforms[:, :200] - known
    assert np.square(error).sum() < 1e-4 * np.square(known).sum()


def test_a_peak_is_kept(limb):
    free = ss.inverse.reproduce(limb, {TARGET: BURST}, quiet=[9])
    peak = 0.5 * np.abs(free.waveforms).max()
    found = ss.inverse.reproduce(limb, {TARGET: BURST}, quiet=[9], peak=peak)
    assert np.abs(found.waveforms).max() == peak
    assert found.nmse_db[TARGET] > free.nmse_db[TARGET]


def test_three_axes_are_wanted_along_the_direction_of_most_energy(limb):
    found = ss.inverse.reproduce(limb, {5: BURST}, axes="xyz", quiet=[9])
    taps = limb.impulse_responses[5:, 4]
    direction = np.linalg.eigh(np.einsum("iat,ibt->ab", taps, taps)).eigenvectors[:, -1]
    along = direction @ np.array([response(limb, found, 5, axis) for axis in range(3)])
    first = round(found.delay_s * limb.sample_rate_hz)
    reached = along[first : first + BURST.size] @ BURST / (BURST @ BURST)
    np.testing.assert_allclose(abs(reached), 1.0, rtol=0.05)
    assert found.nmse_db[5] < -20.0


def test_one_wanted_output_counts_as_much_as_all_that_are_quiet(limb):
    assert ss.inverse.reproduce(limb, {TARGET: BURST}).nmse_db[TARGET] < -20.0


def test_a_design_plays_the_drives_25_ms_later(limb):
    found = ss.inverse.reproduce(limb, {TARGET: BURST}, quiet=[9])
    design = found.design()
    assert design.scaling == "probe"
    assert [track.location for track in design.inputs] == [*range(6, 21)]
    drives = [track.clips[0].waveform.samples.values for track in design.inputs]
    places = [track.location for track in design.inputs]
    seen = ss.predict(limb, drives, places)[TARGET - 1, 2]
    meant = response(limb, found, TARGET)
    np.testing.assert_allclose(seen[32 : 32 + meant.size], meant, atol=2e-3 * np.abs(meant).max())


def test_a_move_has_its_energy_where_it_should_be(limb):
    moved = ss.inverse.move(limb, [33, 30, 28], 0.2, 100.0)
    length_mm = np.hypot(*(limb.output_positions_mm[27] - limb.output_positions_mm[32]))
    assert moved.centroid_error_mm < 0.2 * length_mm
    back = ss.inverse.move(limb, [28, 30, 33], 0.2, 100.0)
    assert not np.allclose(back.waveforms, moved.waveforms)


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        ({"wanted": {}}, "wanted names no output"),
        ({"wanted": {TARGET: np.ones(500)}}, "Make length_s longer"),
        ({"wanted": {TARGET: []}}, r"shape \(0,\)"),
        ({"wanted": {TARGET: [np.nan]}}, "finite"),
        ({"quiet": [TARGET]}, "strong and quiet"),
        ({"peak": 0.0}, "peak is 0"),
        ({"beta": -1.0}, "beta is -1"),
    ],
)
def test_what_cannot_be_reproduced_is_refused(limb, changes, match):
    with pytest.raises(InvalidInputError, match=match):
        ss.inverse.reproduce(limb, **{"wanted": {TARGET: BURST}, **changes})


@pytest.mark.parametrize("path", [[30], [30, 28, 30], [30, 61], [30, 73]])
def test_what_is_no_path_is_refused(limb, path):
    with pytest.raises(InvalidInputError, match="path is"):
        ss.inverse.move(limb, path, 0.2, 100.0)
