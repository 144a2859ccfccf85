"""The page that imports a limb: from a file in the layout, and by clicks on a photograph."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QDialog, QLabel, QPushButton

from skinsource.catalogue import load_limb
from skinsource.limb_import import export_limb
from skinsource.own_limbs import facts_of, own_limb_names, remove_limb
from tests.core.own_limbs.lab_bench import N_TAPS, RATE_HZ, installed


@pytest.fixture
def page(window, qtbot):
    window.pages.show_limbs()
    found = window.findChild(QDialog, "limb_page")
    yield found
    found.close()


def words(page):
    return page.findChild(QLabel, "limb_words").text()


def button(page, name):
    return page.findChild(QPushButton, name)


def opened(page, path, what, qtbot):
    page.open_file(path, what)
    qtbot.waitUntil(lambda: not page.reader.busy, timeout=60_000)


def imported(page, name, qtbot):
    button(page, "import_limb").click()
    qtbot.waitUntil(lambda: words(page).startswith("Imported as"), timeout=60_000)
    assert name in own_limb_names()


def test_a_file_in_the_layout_is_imported_and_can_be_chosen_at_once(
    user_data, tmp_path, window, page, qtbot
):
    installed(band_hz=(40.0, 1500.0))
    digest = facts_of("lab-1").digest
    export_limb("lab-1", tmp_path / "lab.h5")
    remove_limb("lab-1")
    assert words(page) == "Choose the file of the responses."
    assert not button(page, "import_limb").isEnabled()
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    assert page.form.name.text() == "lab-1"
    assert page.form.axes.value == "xz"
    assert page.form.values()["hand_length_mm"] == pytest.approx(180.0)
    assert page.form.values()["band_hz"] == (40.0, 1500.0)
    assert len(page.draft.inputs) == 7
    imported(page, "lab-1", qtbot)
    assert facts_of("lab-1").digest == digest
    assert "lab-1" in window.limbs.names
    assert page.own.chosen == "lab-1"
    button(page, "mirror_limb").click()
    assert facts_of("lab-1").mirrored
    button(page, "remove_limb").click()
    assert own_limb_names() == ()


def test_places_are_clicked_on_a_photograph(user_data, tmp_path, window, page, qtbot):
    responses = np.random.default_rng(1).standard_normal((2, 3, N_TAPS))
    np.save(tmp_path / "two.npy", responses)
    picture = QImage(200, 300, QImage.Format.Format_RGB32)
    picture.fill(Qt.GlobalColor.lightGray)
    picture.save(str(tmp_path / "hand.png"))
    opened(page, tmp_path / "two.npy", "responses", qtbot)
    assert page.form.name.text() == "two"
    assert words(page) == "0 of 2 inputs have a place: click them, or open a table."
    opened(page, tmp_path / "hand.png", "photograph", qtbot)

    def click(what, *points):
        page.click.set_value(what)
        for point in points:
            at = page.canvas.place_of(*point).toPoint()
            qtbot.mouseClick(page.canvas, Qt.MouseButton.LeftButton, pos=QPoint(at))

    click("inputs", (50, 60), (150, 60), (150, 90))
    button(page, "remove_last").click()
    click("outputs", (100, 100), (100, 150), (120, 200))
    click("outline", (20, 20), (180, 20), (180, 280), (20, 280))
    assert words(page).startswith("Click both ends of the hand's length")
    click("hand", (100, 30), (100, 230))
    imported(page, "two", qtbot)
    limb = load_limb("two")
    assert limb.band_hz is None
    assert limb.sample_rate_hz == RATE_HZ
    np.testing.assert_array_equal(limb.response_to(2)[:, 0], responses[1])
    scale = limb.map.hand_length_px
    assert scale == pytest.approx(200, abs=3)
    np.testing.assert_allclose(limb.map.input_positions, [(50, -60), (150, -60)], atol=2)
    np.testing.assert_allclose(limb.map.outline[0], (20, -20), atol=2)


def test_what_cannot_be_read_is_said_and_nothing_is_kept(user_data, tmp_path, page, qtbot):
    (tmp_path / "a.h5").write_bytes(b"nothing at all")
    opened(page, tmp_path / "a.h5", "responses", qtbot)
    assert "a.h5" in words(page)
    opened(page, tmp_path / "a.h5", "photograph", qtbot)
    assert "no picture can be read" in words(page)
    np.save(tmp_path / "two.npy", np.zeros((2, 3, 9)))
    opened(page, tmp_path / "two.npy", "responses", qtbot)
    (tmp_path / "in.csv").write_text("1,2\n3,x\n")
    opened(page, tmp_path / "in.csv", "inputs", qtbot)
    assert "row 2" in words(page)
    assert not button(page, "import_limb").isEnabled()
    assert own_limb_names() == ()
