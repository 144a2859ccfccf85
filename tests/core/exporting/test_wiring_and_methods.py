"""The wiring page and the methods text say what is exported, and nothing else."""

import re
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from skinsource.base.errors import InvalidInputError
from skinsource.cli.command_line import main
from tests.core.exporting.export_bench import actuation

GABOR = ss.waveforms.Gabor(frequency_hz=200.0)
DESIGN = ss.Design(
    limb="synthetic-1",
    title="Two $places",
    inputs=(
        ss.track(7, GABOR, onset_s=0.06, amplitude=0.5),
        ss.track(12, ss.waveforms.Tone(frequency_hz=100.0)),
        ss.track(7, GABOR, onset_s=0.1),
    ),
)
RIG = Rig(
    channels=(
        RigChannel(place=7, output=3, full_scale_v=2.0, actuator="own coil"),
        RigChannel(place=12, amplifier_gain=4.0, polarity="inverted", device="Desk"),
    )
)


def words_of(path):
    """The texts of a drawing, as they stand in it."""
    text = path.read_text(encoding="utf-8")
    return re.findall(r"<text[^>]*>([^<]*)</text>", text)


def test_a_page_says_for_each_channel_where_it_goes(tmp_path):
    ss.export_wiring(DESIGN, tmp_path / "a.svg", rig=RIG)
    words = words_of(tmp_path / "a.svg")
    assert "Wiring of Two $places" in words
    rows = [words[start : start + 5] for start in range(words.index("Channel"), len(words), 5)]
    assert rows[1] == ["1 (output 3)", "7, Digit II, pad", "normal", "1×, 2 V", "own coil"]
    assert rows[2] == ["2 (Desk 1)", "12, Digit II, base", "inverted", "4×", "not known"]
    # On the hand.
    assert words.count("1") == words.count("2") == 1


def test_long_texts_of_the_page_stay_in_their_columns(tmp_path):
    name = "Fingertip voice coil of the second batch, in air, number four"
    channels = tuple(replace(channel, actuator=name) for channel in RIG.channels)
    title = "A study of shapes that are felt by the whole hand, with a title of two lines"
    ss.export_wiring(replace(DESIGN, title=title), tmp_path / "a.svg", rig=Rig(channels=channels))
    assert f"Wiring of {title}" not in words_of(tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    [(size_px, left)] = {
        (float(size), float(x))
        for size, x in re.findall(rf'size: ([\d.]+)px[^"]*" x="([\d.]+)"[^>]*>{name}<', text)
    }
    assert left + 0.49 * size_px * len(name) < 0.93 * 210.0 / 25.4 * 72


def test_the_hand_is_seen_from_the_palm(tmp_path):
    places = {1: "Digit I, tip", 7: "Digit II, pad", 12: "Digit II, base"}
    inputs = tuple(ss.track(place, GABOR) for place in (1, 7, 12))
    ss.export_wiring(replace(DESIGN, inputs=inputs), tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    for place, name in places.items():
        assert f"{place}, {name}" in text
    found = re.findall(r'fill: #ffffff" x="([\d.]+)" y="([\d.]+)"[^>]*>(\d)</text>', text)
    at = {int(number): (float(x), float(y)) for x, y, number in found}
    # The thumb of a right hand is at the right, fingertips are above their roots.
    assert at[1][0] > at[2][0] + 20
    assert at[2][1] < at[3][1] - 20
    assert len(at) == 3


def test_channels_of_the_page_are_those_of_the_export(tmp_path):
    options = ss.StimulusOptions(per="input", sync=True, channel_map=(4, 0, 1, 2, 3))
    call = {"options": options, "actuation": actuation(ss.actuators.load("example-piezo"))}
    ss.export_wiring(DESIGN, tmp_path / "a.svg", **call)
    words = words_of(tmp_path / "a.svg")
    places = [word for word in words if word in ("Sync", "Silent") or word[:2] in ("7,", "12")]
    assert places == ["Sync", "Silent", *("7, Digit II, pad", "12, Digit II, base"), places[2]]
    assert words.count("mine") == 3
    assert "3, 5" in words


@pytest.mark.parametrize(("ending", "begin"), [("pdf", b"%PDF"), ("png", b"\x89PNG")])
def test_the_command_writes_the_page_for_a_rig(tmp_path, capsys, ending, begin):
    ss.save_design(tmp_path / "d.skinsource", DESIGN)
    save_rig(tmp_path / "bench.skinrig", RIG)
    out = tmp_path / "new" / f"wiring.{ending}"
    call = ["wiring", str(tmp_path / "d.skinsource"), "--out", str(out)]
    assert main([*call, "--rig", str(tmp_path / "bench.skinrig"), "--per", "input"]) == 0
    assert capsys.readouterr().out == f"{out}\n"
    assert out.read_bytes().startswith(begin)


def test_a_page_of_another_kind_or_of_nothing_is_refused(tmp_path):
    with pytest.raises(InvalidInputError, match=r"Call it \*\.pdf"):
        ss.export_wiring(DESIGN, tmp_path / "a.docx")
    with pytest.raises(InvalidInputError, match="No input is active"):
        ss.export_wiring(replace(DESIGN, inputs=()), tmp_path / "a.pdf")
    assert not any(tmp_path.iterdir())


def test_the_methods_text_has_the_numbers_of_the_design():
    single = replace(DESIGN, inputs=DESIGN.inputs[:1])
    coil = ss.actuators.load("example-voice-coil")
    call = {"format": "flac", "rate_hz": 44_100, "equaliser": ss.equalising.RegularisedInverse()}
    text = ss.methods_text(single, **call, actuation=actuation(coil))
    assert 60 <= len(text.split()) <= 100
    levels_db = ss.evaluate(single, "output_levels_db")["output_levels_db"]
    for words in (
        "Gabor wavelet 200 Hz (cycles 4), 25.5 ms at 60 ms, 0.5 m/s², at Digit II, pad (place 7)",
        "Amplitudes: acceleration of the probe",
        "72 outputs of the limb Synthetic 1 (175 mm)",
        f"\N{MINUS SIGN}{-levels_db.max():.1f} dB re 1 m/s² at output {np.argmax(levels_db) + 1}.",
        "Drives are written as FLAC, 24 bit (44.1 kHz, full scale = ",
        "Equalised for mine (regularised inverse).",
    ):
        assert words in text


def test_the_methods_text_counts_what_it_does_not_describe():
    text = ss.methods_text(DESIGN)
    assert "; and 1 more input." in text
    assert text.endswith("Not equalised (raw accelerations).")


def test_the_methods_text_says_what_is_played():
    effects = (ss.effects.Stretch(to_s=0.4),)
    slower = ss.Clip(waveform=ss.waveforms.Tone(100.0), effects=effects, gain=0.92)
    train = ss.waveforms.WaveletTrain(equalise="energy", gains_db=(0.0, -7.1, -5.1, -5.6, -5.05))
    inputs = ss.Input(location=7, clips=(slower,)), ss.track(7, train)
    text = ss.methods_text(replace(DESIGN, inputs=inputs))
    assert "Tone 100 Hz, 400 ms gain 0.92 through stretch ×2, 1 m/s², peak 0.92 m/s²" in text
    assert "Wavelet train 50–400 Hz (5 frequencies, " in text
    assert ", balance by energy, gains 0 to −7.1 dB), 600 ms, gain 1, peak 0.559 m/s²" in text
