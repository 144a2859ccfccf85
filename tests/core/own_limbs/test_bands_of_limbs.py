"""In which band a lab measured: said or not, everything asks the limb."""

from dataclasses import replace

import h5py
import numpy as np
import pytest

import skinsource as ss
from skinsource import Design, View, edits, stimulus_of, track
from skinsource.actuators.equalising import followed_band
from skinsource.base.errors import InvalidInputError, RecordingError
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import Evaluator
from skinsource.limbs.limb_import import LimbSource, import_limb
from skinsource.limbs.limb_layout import export_limb
from skinsource.limbs.own_limbs import facts_of
from tests.core.own_limbs.lab_bench import installed, own_limb
from tests.core.own_limbs.mutants import whole_file

BAND = (40.0, 1500.0)
# Half of what plays lies at 1 kHz: outside of the published band, inside of this one.
PLAYED = Design(
    limb="lab-1",
    inputs=(
        track(1, Tone(frequency_hz=100.0, duration_s=0.2)),
        track(2, Tone(frequency_hz=1000.0, duration_s=0.2)),
    ),
)


def lamp(design, name="band"):
    findings = Evaluator().evaluate(design, ("validity",))["validity"]
    return next(finding for finding in findings if finding.name == name)


def test_the_band_is_kept_exported_and_part_of_the_digest(user_data, tmp_path):
    installed()
    silent = facts_of("lab-1").digest
    assert facts_of("lab-1").band_hz is None
    assert ss.load_limb("lab-1").band_hz is None
    installed(band_hz=BAND)
    facts = facts_of("lab-1")
    assert facts.band_hz == ss.load_limb("lab-1").band_hz == BAND
    assert facts.digest != silent
    assert facts.sentence.endswith("4000 Hz, measured from 40 to 1500 Hz.")
    export_limb("lab-1", tmp_path / "lab.h5")
    again = import_limb(LimbSource(responses=tmp_path / "lab.h5", values={"name": "copy"}))
    assert (again.band_hz, again.digest) == (BAND, facts.digest)


@pytest.mark.parametrize("band", [(600.0, 25.0), (0.0, 2001.0), (-1.0, 5.0), (5.0,), (np.nan, 9.0)])
def test_a_band_that_is_none_is_refused(band):
    with pytest.raises(InvalidInputError, match="band_hz"):
        own_limb(band_hz=band)
    assert own_limb(band_hz=(0, 2000)).band_hz == (0.0, 2000.0)


def test_a_file_that_says_a_band_wrongly_is_refused_by_name(user_data, tmp_path):
    path = whole_file(tmp_path / "bad.h5")
    with h5py.File(path, "r+") as file:
        file.attrs["band_hz"] = "all"
    with pytest.raises(RecordingError, match="'band_hz' is 'all', expected two frequencies"):
        import_limb(LimbSource(responses=path))


def test_what_plays_is_judged_mended_drawn_and_written_in_the_band_of_the_limb(user_data):
    installed(band_hz=BAND)
    assert lamp(PLAYED).state == "kept"
    low = PLAYED.with_clip(PLAYED.inputs[0].clips[0].id, waveform=Tone(frequency_hz=10.0))
    assert lamp(low).state == "left"
    assert "40 to 1500 Hz" in lamp(low).sentence
    (limit,) = edits.mend(low, View(), lamp(low)).design.inputs[0].clips[0].effects
    assert (limit.low_hz, limit.high_hz) == BAND
    bound = edits.bound_clip(low, View(), low.inputs[0].clips[0].id, 4000.0)
    assert bound.design.inputs[0].clips[0].effects == (limit,)
    assert stimulus_of(PLAYED).band_hz == BAND
    # Its outputs stand elsewhere than those of the published limbs.
    assert lamp(PLAYED, "spacing").state == "unknown"
    published = Design(limb="synthetic-1", inputs=PLAYED.inputs[:1])
    assert lamp(published, "spacing").state == "kept"
    installed()
    assert lamp(low).state == "unknown"
    refused = edits.bound_clip(low, View(), low.inputs[0].clips[0].id, 4000.0)
    assert "is unknown; import it with its band" in refused.sentence
    assert stimulus_of(PLAYED).band_hz == (0.0, pytest.approx(2000.0 * 12 / 13))
    # At a higher rate there is no more to follow.
    for rate_hz, top_hz in ((None, 2000.0), (48_000, 2000.0), (1000, 500.0)):
        played = stimulus_of(PLAYED, rate_hz)
        lower_hz = min(played.sample_rate_hz, played.own_rate_hz)
        assert followed_band(played.limb_band_hz, lower_hz) == (
            25.0,
            pytest.approx(top_hz * 12 / 13),
        )


def test_a_velocity_is_told_from_where_the_limb_was_measured(user_data):
    # 3 m/s² at 10 Hz are 48 mm/s.
    slow = Tone(frequency_hz=10.0, duration_s=1.0)
    design = Design(limb="lab-1", inputs=(track(1, slow, amplitude=3.0),), scaling="probe")
    for band, lowest_hz in (((5.0, 1500.0), 5), (None, 25), ((0.0, 1500.0), 25), ((0.1, 9.0), 1)):
        installed(band_hz=band, per_unit_drive=False)
        finding = lamp(design, "drive")
        assert f"from {lowest_hz} Hz on" in finding.sentence
        assert (finding.state == "left") == (lowest_hz < 10), band
        fastest = ss.evaluate(design, "fastest_probe_m_per_s")["fastest_probe_m_per_s"]
        assert f"velocity {1e3 * fastest:.3g} mm/s" in finding.sentence
    assert finding.factor == pytest.approx(0.04 / (3.0 / (2.0 * np.pi * 10.0)), rel=0.1)


@pytest.mark.parametrize(
    ("band", "followed"),
    [(BAND, BAND), (None, (25.0, 12 / 13 * 2000.0)), ((0.0, 50.0), (25.0, 50.0))],
)
def test_actuators_follow_drives_in_the_band_of_the_limb(user_data, band, followed):
    installed(band_hz=band)
    limb, coil = ss.load_limb("lab-1"), ss.actuators.load("example-voice-coil")
    for equaliser in (None, ss.equalising.RegularisedInverse(40.0)):
        through = ss.Actuation(
            actuators=(ss.ActuatorAt(place=None, actuator="coil", model=coil),), equaliser=equaliser
        )
        design = replace(PLAYED, scaling="probe", actuation=through)
        evaluated = Evaluator().evaluate(design, ("driven_limb",))["driven_limb"]
        shown_hz = np.array([followed[0], 30.0, 100.0, 1000.0, 1500.0, 1840.0])
        shown_hz = shown_hz[(shown_hz >= followed[0]) & (shown_hz <= followed[1])]
        taps, plain = evaluated.response_to(1)[4, 0], limb.response_to(1)[4, 0]
        later = np.arange(taps.size) - evaluated.lead_samples
        gain = spectrum_at(taps, later, shown_hz) / spectrum_at(plain, np.arange(90), shown_hz)
        # The equaliser makes the contactor do what is asked; without it the coil answers.
        expected = np.ones(shown_hz.size) if equaliser else coil.response(shown_hz)
        np.testing.assert_allclose(
            np.abs(gain), np.abs(expected) * abs(gain[0] / expected[0]), rtol=0.02
        )


def spectrum_at(samples, later, frequency_hz):
    return np.exp(-2j * np.pi * frequency_hz[:, None] * later / 4000.0) @ samples
