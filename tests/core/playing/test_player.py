"""A player for experiments: prepared, told when to begin, honest about when it did."""

import gc
import weakref
from dataclasses import replace
from time import monotonic

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators import Limits
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import InvalidInputError, NothingToPlayOnError, PlaybackError
from skinsource.lab.playing.devices import devices
from skinsource.lab.playing.stream import PlayQueue, Stream
from skinsource.lab.playing.triggers import code_in
from tests.core.playing.playing_bench import wait_for
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, SyntheticStream, use

RATE_HZ = 48_000
TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE, amplitude=0.5),))
SAMPLES = ss.stimulus_of(DESIGN, RATE_HZ).samples[0].astype(np.float32)


@pytest.fixture
def player(sound):
    with ss.Player(DESIGN, gain_db=0.0, trigger_output=2) as player:
        yield player


def is_heard_once(sound):
    """Whether the first output played the stimulus, and silence before and after it."""
    samples = sound.streams[0].samples[0]
    begin = np.flatnonzero(samples)[0]
    end = begin + SAMPLES.size
    # What rings after the end is next to nothing.
    return np.array_equal(samples[begin:end], SAMPLES) and np.abs(samples[end:]).max() < 1e-4


def test_each_time_the_same_samples_are_played_with_the_code_beside_them(sound, player):
    for code in (5, 37):
        assert player.play(code=code).wait(20)
    player.close()
    drive, marks = sound.streams[0].samples
    for code in (5, 37):
        assert code_in(marks, RATE_HZ)[0] == code
        begin = code_in(marks, RATE_HZ)[1]
        assert np.array_equal(drive[begin : begin + SAMPLES.size], SAMPLES)
        # The low bit at the end is silence too.
        marks[: begin + round(0.05 * RATE_HZ)] = 0.0
    assert not marks.any()


def test_a_gain_changes_the_drive_and_not_the_trigger(sound):
    with ss.Player(DESIGN, gain_db=-20.0, trigger_output=2) as player:
        player.play().wait(20)
    drive, marks = sound.streams[0].samples
    assert np.abs(drive).max() == pytest.approx(0.1 * np.abs(SAMPLES).max(), rel=1e-6)
    assert marks.max() == 1.0


@pytest.mark.parametrize("clock", ["stream", "monotonic"])
def test_the_first_sample_is_heard_at_the_time_that_was_asked_for(sound, player, clock):
    at = (player.time_s if clock == "stream" else monotonic()) + 0.3
    playback = player.play(at, clock=clock)
    assert playback.wait(20)
    first = playback.first_sample_s if clock == "stream" else playback.first_sample_monotonic_s
    # Between clocks there is what threads wait for each other.
    within = 0.5 / RATE_HZ + 1e-9 if clock == "stream" else 0.02
    # Where other programs keep the device waiting it is late, and says so.
    assert first - playback.late_s == pytest.approx(at, abs=within)


def test_a_time_that_is_too_soon_is_refused_and_nothing_is_played(sound, player):
    for at in (player.time_s - 1.0, player.time_s + 0.001):
        with pytest.raises(PlaybackError, match="Ask earlier"):
            player.play(at)
    player.close()
    assert not sound.streams[0].samples.any()


def test_an_onset_is_estimated_until_a_loopback_was_measured(sound, player):
    playback = player.play()
    assert playback.onset_is == "estimated"
    assert playback.wait(20)
    assert playback.onset_monotonic_s == pytest.approx(playback.first_sample_monotonic_s, abs=1e-3)
    player.loopback_s = 0.25
    measured = player.play()
    assert measured.wait(20)
    assert measured.onset_is == "measured"
    later_s = measured.onset_monotonic_s - measured.first_sample_monotonic_s
    assert later_s == pytest.approx(0.25, abs=1e-3)


def test_a_stopped_one_fades_and_the_next_one_begins_at_its_first_sample(sound):
    long = DESIGN.with_input(0, clips=ss.track(7, ss.waveforms.Tone(duration_s=30.0)).clips)
    with ss.Player(long, gain_db=0.0) as player:
        first = player.play()
        assert first.wait_begin(20)
        with pytest.raises(PlaybackError, match="still plays"):
            player.play()
        first.stop()
        assert first.wait(20)
        again = player.play()
        assert again.wait_begin(20)
        player.stop()
        assert again.wait(20)


def test_a_player_of_which_nothing_plays_is_stopped_in_vain_and_plays_on(sound, player):
    player.stop()
    assert player.play().wait(20)
    player.stop()
    player.close()
    assert is_heard_once(sound)


def test_what_is_stopped_before_it_begins_is_over_and_the_next_one_plays(sound, player):
    playback = player.play(player.time_s + 60.0)
    playback.stop()
    playback.stop()
    assert playback.wait(20)
    assert playback.first_sample_s is None
    assert not playback.wait_begin(0.0)
    assert player.play().wait(20)
    player.close()
    assert is_heard_once(sound)


