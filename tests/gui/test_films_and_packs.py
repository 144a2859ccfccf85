"""Films of the skin map, from the window."""

import sys
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QLabel

from skinsource_gui.panels.skin.film import FilmOptions
from tests.gui.exporting import press, shown


def test_a_film_asks_for_its_size_and_begins_with_it_the_next_time(
    window, qtbot, monkeypatch, write_with, tmp_path
):
    given, suggested, answers = [], [], {}

    def name_it(_window, _title, start, kinds):
        suggested.append((Path(start).name, kinds))
        return answers["save"], ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", name_it)

    def wait():
        qtbot.waitUntil(lambda: not window.runner.busy, timeout=20_000)

    window.panel("skin").map.stage.pan_zoom.show("hand")
    write_with("animation", lambda *_, options, seen, **more: given.append((options, seen.fit)))
    chosen = FilmOptions(width_px=640, height_px=480, colours="dark", kind=".webm")

    answers["save"] = str(tmp_path / "film.mp4")
    part = shown(window, "animation")
    assert (part.form.options.width_px, part.form.options.height_px) == (900, 1200)
    assert "frames" in part.form.remark.text
    qtbot.waitUntil(lambda: not part.image.image.isNull(), timeout=20_000)
    for name in ("width_px", "height_px", "colours", "kind"):
        part.form._edit(name, getattr(chosen, name), None)
    press(part)
    wait()
    assert suggested == [
        ("skin-map-along-z-1-20.webm", "WebM (*.webm);;MP4 (*.mp4);;GIF (*.gif)"),
    ]
    assert given == [(chosen, "hand")]
    # The next time it begins with these; cancelled, nothing is asked or written any more.
    part = shown(window, "animation")
    assert (part.form.options.width_px, part.form.options.height_px) == (640, 480)
    window.exports.end()
    assert len(given) == 1


def test_a_film_that_cannot_be_written_says_so_before_anything_is_asked(window, monkeypatch):
    # As where it is not installed.
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    part = shown(window, "animation")
    message = part.findChild(QLabel, "file_problem").text()
    assert message.lower().startswith("the package 'imageio_ffmpeg' is needed for this")
    assert "[video]" in message
    assert not part.ready
    window.exports.end()
