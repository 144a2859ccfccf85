"""The wiring page, the methods text, and a design as one zip, with what to cite."""

import hashlib
import importlib
import json
import re
import zipfile
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import View, __version__, open_design, save_design
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from skinsource.base.errors import InvalidInputError, MissingExtraError, Stopped
from skinsource.cli.command_line import main
from skinsource.export.packing import citation, data_of, pack
from skinsource.limbs.own_limbs import facts_of
from tests.core.exporting.export_bench import actuation
from tests.core.own_limbs.lab_bench import installed

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


def test_channels_of_the_page_have_the_numbers_that_they_have_in_several_files(tmp_path):
    options = ss.StimulusOptions(one_file_per_input=True, sync=True)
    exported = ss.export_stimulus(DESIGN, tmp_path / "a.wav", options=options)
    ss.export_wiring(DESIGN, tmp_path / "a.svg", options=options)
    words = words_of(tmp_path / "a.svg")
    first = words.index("Channel")
    rows = [words[first + 5 * row :][:2] for row in range(1, 4)]
    for path, id, (number, place) in zip(exported.files, DESIGN.ids, rows, strict=True):
        drive, sync = json.loads(path.with_name(f"{path.name}.json").read_text("utf-8"))["channels"]
        assert path.stem.endswith(f"_input-{id}")
        assert number == f"{drive['number']} of input-{id}"
        assert place.startswith(f"{drive['place']}, ")
        assert words[first + 20 :][:2] == [f"{sync['number']}", "Sync"]


def test_the_page_says_which_place_a_rig_does_not_wire(tmp_path):
    ss.export_wiring(DESIGN, tmp_path / "a.svg", rig=Rig(channels=RIG.channels[:1]))
    words = words_of(tmp_path / "a.svg")
    assert words[words.index("12, Digit II, base") + 1] == "not wired"


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


def test_the_methods_text_is_of_the_tracks_and_the_time_that_are_written():
    options = ss.StimulusOptions(inputs=(DESIGN.ids[1],), from_s=0.05, to_s=0.15, lead_in_s=0.2)
    text = ss.methods_text(DESIGN, options=options)
    alone = replace(DESIGN, inputs=DESIGN.inputs[1:2])
    levels_db = ss.evaluate(alone, "output_levels_db")["output_levels_db"]
    assert "(place 7)" not in text
    assert "more input" not in text
    assert f"reached {levels_db.max():.1f} dB".replace("-", "\N{MINUS SIGN}") in text
    assert "Drives from 50 to 150 ms are written as WAV (48 kHz, full scale = " in text
    assert "Drives are written as " in ss.methods_text(alone)


def test_the_methods_text_of_what_does_not_move_gives_no_level():
    text = ss.methods_text(replace(DESIGN, inputs=(ss.track(7, amplitude=0.0),)))
    assert "principal axis) was that of silence at all outputs. " in text
    assert "dB re" not in text


def test_the_methods_text_says_what_is_played():
    effects = (ss.effects.Stretch(to_s=0.4),)
    slower = ss.Clip(waveform=ss.waveforms.Tone(100.0), effects=effects, gain=0.92)
    train = ss.waveforms.WaveletTrain(equalise="energy", gains_db=(0.0, -7.1, -5.1, -5.6, -5.05))
    inputs = ss.Input(location=7, clips=(slower,)), ss.track(7, train)
    text = ss.methods_text(replace(DESIGN, inputs=inputs))
    assert "Tone 100 Hz, 400 ms gain 0.92 through stretch ×2, 1 m/s², peak 0.92 m/s²" in text
    assert "Wavelet train 50–400 Hz (5 frequencies, " in text
    assert ", balance by energy, gains 0 to −7.1 dB), 600 ms, gain 1, peak 0.559 m/s²" in text
    back = ss.waveforms.WaveletTrain(frequencies_hz=(400.0, 100.0, 50.0, 50.0, 200.0, 400.0))
    text = ss.methods_text(replace(DESIGN, inputs=(ss.track(7, back),)))
    assert "Wavelet train 400–50–400 Hz (6 frequencies" in text


# The package has a function of the same name.
packing_module = importlib.import_module("skinsource.export.packing")
ONE_TRACK = ss.Design(limb="synthetic-1", inputs=(ss.track(7),), title="One tone")
VIEW = View(outputs=(29,))


def names(path):
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return set(archive.namelist())


def read(path, name):
    with zipfile.ZipFile(path) as archive:
        return archive.read(name)


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    path = tmp_path_factory.mktemp("pack") / "one.zip"
    pack(path, ONE_TRACK, VIEW)
    return path