def test_what_has_ended_well_stays_so_after_the_player_is_closed(sound):
    long = DESIGN.with_input(0, clips=ss.track(7, ss.waveforms.Tone(duration_s=30.0)).clips)
    with ss.Player(long) as player:
        playback = player.play()
        assert playback.wait_begin(20)
        assert not playback.wait(0.0)
    assert playback.wait(20)
    with pytest.raises(PlaybackError, match="player is closed"):
        player.play()


def test_a_design_with_a_loop_is_played_once_as_it_is_exported(sound):
    with ss.Player(replace(DESIGN, loop_s=(0.01, 0.03)), gain_db=0.0) as player:
        assert player.play().wait(20)
    assert is_heard_once(sound)


def test_times_of_another_clock_codes_beyond_eight_bits_and_wrong_types_are_refused(sound, player):
    with pytest.raises(PlaybackError, match="the clock of at"):
        player.play(player.time_s + 1e6)
    for code in (-1, 256, 1.5, "5"):
        with pytest.raises(InvalidInputError, match="code is"):
            player.play(code=code)
    with pytest.raises(InvalidInputError, match="loopback_s is"):
        ss.Player(DESIGN, loopback_s="soon")
    with pytest.raises(InvalidInputError, match=r"rig is 'lab\.skinrig', expected Rig"):
        ss.Player(DESIGN, "lab.skinrig")
    assert len(sound.streams) == 1


def test_a_whole_number_that_is_a_float_is_a_code_too(sound, player):
    playback = player.play(code=5.0)
    assert playback.wait(20)
    assert repr(playback.code) == "5"


def test_where_an_onset_cannot_be_told_the_player_says_so_and_the_next_is_told(sound):
    told = []

    def tell(playback):
        told.append(playback.code)
        if playback.code == 1:
            raise RuntimeError("No network")

    player = ss.Player(DESIGN, began=tell)
    assert player.play(code=1).wait(20)
    wait_for(lambda: player._untold is not None)
    with pytest.raises(PlaybackError, match=r"An onset was not told: No network\."):
        player.play()
    assert player.play(code=2).wait(20)
    player.close()
    assert told == [1, 2]


def test_a_stream_that_nobody_knows_is_kept_until_it_is_closed(sound, monkeypatch):
    # Its device calls it from a thread that Python knows nothing of.
    monkeypatch.setattr(sound, "OutputStream", lambda **asked: SyntheticStream(sound, asked))
    ours = weakref.ref(Stream(PlayQueue(1, RATE_HZ), devices()[0], 0.02, lambda: None))
    gc.collect()
    assert ours() is not None
    ours().close()
    gc.collect()
    assert ours() is None


def test_what_begins_is_told_from_a_thread_of_its_own(sound):
    told = []
    with ss.Player(DESIGN, began=told.append) as player:
        playbacks = [player.play(code=code) for code in (1,)]
        assert playbacks[0].wait(20)
    assert told == playbacks


def test_full_scale_the_rig_and_missing_outputs_are_refused_before_anything_sounds(sound):
    with pytest.raises(PlaybackError, match=r"full scale.*6\.0 dB or less"):
        ss.Player(DESIGN, gain_db=12.0)
    limits = Limits(peak_voltage_v=0.1)
    rig = Rig(channels=(RigChannel(place=7, output=1, full_scale_v=1.0, limits=limits),))
    with pytest.raises(PlaybackError, match="limit of the rig"):
        ss.Player(DESIGN, rig, gain_db=0.0)
    with pytest.raises(PlaybackError, match="the trigger is on output 3"):
        ss.Player(DESIGN, trigger_output=3)
    with pytest.raises(InvalidInputError, match="cannot be the trigger"):
        ss.Player(DESIGN, trigger_output=1)
    assert sound.streams == []


def test_a_stimulus_is_played_as_its_design(sound):
    with ss.Player(ss.stimulus_of(DESIGN), gain_db=0.0) as player:
        player.play().wait(20)
    assert is_heard_once(sound)


def test_a_device_that_goes_or_hangs_ends_the_playback_with_a_sentence(sound):
    long = DESIGN.with_input(0, clips=ss.track(7, ss.waveforms.Tone(duration_s=30.0)).clips)
    for lose in (lambda: sound.streams[-1].pull_out(), lambda: setattr(sound, "is_stuck", True)):
        with ss.Player(long) as player:
            playback = player.play()
            assert playback.wait_begin(20)
            lose()
            with pytest.raises(PlaybackError, match="Two is gone"):
                playback.wait(20)
        sound.is_stuck = False
        with ss.Player(long) as player:
            playback = player.play(player.time_s + 60.0)
            lose()
            with pytest.raises(PlaybackError, match="Two is gone"):
                playback.wait_begin(20)
        sound.is_stuck = False


def test_without_a_device_there_is_one_error(monkeypatch):
    use(monkeypatch, SyntheticSoundLibrary())
    with pytest.raises(NothingToPlayOnError, match="No audio device"):
        ss.Player(DESIGN)
