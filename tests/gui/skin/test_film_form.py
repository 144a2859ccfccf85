"""What is asked before a film of the skin map is written."""

from dataclasses import replace
from functools import partial

import pytest

import skinsource as ss
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.limbs import own_limbs
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.panels.skin import film
from skinsource_gui.panels.skin.film import (
    FilmOptions,
    export_animation,
    film_name,
    film_options,
    film_remark,
)
from skinsource_gui.panels.skin.layout import VisiblePart
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.plots.pictures import PictureForm, PictureOptions

DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
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
