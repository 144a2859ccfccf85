"""The page that imports a limb: from a file in the layout, from arrays and tables."""

from threading import Event

import h5py
import numpy as np
import pytest
from PySide6.QtWidgets import QDialog, QLabel, QMessageBox

from skinsource.base.job import Job, stop_if
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb_import import LimbSource, import_limb
from skinsource.limbs.limb_layout import export_limb
from skinsource.limbs.own_limbs import facts_of, own_limb_names, remove_limb
from skinsource_gui.qt.labels import NameLine
from tests.core.own_limbs.lab_bench import installed
from tests.gui.own_limbs.limb_page_bench import button, imported, opened, text_of_page

YES, NO = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No


def answering(monkeypatch, answer):
    """What is asked from now on, a list that grows; each is answered alike."""
    asked = []
    monkeypatch.setattr(
        QMessageBox,
        "question",
        lambda *arguments: asked.append((arguments[2], arguments[4])) or answer,
    )
    return asked


def test_a_file_in_the_layout_is_imported_and_can_be_chosen_at_once(
    user_data, tmp_path, window, page, qtbot, monkeypatch
):
    monkeypatch.setattr(QMessageBox, "question", lambda *_: pytest.fail("asked"))
    installed(band_hz=(40.0, 1500.0))
    digest = facts_of("lab-1").digest
    export_limb("lab-1", tmp_path / "lab.h5")
    remove_limb("lab-1")
    assert text_of_page(page) == "Choose the file of the responses."
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
    qtbot.waitUntil(lambda: text_of_page(page) == "Mirroring lab-1: done.", timeout=60_000)
    assert facts_of("lab-1").mirrored
    assert button(page, "mirror_limb").text() == "Do not mirror"
    asked = answering(monkeypatch, NO)
    button(page, "remove_limb").click()
    assert own_limb_names() == ("lab-1",)
    answering(monkeypatch, YES)
    button(page, "remove_limb").click()
    assert own_limb_names() == ()
    assert asked == [
        (
            "Remove “Lab 1” (lab-1)? Its responses cannot be had back from here, and its designs "
            "open read-only.",
            NO,
        )
    ]


def test_names_on_the_page_are_selected_by_the_first_click(page):
    assert all(isinstance(field, NameLine) for field in (page.form.name, page.form.title))


def test_a_limb_of_the_same_name_is_replaced_after_a_question(
    user_data, tmp_path, page, qtbot, monkeypatch
):
    installed()
    page.own.show_limbs()
    export_limb("lab-1", tmp_path / "lab.h5")
    with h5py.File(tmp_path / "lab.h5", "r+") as file:
        file["responses"][0, 0, 0, 0] += 1.0
    before = facts_of("lab-1").digest
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    asked = answering(monkeypatch, NO)
    button(page, "import_limb").click()
    assert [(text[:30], default) for text, default in asked] == [
        ("Replace “Lab 1” (lab-1)? Its r", NO)
    ]
    assert not page._jobs.busy
    assert facts_of("lab-1").digest == before
    answering(monkeypatch, YES)
    imported(page, "lab-1", qtbot)
    assert facts_of("lab-1").digest != before


def test_what_a_file_said_goes_with_it_and_what_was_typed_stays(user_data, tmp_path, page, qtbot):
    installed(note="cold hands", band_hz=(40.0, 1500.0))
    export_limb("lab-1", tmp_path / "lab.h5")
    for name in ("first", "second"):
        np.save(tmp_path / f"{name}.npy", np.zeros((7, 31, 2, 9)))
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    page.form.title.setText("My title")
    opened(page, tmp_path / "first.npy", "responses", qtbot)
    form = page.form
    assert (form.name.text(), form.title.text(), form.note.text()) == ("first", "My title", "")
    assert form.values()["band_hz"] is None
    assert text_of_page(page) == "The responses have 2 axes; choose as many."
    form.axes.choose("xy")
    assert text_of_page(page) == "0 of 7 inputs have a place: click them, or open a table."
    opened(page, tmp_path / "second.npy", "responses", qtbot)
    assert form.name.text() == "second"
    form.name.setText("mine")
    opened(page, tmp_path / "first.npy", "responses", qtbot)
    assert form.name.text() == "mine"


def test_axes_and_hand_of_a_file_go_with_it_unless_they_were_chosen(
    user_data, tmp_path, page, qtbot
):
    installed(left=True)
    export_limb("lab-1", tmp_path / "lab.h5")
    np.save(tmp_path / "plain.npy", np.zeros((7, 31, 2, 9)))
    form = page.form
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    assert (form.values()["axes"], form.values()["left"]) == ("xz", True)
    opened(page, tmp_path / "plain.npy", "responses", qtbot)
    assert (form.values()["axes"], form.values()["left"]) == ("z", False)
    # What somebody chose stays, also where a file had said something else before.
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    form.axes.choose("xy")
    form.left.setChecked(False)
    form.left.setChecked(True)
    form.mirrored.setChecked(True)
    opened(page, tmp_path / "plain.npy", "responses", qtbot)
    assert form.values()["axes"] == "xy"
    assert form.values()["mirrored"]


def test_computed_responses_are_said_to_be_and_a_file_in_the_layout_says_so_itself(
    user_data, tmp_path, page, qtbot
):
    installed(synthetic=True)
    export_limb("lab-1", tmp_path / "lab.h5")
    remove_limb("lab-1")
    np.save(tmp_path / "plain.npy", np.zeros((7, 31, 2, 9)))
    form = page.form
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    assert form.values()["synthetic"]
    opened(page, tmp_path / "plain.npy", "responses", qtbot)
    assert not form.values()["synthetic"]
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    form.synthetic.click()
    imported(page, "lab-1", qtbot)
    assert not load_limb("lab-1").synthetic


