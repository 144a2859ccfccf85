"""The skin map in time as a file, and what is asked before it is written."""

import subprocess
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from PySide6.QtGui import QColor

import skinsource as ss
from skinsource.base.errors import InvalidInputError, Stopped, StorageError
from skinsource.base.job import never
from skinsource.design.design import View
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.export import exported_design
from skinsource.export.video import video_file
from skinsource.limbs import own_limbs
from skinsource.limbs.limb import PUBLISHED
from skinsource.perception.validity import Finding
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.panels.skin import film, picture
from skinsource_gui.panels.skin import film as animation
from skinsource_gui.panels.skin.film import (
    FilmOptions,
    export_animation,
    film_name,
    film_of,
    film_options,
    film_remark,
)
from skinsource_gui.panels.skin.layout import VisiblePart
from skinsource_gui.panels.skin.settings import MAGNITUDE, RMS, SkinSettings, Z
from skinsource_gui.panels.skin.time import slow_down_factor
from skinsource_gui.plots.pictures import PictureForm, PictureOptions, with_caption
from skinsource_gui.plots.small_map import tick_text
from skinsource_gui.qt.theme import DARK

imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg")
PERSON = PUBLISHED["synthetic-1"]
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
VIEW = View(time_range_s=(0.06, 0.066))


def frames_of(path, n_pixels):
    """Mean grey of each frame, as the decoder has it."""
    decode = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "error", "-i", str(path)]
    raw = [*decode, "-fps_mode", "passthrough", "-f", "rawvideo", "-pix_fmt", "gray", "-"]
    pixels = subprocess.run(raw, capture_output=True, check=True).stdout
    return np.frombuffer(pixels, np.uint8).reshape(-1, n_pixels).mean(axis=1)


@pytest.fixture
def small(monkeypatch):
    monkeypatch.setattr(animation, "SIZE_PX", (180, 240))


@pytest.mark.parametrize("ending", [".mp4", ".webm", ".gif"])
def test_a_file_holds_every_frame_in_its_order(tmp_path, ending):
    path = tmp_path / f"a{ending}"
    greys = [0, 80, 160, 240]
    with video_file(path, (64, 48), "words\nand more", never) as add:
        for grey in greys:
            add(np.full((48, 64, 3), grey, np.uint8))
    assert frames_of(path, 64 * 48) == pytest.approx(greys, abs=6)


@pytest.mark.parametrize("ending", [".webm", ".gif"])
def test_frames_are_written_as_they_come_and_not_all_held_until_the_end(tmp_path, qtbot, ending):
    noise = np.random.default_rng(1).integers(0, 255, (8, 96, 128, 3), np.uint8)
    with video_file(tmp_path / f"a{ending}", (128, 96), "", never) as add:
        for number in range(240):
            add(noise[number % 8])
        [part] = tmp_path.iterdir()
        qtbot.waitUntil(lambda: part.stat().st_size > 0, timeout=30_000)


def test_what_is_no_animation_is_refused_and_nothing_is_left(tmp_path):
    with pytest.raises(InvalidInputError, match=r"a\.avi.*\.mp4, \.webm, \.gif"):
        export_animation(tmp_path / "a.avi", DESIGN, VIEW)
    with (
        pytest.raises(InvalidInputError, match="even numbers"),
        video_file(tmp_path / "a.mp4", (63, 48), "", never),
    ):
        pass
    with pytest.raises(StorageError):
        export_animation(tmp_path / "no" / "a.mp4", DESIGN, VIEW)
    assert list(tmp_path.iterdir()) == []


def test_a_stopped_animation_leaves_what_stood_there(tmp_path, small):
    path = tmp_path / "a.mp4"
    path.write_bytes(b"before")
    reports = []
    with pytest.raises(Stopped):
        export_animation(
            path,
            DESIGN,
            VIEW,
            progress=lambda *now: reports.append(now),
            stop=lambda: len(reports) > 3,
        )
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_frames_are_taken_at_their_instants_and_told_as_progress(tmp_path, small, monkeypatch):
    looks, reports = [], []
    content = animation.content_of

    def note(results, settings, view, *rest, **more):
        looks.append((view.playhead_s, settings.quantity))
        return content(results, settings, view, *rest, **more)

    monkeypatch.setattr(animation, "content_of", note)
    path = tmp_path / "a.mp4"
    export_animation(path, DESIGN, VIEW, progress=lambda *now: reports.append(now))
    times = np.array([time_s for time_s, _ in looks])
    # 1/50, at which the stage shows it, at 60 frames in a second: 3000 instants of a second.
    assert times == pytest.approx(0.06 + np.arange(19) / 3000)
    assert {name for _, name in looks} == {Z}
    assert reports[-1][:2] == (19, 19)
    assert frames_of(path, 180 * 240).size == 19


