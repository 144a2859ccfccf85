"""Exports for a rig or an actuator: volts, polarity, calibration, limits, and their words."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators import Limits, MeasuredResponse
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from skinsource.base.errors import InvalidInputError, NotConfirmedError, Stopped
from skinsource.cli.command_line import main
from skinsource.engine import stimulus
from tests.core.exporting.export_bench import actuation, read, sidecar

RATE_HZ = 8000
#: As strong at all frequencies: 50 and 20 m/s² for each volt.
FLAT = MeasuredResponse(((1.0, 50.0, 0.0), (2000.0, 50.0, 0.0)))
WEAKER = MeasuredResponse(((1.0, 20.0, 0.0), (2000.0, 20.0, 0.0)))


@pytest.fixture
def design():
    """Bursts that leave no velocity."""
    bursts = [ss.waveforms.Gabor(frequency_hz=hz, cycles=8.0) for hz in (120.0, 200.0)]
    return ss.Design(
        limb="synthetic-1",
        inputs=(
            ss.track(7, bursts[0], onset_s=0.1, amplitude=2.0),
            ss.track(12, bursts[1], onset_s=0.15, amplitude=3.0),
        ),
    )


@pytest.fixture
def rig():
    return Rig(
        title="Bench 3",
        channels=(
            RigChannel(
                place=7, actuator="own", output=3, full_scale_v=2.0, measured=FLAT,
                measured_on="2026-03-04",
            ),
            RigChannel(
                place=12, actuator="own", output=1, full_scale_v=1.0, amplifier_gain=4.0,
                polarity="inverted", measured=WEAKER, measured_on="2026-03-01",
            ),
        ),
    )  # fmt: skip


def test_with_one_it_says_what_is_wired_and_when_it_was_measured(design, rig, path):
    ss.export_stimulus(design, path, rate_hz=RATE_HZ, rig=rig)
    about = sidecar(path)
    assert about["calibration"] == "calibrated, measured on 2026-03-01"
    assert about["rig"] == "Bench 3"
    assert [channel["output"] for channel in about["channels"]] == [3, 1]
    assert [channel["polarity"] for channel in about["channels"]] == ["normal", "inverted"]
    assert about["unit"] == "m/s²"


def test_several_files_are_as_calibrated_as_the_least_of_their_channels(design, rig, path):
    options = ss.StimulusOptions(one_file_per_input=True)
    done = ss.export_stimulus(design, path, rig=rig, options=options)
    assert done.calibration == "calibrated, measured on 2026-03-01"
    unknown = replace(rig, channels=(rig.channels[0], replace(rig.channels[1], measured=None)))
    done = ss.export_stimulus(design, path, rig=unknown, options=options)
    assert done.calibration == "uncalibrated: place 12 has no measured response"
    of_files = [sidecar(each)["calibration"] for each in done.files]
    assert of_files == ["calibrated, measured on 2026-03-04", done.calibration]


def test_equalised_samples_are_the_volts_that_make_the_acceleration(design, rig, path):
    equaliser = RegularisedInverse(boost_db=60.0)
    done = ss.export_stimulus(
        design, path, rate_hz=RATE_HZ, rig=rig, equaliser=equaliser, options=BARE
    )
    assert done.gain == 1.0
    assert ", full scale = that of each channel, equalised for Bench 3 " in done.summary
    # By hand: samples times volts of full scale, polarity, and m/s² for each volt.
    volts = read(path) * np.array([[2.0], [-4.0]])
    acceleration = volts * np.array([[50.0], [20.0]])
    drive = ss.stimulus_of(design, RATE_HZ).samples
    assert np.abs(acceleration - drive).max() < 2e-3 * np.abs(drive).max()
    about = sidecar(path)
    assert about["unit"] == "full scale of the channel"
    assert about["equaliser"] == {"kind": "RegularisedInverse", "boost_db": 60.0, "phase": "linear"}


def test_limits_of_the_rig_must_be_confirmed(design, rig, path):
    careful = replace(rig.channels[0], limits=Limits(peak_voltage_v=0.5))
    strict = replace(rig, channels=(careful, rig.channels[1]))
    with pytest.raises(NotConfirmedError, match="Place 7"):
        ss.export_stimulus(design, path, rate_hz=RATE_HZ, rig=strict)
    assert not path.exists()
    ss.export_stimulus(design, path, rate_hz=RATE_HZ, rig=strict, confirmed=True)
    assert sidecar(path)["confirmed"][0].startswith("Place 7")


def test_what_a_rig_does_not_know_is_asked_for(design, rig, tmp_path, path):
    equaliser = RegularisedInverse()
    with pytest.raises(InvalidInputError, match="Choose a rig, or an actuator"):
        ss.export_stimulus(design, path, equaliser=equaliser)
    for how in ({}, {"equaliser": equaliser}):
        with pytest.raises(InvalidInputError, match=r"^Place 12 is not wired"):
            ss.export_stimulus(design, path, rig=replace(rig, channels=rig.channels[:1]), **how)
    unknown = replace(rig.channels[0], full_scale_v=None)
    with pytest.raises(InvalidInputError, match="volts at full scale"):
        ss.export_stimulus(
            design, path, rig=replace(rig, channels=(unknown, rig.channels[1])), equaliser=equaliser
        )
    still = replace(rig.channels[0], measured=None)
    with pytest.raises(InvalidInputError, match="no response of the actuator 'own'"):
        ss.export_stimulus(
            design, path, rig=replace(rig, channels=(still, rig.channels[1])), equaliser=equaliser
        )
    tap = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
    with pytest.raises(InvalidInputError, match="velocity"):
        ss.export_stimulus(tap, path, rig=rig, equaliser=equaliser)
    assert list(tmp_path.iterdir()) == []


def test_the_command_takes_a_rig_and_an_equaliser(design, rig, tmp_path, path, capsys):
    ss.save_design(tmp_path / "d.skinsource", design)
    save_rig(tmp_path / "bench.skinrig", rig)
    call = ["export", str(tmp_path / "d.skinsource"), "--rate", "8000", "--out", str(path)]
    call += ["--rig", str(tmp_path / "bench.skinrig")]
    assert main([*call, "--equalise", "minimum", "--boost", "12"]) == 0
    assert sidecar(path)["equaliser"]["boost_db"] == 12.0
    assert sidecar(path)["equaliser"]["phase"] == "minimum"
    assert main(call) == 0
    assert sidecar(path)["equaliser"] is None
    last_line = capsys.readouterr().out.splitlines()[-1].strip()
    assert last_line == f"{sidecar(path)['calibration'].capitalize()}."
    assert last_line.startswith("Calibrated")


def test_channels_wait_for_the_one_with_the_longest_delay(design, rig, tmp_path):
    late = replace(rig, channels=(replace(rig.channels[0], delay_s=0.00405), rig.channels[1]))
    plain, aligned = tmp_path / "a.wav", tmp_path / "b.wav"
    # The delayed samples have another peak: full scale is said, so that both are as strong.
    known = {"rate_hz": RATE_HZ, "full_scale": 10.0}
    ss.export_stimulus(design, plain, rig=rig, **known)
    ss.export_stimulus(design, aligned, rig=late, **known)
    before, after = read(plain), read(aligned)
    n = before.shape[1]
    assert after.shape[1] > n
    np.testing.assert_allclose(after[0, :n], before[0], atol=1e-7)
    # 32.4 samples later, as the transform of the whole says.
    spectrum = np.fft.rfft(np.pad(before[1], (0, n)))
    turned = spectrum * np.exp(-2j * np.pi * np.arange(spectrum.size) * 32.4 / (2 * n))
    expected = np.fft.irfft(turned, 2 * n)[: after.shape[1]]
    np.testing.assert_allclose(after[1], expected, atol=1e-5)
    added = [channel["delay_added_s"] for channel in sidecar(aligned)["channels"]]
    assert added == pytest.approx([0.0, 0.00405])


def test_volts_need_no_equaliser_and_keep_their_value(design, rig, path):
    coil = ss.actuators.load("example-voice-coil")
    volts = replace(design.with_input(1, amplitude=-1.5), actuation=actuation(coil))
    ss.export_stimulus(volts, path, rate_hz=RATE_HZ, rig=rig)
    expected = ss.stimulus_of(volts, RATE_HZ)
    assert expected.unit == "V"
    # 2 V at full scale; and 4 V through an amplifier, turned round.
    np.testing.assert_allclose(read(path)[0], expected.samples[0] / 2.0, atol=1e-7)
    np.testing.assert_allclose(read(path)[1], expected.samples[1] / -4.0, atol=1e-7)
    about = sidecar(path)
    assert about["predicted_through"]["actuators"][0]["actuator"] == "mine"
    assert about["unit"] == "full scale of the channel"
    with pytest.raises(InvalidInputError, match="volts already"):
        ss.export_stimulus(volts, path, rig=rig, equaliser=RegularisedInverse())


def test_an_equaliser_may_ring_in_the_silence_before(design, rig, path):
    early = replace(design, inputs=(ss.track(7, ss.waveforms.Gabor(frequency_hz=120.0)),))
    equaliser = RegularisedInverse()
    coil = ss.actuators.load("example-voice-coil")
    named = replace(rig, channels=(replace(rig.channels[0], measured=None, model=coil),))
    options = ss.StimulusOptions(lead_in_s=0.25, tail_s=0.0)
    ss.export_stimulus(
        early, path, rate_hz=RATE_HZ, rig=named, equaliser=equaliser, options=options
    )
    # What rings because the rate is another one is there before the equaliser makes volts of it.
    (drive,) = ss.stimulus_of(early, RATE_HZ, lead_in_s=0.25).samples
    volts = ss.equalising.equalised(drive, RATE_HZ, coil, equaliser)
    assert np.abs(volts[:1900]).max() > 1e-4 * np.abs(volts).max()
    np.testing.assert_allclose(read(path)[0] * 2.0, volts, atol=1e-6 * np.abs(volts).max())
    assert sidecar(path)["start_s"] == -0.25


@pytest.mark.parametrize("phase", ["linear", "minimum"])
@pytest.mark.parametrize("name", ss.actuators.names())
def test_an_equaliser_has_all_the_silence_it_needs_unless_it_is_said(tmp_path, name, phase):
    tone = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tone(100.0)),))
    call = {"equaliser": RegularisedInverse(phase=phase), "rate_hz": 8000}
    call["actuation"] = actuation(ss.actuators.load(name))
    done = ss.export_stimulus(tone, tmp_path / "a.wav", **call)
    assert done.edges == ""
    assert done.summary.endswith("lead-in 0.1 s, tail 0.1 s, as the equaliser needs")
    about = sidecar(tmp_path / "a.wav")
    assert (about["start_s"], about["lead_in_s"], about["tail_s"]) == (-0.1, 0.1, 0.1)
    assert about["n_times"] == ss.stimulus_of(tone, 8000).n_times + 2 * 800
    bare = ss.export_stimulus(tone, tmp_path / "b.wav", **call, options=BARE)
    assert "lead-in" not in bare.summary
    part = replace(BARE, lead_in_s=None, tail_s=None, from_s=0.05, to_s=0.1)
    cut = ss.export_stimulus(tone, tmp_path / "c.wav", **call, options=part)
    assert "lead-in" not in cut.summary


def test_a_tail_keeps_what_rings_after_the_end(tmp_path):
    early = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Impulse()),))
    options = ss.StimulusOptions(lead_in_s=0.1)
    assert (
        "A tail of 0.1 s keeps it."
        in ss.export_stimulus(early, tmp_path / "a.wav", rate_hz=8000, options=options).edges
    )
    whole = ss.export_stimulus(
        early, tmp_path / "a.wav", rate_hz=8000, options=replace(options, tail_s=0.1)
    )
    assert whole.edges == ""
    fade = replace(options, tail_s=0.1, fade_out_s=0.0005)
    ss.export_stimulus(early, tmp_path / "b.wav", rate_hz=8000, options=fade)
    # What was faded out is followed by silence.
    assert not read(tmp_path / "b.wav")[0][-800:].any()


COIL = ss.actuators.load("example-voice-coil")
THROUGH = ss.Actuation(actuators=(ss.ActuatorAt(actuator="Coil, in air", model=COIL),))
INVERSE = RegularisedInverse(boost_db=12.0)
BARE = ss.StimulusOptions(lead_in_s=0.0, tail_s=0.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        # Knowing the actuator alone makes no volts.
        ({}, "raw accelerations"),
        ({"scaling": "upstream"}, "raw drives"),
        ({"actuation": THROUGH}, "volts of the design"),
    ],
)
def test_what_is_not_equalised_says_what_it_is(design, path, changes, message):
    exported = ss.export_stimulus(replace(design, **changes), path, actuation=THROUGH)
    words = f"Not equalised ({message}), for Coil, in air"
    assert exported.equalised == sidecar(path)["equalised"] == words
    assert exported.summary.endswith(f"{words[0].lower()}{words[1:]}")
    if "scaling" in changes:
        call = {"actuation": THROUGH, "equaliser": INVERSE}
        with pytest.raises(InvalidInputError, match="scaling is upstream"):
            ss.export_stimulus(replace(design, **changes), path, **call)


@pytest.mark.parametrize("named", [True, False])
def test_an_actuator_that_is_named_or_predicted_through_gets_its_volts(
    design, tmp_path, path, named
):
    shown = design if named else replace(design, actuation=replace(THROUGH, equaliser=INVERSE))
    exported = ss.export_stimulus(
        shown,
        path,
        rate_hz=RATE_HZ,
        actuation=THROUGH if named else None,
        equaliser=INVERSE,
        options=BARE,
    )
    drives = ss.stimulus_of(design, RATE_HZ).samples
    for row, drive in zip(read(path), drives, strict=True):
        volts = ss.equalising.equalised(drive, RATE_HZ, COIL, INVERSE)
        np.testing.assert_allclose(row, volts * exported.gain, atol=1e-6)
    about = sidecar(path)
    assert about["equalised"] == exported.equalised
    assert exported.equalised == "Equalised for Coil, in air (regularised inverse)"
    assert (about["unit"], about["calibration"][:12]) == ("V", "uncalibrated")
    assert [actuator["name"] for actuator in about["actuator"]] == ["Coil, in air"]
    assert about["equaliser"]["boost_db"] == 12.0
    assert (about["predicted_through"] is None) == named
    # It is the design that was exported, not one with an actuator in it.
    ss.export_stimulus(shown, tmp_path / "b.wav")
    assert sidecar(tmp_path / "b.wav")["design_digest"] == about["design_digest"]


def test_a_rig_says_the_actuators_itself(design, rig, tmp_path):
    for title in ("Bench 3", ""):
        exported = ss.export_stimulus(
            design,
            tmp_path / "a.wav",
            actuation=THROUGH,
            rig=replace(rig, title=title),
            equaliser=INVERSE,
        )
        assert exported.equalised == f"Equalised for {title or 'the rig'} (regularised inverse)"
        said = sidecar(tmp_path / "a.wav")["actuator"]
        assert [each["name"] for each in said] == ["own", "own"]


def test_it_can_be_stopped_after_each_channel_that_is_equalised(design, rig, path, monkeypatch):
    rows = []
    monkeypatch.setattr(stimulus, "equalised", lambda samples, *_, **__: rows.append(samples) or 0)
    with pytest.raises(Stopped):
        ss.export_stimulus(design, path, rig=rig, equaliser=INVERSE, stop=lambda: bool(rows))
    assert len(rows) == 1


def test_what_the_limited_boost_takes_is_the_same_number_everywhere(tmp_path, capsys):
    hz = (50.0, 84.1, 141.4, 237.8, 400.0)
    clips = tuple(
        ss.Clip(id=k, waveform=ss.waveforms.Gabor(frequency_hz=f, cycles=8.0), onset_s=0.15 * k)
        for k, f in enumerate(hz, start=1)
    )
    model = ss.actuators.load("kastor-2023-air")
    chosen = actuation(model, RegularisedInverse(), on=False)
    design = ss.Design(
        limb="synthetic-1", inputs=(ss.Input(location=7, clips=clips),), actuation=chosen
    )
    ss.save_design(tmp_path / "d.skinsource", design)

    def lost(*options):
        out = tmp_path / "a.wav"
        assert main(["export", str(tmp_path / "d.skinsource"), "--out", str(out), *options]) == 0
        said = sidecar(out)["loses"]
        assert said in capsys.readouterr().out
        return said

    (after_db,) = ss.equalising.curves(RegularisedInverse(), model, [50.0]).after_db
    said = lost()
    assert "limited to 20 dB" in said
    assert "loses most at place 7, at 50 Hz" in said
    assert float(said.split()[-3]) == pytest.approx(-after_db, abs=0.4)
    assert lost("--equalise", "minimum") == said
    # Of what is exported: the wavelet of 50 Hz is not in this part.
    assert lost("--from", "0.4") == ""
    assert lost("--equalise", "linear", "--boost", "40") == ""
    assert lost("--equalise", "none") == ""
    replaced = ss.equalising.PolePairReplacement(*ss.equalising.resonance_of(model))
    done = ss.export_stimulus(design, tmp_path / "p.wav", equaliser=replaced)
    assert "resonance of the actuator: the skin loses most at place 7, at 50 Hz" in done.loses
    # What the equaliser cuts away has no figure, and hides no loss that has one.
    slow = ss.Clip(id=9, waveform=ss.waveforms.Tone(frequency_hz=6.0, duration_s=1.0))
    both = replace(design, inputs=(*design.inputs, ss.Input(location=9, clips=(slow,))))
    beside = ss.export_stimulus(both, tmp_path / "b.wav").loses
    assert beside == f"{said[:-1]}; next to nothing is left of what place 9 has at 6 Hz."
    only = ss.export_stimulus(replace(both, inputs=both.inputs[1:]), tmp_path / "o.wav").loses
    assert only.endswith("to 600 Hz: next to nothing is left of what place 9 has at 6 Hz.")
    # Of noise most energy is missing at high frequencies, in wider bands.
    resonant = actuation(ss.actuators.load("example-resonant"), RegularisedInverse(), on=False)
    noise = replace(design, inputs=(ss.track(7, ss.waveforms.Noise()),), actuation=resonant)
    assert "at 27 Hz" in ss.export_stimulus(noise, tmp_path / "n.wav").loses
    # The flanks of a short wavelet are no frequencies of their own.
    short = ss.track(7, ss.waveforms.Gabor(frequency_hz=50.0, cycles=4.0))
    boosted = replace(chosen, equaliser=RegularisedInverse(boost_db=40.0))
    shorter = replace(design, inputs=(short,), actuation=boosted)
    assert ss.export_stimulus(shorter, tmp_path / "s.wav").loses == ""


def test_the_meaning_of_equalised_samples_is_volts(design, rig, tmp_path):
    def meaning(**call):
        ss.export_stimulus(design, tmp_path / "a.wav", **call)
        return sidecar(tmp_path / "a.wav")["meaning"]

    assert meaning() == meaning(rig=rig)
    assert meaning().startswith("samples times full_scale are the drive")
    equalised = meaning(actuation=THROUGH, equaliser=INVERSE)
    assert equalised.startswith("samples times full_scale are volts")
    assert equalised.endswith("in m/s²")
    wired = meaning(rig=rig, equaliser=INVERSE)
    assert wired.startswith("samples times full_scale_v and amplifier_gain of the channel")
