import os
import signal
import subprocess
import sys

import pytest
from PySide6.QtWidgets import QPushButton

from skinsource.design_file import open_design
from skinsource_gui.files.kept_work import KeptWork
from skinsource_gui.shell.ending import offer_kept

STUDIO = """
import sys
from pathlib import Path
from PySide6.QtCore import QTimer
from skinsource_gui.shell import app

made = []
def make_window(*words):
    made.append(make(*words))
    return made[0]

def edit():
    window = made[0]
    if sys.argv[1] == "edited":
        window.document.edit("a", window.document.design.with_input(0, amplitude=2.5))
    print("ready", flush=True)

make, app.make_window = app.make_window, make_window
QTimer.singleShot(0, edit)
sys.exit(app.run(None))
"""


def run_until_ready(edited, folder):
    studio = subprocess.Popen(
        [sys.executable, "-c", STUDIO, edited],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "SKINSOURCE_DATA": str(folder)},
    )
    assert studio.stdout.readline() == "ready\n", studio.stderr.read()
    return studio


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGINT"])
def test_unsaved_work_is_kept_when_the_studio_is_told_to_end(tmp_path, name):
    studio = run_until_ready("edited", tmp_path)
    studio.send_signal(getattr(signal, name))
    _, said = studio.communicate(timeout=60)
    assert studio.returncode == 0, said
    assert "Traceback" not in said
    kept = KeptWork(tmp_path).newest()
    assert open_design(kept).design.inputs[0].amplitude == 2.5


def test_where_all_is_saved_nothing_is_kept(tmp_path):
    studio = run_until_ready("as it was", tmp_path)
    studio.terminate()
    _, said = studio.communicate(timeout=60)
    assert studio.returncode == 0, said
    assert KeptWork(tmp_path).newest() is None


@pytest.fixture
def kept(window, tmp_path):
    """Work that was kept, in a window that has begun anew."""
    kept = KeptWork(tmp_path)
    start = window.document.design
    window.document.edit("a", start.with_input(0, amplitude=2.5))
    kept.keep(window.document)
    window.document.start_over(start, window.document.view, None)
    return kept


def choose(window, words):
    buttons = window.notice.buttons.findChildren(QPushButton)
    next(one for one in buttons if one.text() == words).click()


def test_kept_work_is_offered_and_opened_as_not_saved(window, kept, tmp_path):
    offer_kept(window.document, kept, window.notice, window.reports.complain)
    assert "A copy was kept" in window.notice.text
    choose(window, "Open it")
    assert window.document.design.inputs[0].amplitude == 2.5
    assert window.document.modified
    assert kept.newest() is not None
    window.document.mark_saved(tmp_path / "a.skinsource")
    assert kept.newest() is None


def test_kept_work_can_be_given_up(window, kept):
    offer_kept(window.document, kept, window.notice, window.reports.complain)
    choose(window, "Discard it")
    assert kept.newest() is None
    assert window.document.design.inputs[0].amplitude == 1.0


def test_a_copy_that_cannot_be_deleted_stays_and_nothing_fails(window, kept, monkeypatch):
    def refuse(self, *_, **__):
        raise PermissionError(13, "Permission denied", str(self))

    monkeypatch.setattr(type(kept.newest()), "unlink", refuse)
    offer_kept(window.document, kept, window.notice, window.reports.complain)
    choose(window, "Discard it")
    assert kept.newest() is not None


def test_a_kept_copy_that_is_damaged_is_told(window, kept):
    kept.newest().write_bytes(b"damaged")
    offer_kept(window.document, kept, window.notice, window.reports.complain)
    choose(window, "Open it")
    assert "untitled" in window.notice.text


def test_without_kept_work_nothing_is_offered(window, tmp_path):
    offer_kept(window.document, KeptWork(tmp_path), window.notice, window.reports.complain)
    assert window.notice.text == ""