def test_it_is_as_slow_as_its_waves_need_and_never_faster_than_wanted():
    per_s = 60
    for name, least in ((Z, 20.0), (MAGNITUDE, 50.0), (RMS, 2.0)):
        settings = SkinSettings(quantity=name, rms_window_s=0.02)
        assert slow_down_factor(View(), settings, per_s, PERSON) == least
        assert slow_down_factor(View(slow_motion=100.0), settings, per_s, PERSON) == 100.0
    settings = SkinSettings(quantity=MAGNITUDE)
    assert slow_down_factor(View(slow_motion=30.0), settings, per_s, PERSON) == 50.0
    # At 4 kHz waves may be three times as quick, unless the lab says that they are not.
    lab = replace(PERSON, own=True, sample_rate_hz=4000.0, band_hz=None)
    assert slow_down_factor(View(), settings, per_s, lab) == 200.0
    assert slow_down_factor(View(), settings, per_s, replace(lab, band_hz=(20.0, 250.0))) == 20.0
    # A film may run more slowly than the window plays.
    for rate_hz in (6500.0, 48_000.0, 1e6):
        quick = replace(lab, sample_rate_hz=rate_hz)
        for frames_per_s in (50, 60):
            pace = slow_down_factor(View(slow_motion=200.0), settings, frames_per_s, quick)
            # Of a length, which moves twice as fast as its axes, two frames in each period.
            assert 2.0 <= frames_per_s * pace / rate_hz < 5.0


def test_a_film_is_that_of_the_time_axes_and_not_endless():
    settings = SkinSettings(quantity=Z)
    film = film_of(View(), settings, 0.5, 60, PERSON)
    assert (film.begin_s, film.slow_motion) == (0.0, 20.0)
    assert film.time_s(film.count - 1) <= 0.5 < film.time_s(film.count)
    # 0.075 - 0.055 is a little less than 0.02 in binary.
    zoomed = film_of(View(time_range_s=(0.055, 0.075)), settings, 0.5, 60, PERSON)
    assert zoomed.time_s(zoomed.count - 1) == pytest.approx(0.075)
    with pytest.raises(InvalidInputError, match="Zoom the time axes"):
        film_of(View(slow_motion=200.0), settings, 600.0, 60, PERSON)


def filmed(settings, options):
    exported = exported_design.ExportedDesign(DESIGN, VIEW, lambda *now: None, never)
    camera = animation._Camera(exported, settings, options)
    return camera, film_of(VIEW, settings, camera.end_s, 60, PERSON)


def test_what_is_mostly_noise_is_hatched_in_a_film_and_the_caption_says_it(monkeypatch):
    noise = Finding(
        name="noise", state="left", sentence="", in_short="{:.0f} noisy.", number=2, outputs=(3, 4)
    )
    value, drawn = exported_design.ExportedDesign.value, []
    monkeypatch.setattr(
        exported_design.ExportedDesign,
        "value",
        lambda self, name, **more: (noise,) if name == "validity" else value(self, name, **more),
    )
    camera, film = filmed(SkinSettings(quantity=Z), PictureOptions(width_px=200))
    monkeypatch.setattr(camera, "_draw", lambda content, heading: drawn.append(content))
    camera.frame(film, 0)
    assert drawn[0].hatched == (3, 4)
    assert [mark.location for mark in drawn[0].inputs] == [
        track.location for track in DESIGN.inputs
    ]
    assert camera._caption.endswith(" 2 noisy.")


def test_a_film_has_its_stimulus_below_it_at_every_size(monkeypatch):
    captions = []
    monkeypatch.setattr(
        animation,
        "with_caption",
        lambda draw, caption: captions.append(caption) or with_caption(draw, caption),
    )
    options = PictureOptions(width_px=200, height_px=300, dpi=192, colours="dark")
    camera, film = filmed(SkinSettings(quantity=Z), options)
    frame = camera.frame(film, 0)
    assert frame.shape == (600, 400, 3)
    assert "Place 7" in captions[0]
    assert captions[0].endswith(" Responses are computed from a model, not measured.")
    assert tuple(frame[1, 1]) == QColor(DARK.base).getRgb()[:3]
    # Its words, in the colour of words, at the foot.
    assert (np.abs(frame[-60:].astype(int) - frame[1, 1]).sum(axis=2) > 100).any()


