"""What is cut off at the ends of a stimulus is said, and a lead-in keeps what rings before."""

import numpy as np

import skinsource as ss
from tests.core.exporting.export_bench import exported, read, sidecar

PULSE = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Impulse()),))
LATE = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Impulse(), onset_s=0.1),))


def caution_of(tmp_path, design, **options):
    exported(design, tmp_path / "a.wav", **options)
    return sidecar(tmp_path / "a.wav")["edges"]


def test_a_pulse_at_time_0_is_said_to_be_cut_and_a_lead_in_keeps_all_of_it(tmp_path):
    message = caution_of(tmp_path, PULSE)
    assert message.startswith(
        "Channel 1 begins at 100 % of its peak: what lies before time 0 is cut off. A lead-in of "
        "0.1 s keeps it."
    )
    (cut,) = read(tmp_path / "a.wav")
    assert "begins" not in caution_of(tmp_path, PULSE, lead_in_s=0.1)
    assert sidecar(tmp_path / "a.wav")["start_s"] == -0.1
    (samples,) = read(tmp_path / "a.wav")
    # At 8 kHz time 0 is sample 800, and a pulse there is as whole as one that comes later.
    np.testing.assert_array_equal(samples[800:], cut)
    exported(LATE, tmp_path / "late.wav")
    np.testing.assert_allclose(samples, read(tmp_path / "late.wav")[0], atol=1e-6)
    assert np.abs(samples[:800]).max() > 0.5
    assert "A longer lead-in keeps it." in caution_of(tmp_path, PULSE, lead_in_s=0.0003)


def test_a_lead_in_of_any_length_leaves_time_0_where_it_is():
    whole = ss.stimulus_of(LATE, 44_100).samples
    for lead_in_s, n in ((0.01, 441), (0.0333, 1469), (1 / 44_100, 1)):
        early = ss.stimulus_of(PULSE, 44_100, lead_in_s=lead_in_s)
        assert early.start_s == -n / 44_100
        np.testing.assert_allclose(early.samples, whole[:, 4410 - n :], rtol=0, atol=1e-12)
    own = ss.stimulus_of(PULSE, lead_in_s=0.01).samples
    assert np.flatnonzero(own).tolist() == [13]


def test_soft_ends_say_nothing_and_hard_ones_of_a_part_say_what_helps(tmp_path):
    gabor = ss.waveforms.Gabor(frequency_hz=200.0)
    soft = ss.Design(limb="synthetic-1", inputs=(ss.track(7, gabor, onset_s=0.1),))
    assert caution_of(tmp_path, soft) == ""
    tone = ss.waveforms.Tone(frequency_hz=100.0, phase_rad=1.5, window="none")
    hard = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone), ss.track(12, tone)))
    part = caution_of(tmp_path, hard, from_s=0.1, to_s=0.15)
    assert part.startswith("2 channels begin at up to ")
    assert "before that part is cut off. A fade-in softens it." in part
    assert part.endswith("A fade-out softens it.")
    assert caution_of(tmp_path, hard, from_s=0.1, to_s=0.15, fade_in_s=0.01, fade_out_s=0.01) == ""
