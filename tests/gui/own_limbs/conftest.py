"""The page on which limbs are imported, over a window."""

import pytest
from PySide6.QtWidgets import QDialog


@pytest.fixture
def page(window, qtbot):
    window.pages.show_limbs()
    page = window.findChild(QDialog, "limb_page")
    yield page
    page.close()
