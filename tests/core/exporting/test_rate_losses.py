"""Exports at rates that do not hold all of a design."""

import pytest

import skinsource as ss
from skinsource.base.errors import NotConfirmedError
from skinsource.cli.command_line import main
from tests.core.exporting.export_bench import sidecar

ACCEPTED = ss.StimulusOptions(accept_loss=True)


def tone(frequency_hz, duration_s=0.2, **options):
    return ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=duration_s, **options)


def design_of(*tracks, limb="synthetic-1"):
    return ss.Design(limb=limb, inputs=tracks)


@pytest.fixture
def two():
    """As strong on both places."""
    return design_of(ss.track(7, tone(500.0)), ss.track(8, tone(100.0)))


def test_the_words_name_the_channel_what_is_lost_and_what_to_do(two, tmp_path):
    words = r"462 Hz .*channel 1 \(Digit II, pad\) loses 5\.8 dB .*choose 1300 Hz.*--accept-loss"
    with pytest.raises(NotConfirmedError, match=words):
        ss.export_stimulus(two, tmp_path / "a.wav", rate_hz=1000)


def test_what_is_accepted_is_written_and_told(two, path):
    done = ss.export_stimulus(two, path, rate_hz=1000, options=ACCEPTED)
    sentence = "channel 1 (Digit II, pad) loses 5.8 dB of its energy."
    assert done.loses.endswith(sentence)
    assert sidecar(path)["loses"] == done.loses


def test_what_is_less_than_a_decibel_is_only_told(path):
    # A hundredth of the energy lies above any rate below 1000 Hz.
    mild = design_of(ss.track(7, tone(100.0)), ss.track(7, tone(550.0), amplitude=0.1))
    done = ss.export_stimulus(mild, path, rate_hz=1000)
    # A hundredth: 10 log10(1.01).
    assert done.loses.endswith("channel 1 (Digit II, pad) loses 0.043 dB of its energy.")
    assert sidecar(path)["loses"] == done.loses


@pytest.mark.parametrize("rate_hz", [1300, 8000, 44_100, 48_000])
def test_where_nothing_is_lost_nothing_is_said(two, tmp_path, rate_hz):
    done = ss.export_stimulus(two, tmp_path / "a.wav", rate_hz=rate_hz)
    assert done.loses == ""


@pytest.mark.parametrize("rate_hz", [100, 1000])
def test_silence_and_slow_pushes_lose_nothing(tmp_path, rate_hz):
    slow = ss.waveforms.Tone(frequency_hz=2.0, duration_s=1.0)
    quiet = design_of(ss.track(7, tone(500.0), amplitude=0.0), ss.track(8, slow))
    assert ss.export_stimulus(quiet, tmp_path / "a.wav", rate_hz=rate_hz).loses == ""


def test_only_the_part_that_is_exported_counts(tmp_path):
    long = design_of(ss.track(7, tone(100.0, 2.0)), ss.track(7, tone(500.0), onset_s=2.2))
    # In the whole the high tone is short.
    ss.export_stimulus(long, tmp_path / "a.wav", rate_hz=900)
    late = ss.StimulusOptions(from_s=2.15)
    with pytest.raises(NotConfirmedError, match="loses"):
        ss.export_stimulus(long, tmp_path / "b.wav", rate_hz=900, options=late)
    early = ss.StimulusOptions(to_s=2.1)
    assert ss.export_stimulus(long, tmp_path / "b.wav", rate_hz=900, options=early).loses == ""


@pytest.mark.parametrize("duration_s", [0.0005, 0.003, 0.011])
@pytest.mark.parametrize("rate_hz", [1000, 48_000])
@pytest.mark.parametrize("fade_s", [0.0, 1.0])
def test_what_is_cut_off_is_not_lost_to_the_rate(tmp_path, duration_s, rate_hz, fade_s):
    steady = design_of(ss.track(7, tone(100.0, 1.0)))
    from_s = 0.5002
    part = ss.StimulusOptions(
        from_s=from_s,
        # Shorter than a sample of the design, at least one of the file.
        to_s=from_s + max(duration_s, 1.0 / rate_hz),
        fade_out_s=fade_s * duration_s if duration_s * rate_hz > 2 else 0.0,
    )
    done = ss.export_stimulus(steady, tmp_path / "c.wav", rate_hz=rate_hz, options=part)
    assert done.loses == ""


def test_each_file_tells_of_its_own_channel(two, tmp_path):
    options = ss.StimulusOptions(one_file_per_input=True, accept_loss=True)
    done = ss.export_stimulus(two, tmp_path / "a.wav", rate_hz=1000, options=options)
    lossy, whole = done.files
    assert f"channel 1 (Digit II, pad) loses 5.8 dB of its energy in {lossy.name}." in done.loses
    assert "loses 5.8 dB" in sidecar(lossy)["loses"]
    assert sidecar(whole)["loses"] == ""


@pytest.mark.parametrize("name", ss.export_formats())
def test_formats_lose_at_their_rate_of_samples_not_of_updates(tmp_path, name):
    # Chips and phones get 100 or 200 numbers a second, made of samples that hold all of it.
    fast = design_of(ss.track(7, tone(500.0)))
    ss.export_stimulus(fast, tmp_path / "a", format=name)
    assert "weakened" not in sidecar(tmp_path / "a")["loses"]


def test_a_format_of_one_rate_is_no_matter_of_choosing_another(tmp_path):
    beyond = design_of(ss.track(7, tone(640.0)))
    with pytest.raises(NotConfirmedError, match="More than 1 dB is lost: lower the frequencies"):
        ss.export_stimulus(beyond, tmp_path / "a.h", format="bos1901")


def test_the_command_says_it_in_one_line_and_takes_an_acceptance(two, tmp_path, capsys):
    ss.save_design(tmp_path / "a.skinsource", two)
    out = tmp_path / "a.wav"
    call = ["export", str(tmp_path / "a.skinsource"), "--rate", "1000", "--out", str(out)]
    assert main(call) == 1
    printed = capsys.readouterr()
    assert printed.err.startswith("skinsource: At 1000 Hz, frequencies above 462 Hz")
    assert not out.exists()
    assert main([*call, "--accept-loss"]) == 0
    assert "  At 1000 Hz, frequencies above 462 Hz are weakened or lost" in capsys.readouterr().out
