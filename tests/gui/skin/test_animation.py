"""The skin map in time as a file."""

import subprocess
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QColor

import skinsource as ss
from skinsource.base.errors import InvalidInputError, Stopped, StorageError
from skinsource.base.job import never
from skinsource.design.view import View
from skinsource.export import exported_design
from skinsource.export.video import video_file
from skinsource.limbs.limb import PUBLISHED
from skinsource.perception.validity import Finding
from skinsource_gui.panels.skin import film as animation
from skinsource_gui.panels.skin.film import export_animation, film_of
from skinsource_gui.panels.skin.settings import MAGNITUDE, RMS, SkinSettings, Z
from skinsource_gui.panels.skin.time import slow_down_factor
from skinsource_gui.plots.pictures import PictureOptions, with_caption
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
    exported = exported_design.ExportedDesign(DESIGN, VIEW, lambda *now: None, never)
    camera = animation._Camera(exported, SkinSettings(quantity=Z), PictureOptions(width_px=200))
    monkeypatch.setattr(camera, "_draw", lambda content, heading: drawn.append(content))
    camera.frame(film_of(VIEW, SkinSettings(quantity=Z), camera.end_s, 60, PERSON), 0)
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
    exported = exported_design.ExportedDesign(DESIGN, VIEW, lambda *now: None, never)
    options = PictureOptions(width_px=200, height_px=300, dpi=192, colours="dark")
    camera = animation._Camera(exported, SkinSettings(quantity=Z), options)
    film = film_of(VIEW, SkinSettings(quantity=Z), camera.end_s, 60, PERSON)
    frame = camera.frame(film, 0)
    assert frame.shape == (600, 400, 3)
    assert "Place 7" in captions[0]
    assert captions[0].endswith(" Responses are computed from a model, not measured.")
    assert tuple(frame[1, 1]) == QColor(DARK.base).getRgb()[:3]
    # Its words, in the colour of words, at the foot.
    assert (np.abs(frame[-60:].astype(int) - frame[1, 1]).sum(axis=2) > 100).any()
