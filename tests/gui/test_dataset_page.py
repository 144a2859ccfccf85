"""The page that installs the measured limbs."""

from functools import partial

import pytest
from PySide6.QtWidgets import QFileDialog, QLabel, QPushButton

from skinsource.dataset.install import install
from skinsource.job import Job
from skinsource_gui.dataset_page import page as dataset_page
from skinsource_gui.dataset_page.page import DatasetPage

pytest.importorskip("matio", reason="mat-io is not installed")


@pytest.fixture
def page(window, qtbot):
    page = DatasetPage(window.runner, window.limbs, window)
    qtbot.addWidget(page)
    return page


def words(page: DatasetPage) -> str:
    return page.findChild(QLabel, "dataset_words").text()


def test_what_there_is_to_note_is_said_after_the_installation(
    page, window, qtbot, made_up_download
):
    work = partial(install, made_up_download, unpublished=True)
    window.runner.add(Job(dataset_page._TITLES[0], work))
    qtbot.waitUntil(lambda: "4 measured limbs are installed" in words(page), timeout=60_000)
    assert "Note: made from files that are not the published ones: " in words(page)


def test_map_files_that_are_not_the_published_ones_are_refused_with_the_reason(
    page, qtbot, made_up_download, monkeypatch
):
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(made_up_download))
    page.findChild(QPushButton, "install_from_folder").click()
    qtbot.waitUntil(lambda: "not the published content" in words(page), timeout=60_000)
