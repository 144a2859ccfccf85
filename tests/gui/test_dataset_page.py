"""The page that installs the measured limbs, and what the studio does with those installed."""

from dataclasses import replace
from functools import partial

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QApplication, QComboBox, QFileDialog, QPushButton, QToolButton

from skinsource.base.errors import Stopped
from skinsource.base.job import Job
from skinsource.limbs.dataset.install import install
from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource_gui.pages import dataset as dataset_page
from skinsource_gui.pages.dataset import DatasetPage
from skinsource_gui.state.preferences import INSTALLATIONS

pytest.importorskip("matio", reason="mat-io is not installed")


@pytest.fixture
def page(window):
    # It goes with the window, or before it when a test closes it.
    return DatasetPage(window.runner, window.limbs, window)


def test_what_there_is_to_note_is_said_after_the_installation(window, qtbot, synthetic_download):
    work = partial(install, synthetic_download, unpublished=True)
    window.runner.add(Job(INSTALLATIONS[0], work))
    # Another page began it.
    page = DatasetPage(window.runner, window.limbs, window)
    qtbot.waitUntil(lambda: "4 measured limbs are installed" in page.message.text(), timeout=60_000)
    assert "Note: made from files that are not the published ones: " in page.message.text()


def test_other_map_files_are_refused_with_the_reason(page, qtbot, synthetic_download, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(synthetic_download))
    page.findChild(QPushButton, "install_from_folder").click()
    qtbot.waitUntil(lambda: "not the published content" in page.message.text(), timeout=60_000)


def test_installing_from_a_folder_can_be_cancelled(page, window, qtbot, tmp_path, monkeypatch):
    asked = []

    def install_for_ever(folder, *, progress, stop):
        asked.append(folder)
        progress(1, 4, "Reading the responses")
        while not stop():
            pass
        raise Stopped

    monkeypatch.setattr(dataset_page, "install", install_for_ever)
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path))
    page.show()
    page.findChild(QPushButton, "install_from_folder").click()
    qtbot.waitUntil(lambda: page.message.text() == "Reading the responses…")
    assert asked == [tmp_path]
    assert not page.findChild(QPushButton, "download").isEnabled()
    page.findChild(QPushButton, "cancel_installing").click()
    qtbot.waitUntil(lambda: page.message.text() == "Cancelled. Nothing was changed.")
    qtbot.waitUntil(lambda: not window.runner.busy)
    assert page.findChild(QPushButton, "download").isEnabled()
    assert not page.findChild(QPushButton, "cancel_installing").isVisible()


def test_an_installation_goes_on_when_the_page_closes(page, window, qtbot, synthetic_download):
    work = partial(install, synthetic_download, unpublished=True)
    window.runner.add(Job(INSTALLATIONS[0], work))
    page.close()
    qtbot.waitUntil(lambda: "measured-4" in window.limbs.names, timeout=60_000)
    assert "The measured limbs are installed. Note: " in window.notice.text


def test_a_failed_installation_is_told_when_the_page_is_closed(page, window, qtbot, tmp_path):
    window.runner.add(Job(INSTALLATIONS[0], partial(install, tmp_path)))
    page.close()
    qtbot.waitUntil(lambda: "impulseResponses.mat" in window.notice.text, timeout=30_000)


def come_back_to(window):
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))


def offered(window):
    field = window.findChild(QComboBox, "limb")
    model = field.model()
    entries = [model.index(row, 0) for row in range(model.rowCount())]
    count = sum(bool(model.flags(entry) & Qt.ItemFlag.ItemIsEnabled) for entry in entries)
    return count, [entry.data(Qt.ItemDataRole.ToolTipRole) for entry in entries if entry.data()]


def test_limbs_installed_meanwhile_are_used_at_once(window, settle, synthetic_download, user_data):
    count, hints = offered(window)
    assert count == 4
    assert hints[0].startswith(NOT_INSTALLED)
    install(synthetic_download, unpublished=True, folder=user_data)
    come_back_to(window)
    count, hints = offered(window)
    assert count == 8
    assert hints[0] == ""
    window.document.edit("a", replace(window.document.design, limb="measured-1"))
    settle()
    assert window.notice.text == ""
    assert "not the published ones" in window.panel("skin").content.note
    window.document.edit("a", replace(window.document.design, limb="synthetic-1"))
    settle()
    assert "computed" in window.findChild(QComboBox, "limb").toolTip().lower()


def test_a_design_is_shown_once_its_missing_limb_is_installed(window, settle, synthetic_installed):
    away = synthetic_installed.with_suffix(".away")
    synthetic_installed.rename(away)
    window.document.edit("a", replace(window.document.design, limb="measured-2"))
    settle()
    assert "not installed" in window.notice.text
    away.rename(synthetic_installed)
    come_back_to(window)
    settle()
    assert "not installed:" not in window.notice.text


def test_the_way_to_measured_limbs_is_shown_until_they_are_there(window, synthetic_installed):
    way = window.findChild(QToolButton, "get_limbs")
    assert way.isVisible()
    assert way.toolTip() == NOT_INSTALLED
    come_back_to(window)
    assert not way.isVisible()
