from dataclasses import replace

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QApplication, QComboBox, QToolButton

from skinsource.limbs.dataset.install import install
from skinsource.limbs.dataset.store import NOT_INSTALLED


def come_back_to(window):
    QApplication.sendEvent(window, QEvent(QEvent.Type.WindowActivate))


def offered(window):
    field = window.findChild(QComboBox, "limb")
    model = field.model()
    entries = [model.index(row, 0) for row in range(model.rowCount())]
    count = sum(bool(model.flags(entry) & Qt.ItemFlag.ItemIsEnabled) for entry in entries)
    return count, [entry.data(Qt.ItemDataRole.ToolTipRole) for entry in entries if entry.data()]


def test_limbs_that_are_installed_while_the_studio_runs_can_be_used_at_once(
    window, settle, synthetic_download, user_data
):
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


def test_a_design_whose_limb_was_missing_is_shown_once_it_is_installed(
    window, settle, synthetic_installed
):
    away = synthetic_installed.with_suffix(".away")
    synthetic_installed.rename(away)
    window.document.edit("a", replace(window.document.design, limb="measured-2"))
    settle()
    assert "not installed" in window.notice.text
    away.rename(synthetic_installed)
    come_back_to(window)
    settle()
    assert window.notice.text == ""


def test_the_way_to_measured_limbs_is_shown_until_they_are_there(window, synthetic_installed):
    way = window.findChild(QToolButton, "get_limbs")
    assert way.isVisible()
    assert way.toolTip() == NOT_INSTALLED
    come_back_to(window)
    assert not way.isVisible()