def test_tables_that_were_opened_stay_when_an_array_takes_the_place_of_a_file_in_the_layout(
    user_data, tmp_path, page, qtbot
):
    installed()
    export_limb("lab-1", tmp_path / "lab.h5")
    np.save(tmp_path / "plain.npy", np.zeros((7, 31, 2, 9)))
    (tmp_path / "in.csv").write_text("1,2\n" * 7)
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    opened(page, tmp_path / "in.csv", "inputs", qtbot)
    opened(page, tmp_path / "plain.npy", "responses", qtbot)
    page.form.axes.choose("xz")
    assert text_of_page(page) == "0 of 31 outputs have a place: click them, or open a table."


def test_what_cannot_be_read_is_said_and_nothing_is_kept(user_data, tmp_path, page, qtbot):
    (tmp_path / "a.h5").write_bytes(b"nothing at all")
    opened(page, tmp_path / "a.h5", "responses", qtbot)
    assert "a.h5" in text_of_page(page)
    opened(page, tmp_path / "a.h5", "photograph", qtbot)
    assert "no picture can be read" in text_of_page(page)
    np.save(tmp_path / "two.npy", np.zeros((2, 3, 9)))
    opened(page, tmp_path / "two.npy", "responses", qtbot)
    (tmp_path / "in.csv").write_text("1,2\n3,x\n")
    opened(page, tmp_path / "in.csv", "inputs", qtbot)
    assert "row 2" in text_of_page(page)
    assert not button(page, "import_limb").isEnabled()
    assert own_limb_names() == ()


def test_a_file_that_is_refused_is_not_named_as_the_chosen_one(user_data, tmp_path, page, qtbot):
    (tmp_path / "line.csv").write_text("0,0\n9,0\n9,9\n")
    (tmp_path / "bad.svg").write_text("<svg><path")
    opened(page, tmp_path / "line.csv", "outline", qtbot)
    assert page.findChild(QLabel, "chosen_outline").text() == "line.csv"
    opened(page, tmp_path / "bad.svg", "outline", qtbot)
    assert "bad.svg" in text_of_page(page)
    assert page.findChild(QLabel, "chosen_outline").text() == "line.csv"
    assert len(page.draft.outline) == 3


def test_a_table_of_too_few_places_is_said_before_a_file_in_the_layout_is_imported(
    user_data, tmp_path, page, qtbot
):
    installed()
    export_limb("lab-1", tmp_path / "lab.h5")
    (tmp_path / "in.csv").write_text("1,2\n3,4\n")
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    assert button(page, "import_limb").isEnabled()
    opened(page, tmp_path / "in.csv", "inputs", qtbot)
    assert text_of_page(page) == "2 of 7 inputs have a place: click them, or open a table."
    assert not button(page, "import_limb").isEnabled()


def test_a_job_of_the_page_is_cancelled_on_the_page_that_covers_the_bar(user_data, window, qtbot):
    window.pages.show_limbs()
    page = window.findChild(QDialog, "limb_page")
    begun, ended = Event(), Event()

    def work(progress, stop):
        progress(1, 4, "")
        begun.set()
        while True:
            ended.wait(0.01)
            stop_if(stop)

    assert button(page, "cancel_import").isHidden()
    page._jobs.add(Job("Importing a limb", work))
    qtbot.waitUntil(begun.is_set)
    assert not button(page, "cancel_import").isHidden()
    assert not button(page, "import_limb").isEnabled()
    # The second click of two on Import does not hit it.
    assert button(page, "cancel_import").x() < button(page, "import_limb").x()
    qtbot.waitUntil(lambda: text_of_page(page) == "Importing a limb: 25 %")
    # Whoever closes the page and opens it again can cancel it too.
    page.close()
    window.pages.show_limbs()
    again = window.findChildren(QDialog, "limb_page")[-1]
    assert again is not page
    button(again, "cancel_import").click()
    qtbot.waitUntil(lambda: text_of_page(again) == "Cancelled. Nothing was changed.")
    assert button(again, "cancel_import").isHidden()
    again.close()


@pytest.mark.parametrize(
    "order", [("outline", "inputs", "outputs"), ("inputs", "outputs", "outline")]
)
def test_an_svg_and_the_tables_beside_it_lie_on_each_other_as_the_command_has_them(
    user_data, tmp_path, page, qtbot, order
):
    np.save(tmp_path / "plain.npy", np.ones((2, 3, 1, 9)))
    (tmp_path / "line.svg").write_text('<svg><path d="M0 0 L60 0 L60 90 L0 100 Z"/></svg>')
    (tmp_path / "in.csv").write_text("10,20\n15,60\n")
    (tmp_path / "out.csv").write_text("12,25\n17,33\n,\n")
    files = {"outline": "line.svg", "inputs": "in.csv", "outputs": "out.csv"}
    opened(page, tmp_path / "plain.npy", "responses", qtbot)
    for what in order:
        opened(page, tmp_path / files[what], what, qtbot)
    imported(page, "plain", qtbot)
    import_limb(
        LimbSource(
            responses=tmp_path / "plain.npy",
            **{what: tmp_path / name for what, name in files.items()},
            values={**page.form.values(), "name": "beside"},
        )
    )
    here, there = load_limb("plain").map, load_limb("beside").map
    for field in ("outline", "input_positions", "output_positions"):
        np.testing.assert_allclose(getattr(here, field), getattr(there, field))
    # Another outline, whose y points up, turns the tables back.
    (tmp_path / "line.csv").write_text("0,0\n60,0\n60,90\n")
    opened(page, tmp_path / "line.csv", "outline", qtbot)
    np.testing.assert_allclose(page.draft.inputs, [(10, 20), (15, 60)])