@pytest.mark.parametrize(
    ("settings", "begins"),
    [
        (SkinSettings(quantity=Z), "≤≥"),
        (SkinSettings(quantity=Z, z_limits=(-1e4, 1e4)), "\N{MINUS SIGN}1"),
        (SkinSettings(quantity=MAGNITUDE), "\N{MINUS SIGN}5"),
        (SkinSettings(quantity=MAGNITUDE, moving_range_db=(10.0, 90.0)), "19"),
        (SkinSettings(quantity=MAGNITUDE, moving_range_db=(-90.0, -60.0)), "\N{MINUS SIGN}≥"),
    ],
)
def test_the_ends_of_its_colours_say_whether_values_lie_beyond_them(settings, begins, monkeypatch):
    scales = []
    monkeypatch.setattr(picture, "paint_scale_row", lambda *drawn: scales.append(drawn[2]))
    camera, film = filmed(settings, PictureOptions(width_px=200))
    camera.frame(film, 0)
    ends, reached = scales[0].range_db, scales[0].reached_db
    assert "".join(tick_text(value, ends, reached)[0] for value in ends) == begins


ZOOMED = View(time_range_s=(0.05, 0.15))
SIZES = PictureOptions(width_px=900, height_px=1200)


def shown(quantity, view=ZOOMED, slow_motion=1.0, **settings):
    settings = SkinSettings(quantity=quantity, **settings)
    return replace(with_settings(view, "skin", settings), slow_motion=slow_motion)


@pytest.fixture
def form(qtbot):
    view = shown("z", slow_motion=100.0)
    form = PictureForm(film_options(DESIGN, view, SIZES), remark=partial(film_remark, DESIGN, view))
    qtbot.addWidget(form)
    form.show()
    return form


def choose(form, name, option):
    form.findChild(ChoiceField, f"{name}_field").choose(option)


def remark(form):
    return form.remark.text.replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(
    ("quantity", "filmed"),
    [("levels", "z"), ("sensation", "z"), ("z", "z"), ("magnitude", "magnitude"), ("rms", "rms")],
)
def test_it_begins_with_what_the_screen_shows_and_how_slowly(quantity, filmed):
    view = shown(quantity, slow_motion=100.0, rms_window_s=0.05)
    options = film_options(DESIGN, view, replace(SIZES, colours="dark"))
    assert (options.quantity, options.pace, options.part) == (filmed, "100", "seen")
    assert (options.rms_window_s, options.colours) == (0.05, "dark")
    assert options.part_of(VisiblePart(fit="hand")) == VisiblePart(fit="hand")


def test_it_begins_as_fast_as_waves_can_be_followed_and_keeps_the_format_of_the_last_time():
    assert film_options(DESIGN, shown("rms"), SIZES).pace == "2"
    assert film_options(DESIGN, shown("z"), SIZES).pace == "50"
    assert film_options(DESIGN, shown("magnitude"), SIZES).pace == "100"
    # Of a speed that no list offers, the next one that is slower.
    assert film_options(DESIGN, shown("z", slow_motion=60.0), SIZES).pace == "100"
    last = FilmOptions(kind=".gif", quantity="rms", part="hand")
    options = film_options(DESIGN, shown("z"), last)
    # A GIF has fewer frames per second.
    assert (options.kind, options.quantity, options.part, options.pace) == (
        ".gif",
        "z",
        "seen",
        "50",
    )


def test_length_and_frames_follow_what_is_chosen(form):
    begin = "50 to 150 ms of the response: "
    assert remark(form) == f"{begin}10 s of film, 601 frames."
    choose(form, "pace", "20")
    assert remark(form).startswith(f"{begin}2.02 s of film, 121 frames.")
    choose(form, "kind", ".gif")
    # Of 50 frames per second 20 times slower would be too fast.
    assert remark(form).startswith(f"{begin}5.02 s of film, 251 frames. It runs at 1/50")
    choose(form, "quantity", "rms")
    assert remark(form) == f"{begin}2.02 s of film, 101 frames."


def test_what_is_said_of_a_film_is_the_part_that_the_response_has():
    # As time axes are fitted: they begin before the response.
    view = shown("z", View(time_range_s=(-0.005, 0.15)))
    text = film_remark(DESIGN, view, FilmOptions(pace="20")).text
    assert text.startswith("0 to 150 ms of the response: 3.02 s of film, 181 frames.")


