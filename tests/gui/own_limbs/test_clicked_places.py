"""Places and outline of a limb, clicked on a photograph."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage

from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb_layout import export_limb
from skinsource_gui.pages.limbs.form import spacing_of
from tests.core.own_limbs.lab_bench import N_TAPS, RATE_HZ, installed
from tests.gui.own_limbs.limb_page_bench import button, imported, opened, text_of_page


def test_places_are_clicked_on_a_photograph(user_data, tmp_path, window, page, qtbot):
    responses = np.random.default_rng(1).standard_normal((2, 3, N_TAPS))
    np.save(tmp_path / "two.npy", responses)
    picture = QImage(200, 300, QImage.Format.Format_RGB32)
    picture.fill(Qt.GlobalColor.lightGray)
    picture.save(str(tmp_path / "hand.png"))
    opened(page, tmp_path / "two.npy", "responses", qtbot)
    assert page.form.name.text() == "two"
    assert text_of_page(page) == "0 of 2 inputs have a place: click them, or open a table."
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
    assert text_of_page(page).startswith("Click both ends of the hand's length")
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


def test_on_a_photograph_all_of_a_file_in_the_layout_is_clicked_or_nothing(
    user_data, tmp_path, page, qtbot
):
    installed()
    export_limb("lab-1", tmp_path / "lab.h5")
    picture = QImage(200, 300, QImage.Format.Format_RGB32)
    picture.save(str(tmp_path / "hand.png"))
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    opened(page, tmp_path / "hand.png", "photograph", qtbot)
    assert text_of_page(page) == "Ready to import."
    for what, points, message in (
        ("inputs", 7, "0 of 31 outputs"),
        ("outputs", 31, "Click the corners of the outline"),
        ("outline", 3, "Click both ends of the hand's length"),
        ("hand", 2, "Ready to import."),
    ):
        for k in range(points):
            page._take(page.draft.with_point(what, (10.0 * k, 7.0 * k * k)))
        assert text_of_page(page).startswith(message)


def test_marks_of_many_places_make_room_for_each_other(page):
    points = np.array([(0.0, 0.0), (1.0, 0.0), (9.0, 0.0), (np.nan, np.nan)])
    assert spacing_of(points).tolist() == [1.0, 1.0, 8.0, np.inf]
    assert spacing_of(points[:0]).size == 0
