"""Calibrating a person, tried on the stand-in and on a sound card that is made up."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.prediction import Limits
from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.lab.calibrating import CardStation, Sitting, StandIn, calibrate
from skinsource.lab.playing.devices import Output
from skinsource.people.partial_file import digest_of
from tests.core.rig_measuring.bench_top import COIL, RATE_HZ, Card, ears, sensed, use
from tests.core.rig_measuring.two_cards import TwoCards

INPUTS = (8, 12, 16, 20)
SITTING = Sitting(
    person="p07", like="synthetic-1", output=9, contact="8 mm², 0.5 N", posture="palm"
)
N_FFT = 1024
HZ = np.fft.rfftfreq(N_FFT, 1.0 / 1300.0)


def stand_in(**changes):
    return StandIn(inputs=INPUTS, **changes)


class Listening:
    """A station that remembers what was played on it."""

    def __init__(self, station):
        self.station, self.mixes = station, []

    def __getattr__(self, name):
        return getattr(self.station, name)

    def record(self, mix, stop, report):
        self.mixes.append(mix)
        return self.station.record(mix, stop, report)


def error_db(found, station, band_hz=(50.0, 300.0)):
    """Energy of the difference from the person's own row, as the rig moves it, over the row's."""
    within = (band_hz[0] <= HZ) & (band_hz[1] >= HZ)
    hz = HZ[within]
    measured = np.fft.rfft([row.response for row in found.rows], N_FFT)[:, within]
    limb = station.limb
    own = [limb.response_to(place)[found.sitting.output - 1, 2] for place in INPUTS]
    gains, late_s = np.array([station.errors[place] for place in INPUTS]).T
    late_s = late_s + 0.0123 - found.latency_s
    row = np.fft.rfft(own, N_FFT)[:, within] * gains[:, None]
    row *= np.exp(-2j * np.pi * hz * late_s[:, None])
    return 20.0 * np.log10(np.linalg.norm(measured - row) / np.linalg.norm(row))


@pytest.fixture(scope="module")
def calibrated():
    station = stand_in()
    return calibrate(SITTING, station), station


def test_the_row_is_that_of_the_person_as_the_rig_moves_it(calibrated):
    found, station = calibrated
    assert found.accepted
    # What is left is no noise: responses are cut off after 522 samples, and below 20 Hz.
    assert error_db(found, station) < -38.0
    assert error_db(found, station, (25.0, 400.0)) < -32.0
    assert found.noise_m_per_s2 == pytest.approx(0.01, rel=0.02)
    gains, delays_s = np.array([*station.errors.values()]).T
    assert 1.0 < np.abs(20.0 * np.log10(gains)).max() < 3.0
    assert 2e-5 < np.abs(delays_s).max() < 1e-4


def test_noise_that_is_accepted_costs_little(calibrated):
    noisy = stand_in(noise_m_per_s2=0.03)
    found = calibrate(SITTING, noisy)
    assert found.accepted
    assert error_db(found, noisy) < error_db(*calibrated) + 0.5
    assert min(row.coherent for row in found.rows) < 1.0


def test_a_delay_that_the_rig_knows_of_is_no_part_of_the_row(calibrated):
    station = stand_in()
    first, *rest = station.rig.channels
    station.__dict__["rig"] = ss.rigs.Rig(channels=(replace(first, delay_s=0.003), *rest))
    gain, late_s = station.errors[8]
    station.errors[8] = gain, late_s + 0.003
    found = calibrate(SITTING, station)
    for row, known in zip(found.rows, calibrated[0].rows, strict=True):
        np.testing.assert_allclose(row.response, known.response, atol=0.003)


def test_the_same_seed_gives_the_same_numbers(calibrated):
    again, other = (calibrate(SITTING, stand_in(seed=seed)) for seed in (0, 1))
    assert digest_of(again.partial) == digest_of(calibrated[0].partial)
    assert digest_of(other.partial) != digest_of(again.partial)


def test_it_is_a_partial_limb_of_the_person_with_all_that_was_noted(calibrated, tmp_path):
    partial = calibrated[0].partial
    ss.people.save_partial(tmp_path / "p07.h5", partial)
    read = ss.people.open_partial(tmp_path / "p07.h5")
    assert digest_of(read) == digest_of(partial)
    assert (read.person, read.posture, read.mounting) == ("p07", "palm", "8 mm², 0.5 N")
    assert (read.outputs, read.inputs) == ((9,), INPUTS)
    assert len(read.dates) == 1
    assert not read.responses[:, :, :2].any()


def test_what_goes_wrong_is_named_and_measured_again_alone():
    station = Listening(stand_in(faults={8: "clips", 12: "off", 16: "late"}))
    heard = []
    found = calibrate(SITTING, station, heard=heard.append)
    assert [row.place for row in heard] == [*INPUTS]
    texts = {place: " ".join(sentences) for place, sentences in found.failures.items()}
    assert [*texts] == [8, 12, 16]
    assert "clips" in texts[8]
    assert "Check the actuator" in texts[12]
    assert "2.00 ms apart" in texts[16]
    assert not found.accepted
    assert found.partial.inputs == (20,)
    station.mixes.clear()
    found = calibrate(SITTING, station, before=found)
    # The silence, the three, and the one that was accepted before.
    played = [mix.names[-1] for mix in station.mixes]
    assert played == ["Silence", "Place 8", "Place 12", "Place 16", "Place 20 again"]
    assert found.accepted
    assert error_db(found, station) < -38.0


def test_a_sensor_that_slips_is_noticed_and_all_is_measured_again():
    station = stand_in(faults={20: "moves"})
    found = calibrate(SITTING, station)
    assert station.output != 9
    assert "Place 8 had changed" in found.moved
    with pytest.raises(InvalidInputError, match="has moved"):
        _ = found.partial
    station.output, heard = 9, []
    found = calibrate(SITTING, station, before=found, heard=heard.append)
    assert len(heard) == len(INPUTS)
    assert found.accepted


@pytest.mark.parametrize(
    ("gain_db", "late_s", "noticed"),
    [
        (0.5, 0.0, False),
        (1.5, 0.0, True),
        (-1.5, 0.0, True),
        (0.0, 5e-5, False),
        (0.0, 1.5e-4, True),
    ],
)
def test_what_changes_until_the_repeats_is_noticed_too(gain_db, late_s, noticed):
    station = stand_in(faults={12: "off"})
    found = calibrate(SITTING, station)
    gain, before_s = station.errors[8]
    station.errors[8] = gain * 10.0 ** (gain_db / 20.0), before_s + late_s
    assert bool(calibrate(SITTING, station, before=found).moved) == noticed


def test_the_contact_moves_between_5_and_10_mm_per_s_and_never_above_20(calibrated):
    station = Listening(stand_in())
    calibrate(replace(SITTING, inputs=(8,)), station)
    samples = station.mixes[1].samples[0]
    hz = np.fft.rfftfreq(samples.size, 1.0 / station.sample_rate_hz)[1:]
    moved = np.fft.rfft(4.0 * samples)[1:] * COIL.response(hz) / (2j * np.pi * hz)
    speed = np.abs(np.fft.irfft([0.0, *moved], samples.size))
    # The first sweep, all along, but for its faded ends.
    parts = speed[2800 + 800 : 2800 + 18400].reshape(-1, 800)
    assert parts.max(axis=1) == pytest.approx(7e-3, rel=0.05)
    assert speed.max() < 7.5e-3
    # It begins without a step, and nothing drifts.
    assert np.abs(np.diff(samples[:1700])).max() < 1e-3 * samples.max()
    spectrum = np.abs(np.fft.rfft(samples[1600 : 1600 + 24000]))
    assert spectrum[:27].max() < 1e-5 * spectrum.max()


def test_nothing_is_played_where_the_motion_is_not_known_or_a_limit_would_be_passed():
    channels = stand_in().rig.channels
    unknown = replace(channels[2], measured=None)
    limited = replace(channels[2], limits=Limits(peak_voltage_v=1e-3))
    unheard = replace(channels[2], full_scale_v=None)
    weak = replace(channels[2], full_scale_v=1e-3)
    cases = (
        (unknown, "no measured response"),
        (limited, "peak voltage"),
        (unheard, "volts at full scale"),
        (weak, "place 16: full scale"),
    )
    for channel, message in cases:
        station = Listening(stand_in())
        station.rig = replace(station.station.rig, channels=(*channels[:2], channel))
        with pytest.raises(InvalidInputError, match=message):
            calibrate(replace(SITTING, inputs=(8, 12, 16)), station)
        assert not station.mixes


@pytest.mark.parametrize("after", [0, 1, 3])
def test_stop_answers_at_once(after):
    station = Listening(stand_in())
    with pytest.raises(Stopped):
        calibrate(SITTING, station, stop=lambda: len(station.mixes) > after)
    assert len(station.mixes) == after + 1


def test_progress_ends_with_all_that_is_played():
    seen = []
    calibrate(SITTING, stand_in(), progress=lambda *step: seen.append(step))
    assert [step[2] for step in seen] == [
        "Silence",
        *(f"Place {p}" for p in INPUTS),
        "Place 8 again",
    ]
    assert seen[-1][0] == seen[-1][1]


def card_station(*others):
    (channel, *_) = stand_in().rig.channels
    rig = ss.rigs.Rig(channels=(replace(channel, device="", output=3), *others))
    setup = ss.rig_measuring.MeasuringSetup(sensitivity_v_per_m_per_s2=0.01, input_full_scale_v=2.0)
    return CardStation(rig=rig, setup=setup, output=Output(sample_rate_hz=RATE_HZ))


def test_a_sound_card_measures_a_skin_that_only_weakens(monkeypatch):
    # The skin moves at 0.1 of the contact.
    card = use(monkeypatch, Card(ears(lambda hz: 0.1 * sensed(COIL, 4.0)(hz))))
    found = calibrate(SITTING, card_station())
    assert found.accepted
    (row,) = found.rows
    within = (HZ > 60.0) & (HZ < 300.0)
    gain = np.abs(np.fft.rfft(row.response, N_FFT))[within]
    pulse = 22.9e-3 * 1300.0 * np.sinc(1e-3 * HZ[within])
    np.testing.assert_allclose(gain, 0.1 * pulse, rtol=0.02)
    assert 68 <= np.abs(row.response).argmax() <= 72
    played = np.abs(np.concatenate([stream.samples for stream in card.streams], axis=1)).max(axis=1)
    assert played[2] > 0.0
    assert not played[:2].any()


def test_two_devices_are_refused(monkeypatch):
    cards = use(monkeypatch, TwoCards(ears(sensed(COIL))))
    with pytest.raises(InvalidInputError, match="must be on one device"):
        calibrate(SITTING, card_station())
    assert not cards.streams
    use(monkeypatch, Card(ears(sensed(COIL))))
    other = ss.rigs.RigChannel(place=12, device="Bench card")
    with pytest.raises(InvalidInputError, match="must be on one device"):
        calibrate(replace(SITTING, inputs=(8,)), card_station(other))