def test_what_is_said_of_a_film_includes_what_actuators_ring():
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    design = replace(DESIGN, inputs=(ss.track(7),), actuation=ss.Actuation(actuators=(coil,)))
    view = shown("z", View(delay_removed=False))
    last_s = ss.evaluate(design, "response_time_s", view=view)["response_time_s"][-1]
    text = film_remark(design, view, FilmOptions(pace="20")).text
    assert float(text.split("about ")[1].split(" s")[0]) == pytest.approx(20.0 * last_s, abs=0.1)


@pytest.mark.parametrize(("frequency_hz", "pace"), [(400.0, "200"), (100.0, "50")])
def test_the_waves_of_a_tone_are_filmed_as_slowly_as_on_the_stage(frequency_hz, pace):
    tone = ss.waveforms.Tone(frequency_hz=frequency_hz)
    design, view = replace(DESIGN, inputs=(ss.track(7, tone),)), shown("z")
    options = film_options(design, view, SIZES)
    assert options.pace == pace
    assert "flickers" not in film_remark(design, view, options).text
    faster = film_remark(design, view, replace(options, pace="20")).text
    assert ("It has 3 frames in a period" in faster) == (frequency_hz == 400.0)
    # What would be too long runs faster.
    chirp = ss.waveforms.Chirp(duration_s=5.0)
    design = replace(DESIGN, inputs=(ss.track(7, chirp),))
    options = film_options(design, shown("z", View()), SIZES)
    assert not film_remark(design, View(), options).refuses


def test_what_cannot_be_written_says_why_and_cannot_be_saved(qtbot):
    long = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tone(duration_s=60.0)),))
    view = shown("z", View(), slow_motion=200.0)
    form = PictureForm(film_options(long, view, SIZES), remark=partial(film_remark, long, view))
    qtbot.addWidget(form)
    form.show()
    assert "expected at most 36000: 10 minutes" in remark(form)
    assert form.remark.refuses
    choose(form, "pace", "5")
    choose(form, "quantity", "rms")
    assert remark(form).startswith("All of the response: about ")
    assert remark(form).endswith("Zoom the traces to film a part.")
    assert not form.remark.refuses
    form._edit("width_px", 5000.0, None)
    assert "expected at most 4096 on a side" in remark(form)
    assert form.remark.refuses


def test_along_z_cannot_be_saved_of_a_limb_that_is_not_measured_so(monkeypatch):
    flat = replace(own_limbs.facts_of("synthetic-1"), axes="xy")
    monkeypatch.setattr(film, "facts_of", lambda name: flat)
    view = shown("z")
    options = film_options(DESIGN, view, SIZES)
    remark = film_remark(DESIGN, view, options)
    assert remark.refuses
    assert remark.text.startswith("This limb was measured along x and y, and not along z: ")
    assert not film_remark(DESIGN, view, replace(options, quantity="magnitude")).refuses


@pytest.mark.parametrize(
    ("quantity", "called"), [("z", "along-z"), ("magnitude", "magnitude"), ("rms", "sliding-rms")]
)
def test_the_name_of_a_film_says_what_it_shows_how_slowly_and_ends_as_its_kind(quantity, called):
    options = FilmOptions(quantity=quantity, pace="100", kind=".webm")
    assert film_name(DESIGN, View(), options) == f"skin-map-{called}-1-100.webm"
    fast = replace(options, pace="1", quantity="z", kind=".gif")
    assert film_name(DESIGN, View(), fast) == "skin-map-along-z-1-50.gif"


def test_what_was_chosen_is_filmed_and_not_what_the_screen_shows(tmp_path, monkeypatch):
    frames = []
    monkeypatch.setattr(
        film,
        "paint_picture",
        lambda painter, size, content, heading, *look: frames.append((content, heading, look)),
    )
    view, chosen_db = View(time_range_s=(0.06, 0.064)), (-60.0, -10.0)
    view = shown("z", view, 100.0, map_style="sensors", moving_range_db=chosen_db)
    options = FilmOptions(
        width_px=120, height_px=160, quantity="rms", rms_window_s=0.04, part="hand", pace="50"
    )
    whole = VisiblePart(fit="whole")
    export_animation(tmp_path / "a.gif", DESIGN, view, options=options, seen=whole)
    content, heading, look = frames[0]
    assert content.value_range == chosen_db
    assert heading.title == "Skin acceleration, RMS over 40 ms, at 60.0 ms"
    assert heading.details.endswith("1/50 of real time")
    assert look[-1] == VisiblePart(fit="hand")
    # How it is drawn is as on the screen.
    assert settings_of(options.view_of(view), "skin", SkinSettings).map_style == "sensors"
