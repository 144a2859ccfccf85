from dataclasses import replace

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QApplication, QComboBox

from skinsource.limbs.dataset.install import install
from skinsource.limbs.dataset.store import NOT_INSTALLED
from skinsource_gui.shell.limb_note import LimbNote


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
    note = window.findChild(LimbNote)
    assert "NOT VERIFIED AS PUBLISHED" in note.text()
    assert note.toolTip().startswith("Made from files that are not the published ones: ")
    assert not note.isHidden()
    window.document.edit("a", replace(window.document.design, limb="synthetic-1"))
    settle()
    assert "SYNTHETIC LIMB" in note.text()
    assert "computed" in note.toolTip().lower()


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


def test_the_way_to_measured_limbs_is_told_until_they_are_there(window, synthetic_installed):
    note = window.findChild(LimbNote)
    assert "not installed" in note.text()
    come_back_to(window)
    assert "SYNTHETIC LIMB" in note.text()
    assert "not installed" not in note.text()