def test_a_pack_holds_all_that_belongs_to_a_design(packed):
    assert names(packed) == {
        "README.txt",
        "about.json",
        "citation.txt",
        "design.skinsource",
        "figure.pdf",
        "figure.svg",
        "levels.csv",
        "map.csv",
        "map.png",
        "stimulus.wav",
        "stimulus.wav.json",
        "traces.csv",
    }


def test_its_design_is_the_design_and_its_digests_are_those_of_its_files(packed, tmp_path):
    path = tmp_path / "again.skinsource"
    path.write_bytes(read(packed, "design.skinsource"))
    content = open_design(path)
    assert (content.design, content.view) == (ONE_TRACK, VIEW)
    about = json.loads(read(packed, "about.json"))
    assert about["versions"]["skinsource"] == __version__
    assert set(about["sha256"]) == names(packed) - {"about.json"}
    for name, digest in about["sha256"].items():
        assert hashlib.sha256(read(packed, name)).hexdigest() == digest


def test_the_same_design_gives_the_same_bytes(packed, tmp_path):
    again = tmp_path / "again.zip"
    pack(again, ONE_TRACK, VIEW)
    different = {name for name in names(packed) if read(again, name) != read(packed, name)}
    assert different == set()
    assert again.read_bytes() == packed.read_bytes()


def test_silence_and_no_outputs_are_packed_too(tmp_path):
    path = tmp_path / "silent.zip"
    pack(path, ss.Design(limb="synthetic-1"), View(outputs=()))
    assert not {"stimulus.wav", "traces.csv"} & names(path)


def test_a_stopped_pack_leaves_what_stood_there(tmp_path):
    path = tmp_path / "one.zip"
    path.write_bytes(b"before")
    asked = []

    def stop():
        asked.append(1)
        return len(asked) > 3

    with pytest.raises(Stopped):
        pack(path, ONE_TRACK, VIEW, stop=stop)
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_without_matplotlib_all_but_the_figure_is_packed(tmp_path, monkeypatch, packed):
    def missing(name, extra):
        raise MissingExtraError(f"{name} of {extra}")

    monkeypatch.setattr(packing_module, "package_of_extra", missing)
    path = tmp_path / "plain.zip"
    pack(path, ONE_TRACK, VIEW)
    assert names(packed) - names(path) == {"figure.svg", "figure.pdf"}


def test_the_command_packs_a_file_with_its_rig(tmp_path, capsys):
    design, rig, out = (tmp_path / name for name in ("a.skinsource", "a.skinrig", "a.zip"))
    save_design(design, ONE_TRACK, VIEW)
    save_rig(rig, Rig(title="Bench", channels=(RigChannel(place=7),)))
    assert main(["pack", str(design), "--out", str(out), "--rig", str(rig)]) == 0
    assert capsys.readouterr().out == f"{out}\n"
    assert "rig.skinrig" in names(out)
    with zipfile.ZipFile(out) as archive:
        sidecar = next(name for name in archive.namelist() if name.endswith("wav.json"))
        assert json.loads(archive.read(sidecar))["rig"] == "Bench"
    pack(out, replace(ONE_TRACK, rig=Rig(channels=(RigChannel(place=7),))), VIEW)
    assert "rig.skinrig" in names(out)


def test_a_citation_names_paper_version_and_limb_and_the_dataset_where_it_was_used():
    text = citation(ONE_TRACK)
    assert "10.1109/HAPTICS59260.2024.10520852" in text
    assert __version__ in text
    assert "Synthetic 1 (175 mm) (computed from a wave model, not measured)" in text
    assert "zenodo" not in text
    measured = citation(ss.Design(limb="measured-2"))
    assert "10.5281/zenodo.10547601" in measured
    assert "Measured 2" in measured
    assert data_of(ONE_TRACK)["dataset_doi"] == ""
    assert data_of(ss.Design(limb="measured-2"))["dataset_doi"] == "10.5281/zenodo.10547601"


def test_a_limb_of_a_lab_is_told_by_its_digest_and_not_by_the_published_dataset():
    installed()
    digest = facts_of("lab-1").digest
    design = replace(ONE_TRACK, limb="lab-1")
    for exported in (design, replace(design, limb_digest=digest)):
        assert "zenodo" not in citation(exported)
        assert f"on the limb Lab 1 (imported here), its numbers SHA-256 {digest}" in citation(
            exported
        )
        assert data_of(exported)["limb_sha256"] == digest
    installed(synthetic=True)
    assert "computed from a wave model" in citation(design)
    assert "not known here" in citation(replace(ONE_TRACK, limb="gone-1"))
    assert data_of(ONE_TRACK)["limb_sha256"] == ""


def test_a_citation_says_that_files_are_not_verified_as_published(synthetic_installed):
    design = ss.Design(limb="measured-2")
    assert "not verified as published: made from files that are not" in citation(design)
    assert data_of(design)["source_note"].startswith("not verified as published")
