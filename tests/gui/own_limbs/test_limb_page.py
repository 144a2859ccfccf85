"""The page that imports a limb: from a file in the layout, from arrays and tables."""

import struct
import zlib
from threading import Event

import h5py
import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QDialog, QMessageBox, QPushButton

from skinsource.base.errors import RecordingError
from skinsource.base.job import Job, stop_if
from skinsource.base.run_limited import LimitedProcess
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb_import import LimbSource, import_limb
from skinsource.limbs.limb_layout import export_limb
from skinsource.limbs.own_limbs import facts_of, own_limb_names, remove_limb
from skinsource_gui.pages.limbs import photograph
from skinsource_gui.state.job_runner import JobProgress, JobRunner, PageJobs
from tests.core.own_limbs.lab_bench import N_TAPS, RATE_HZ, installed

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
    assert page.message.text() == "Choose the file of the responses."
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
    assert page.chosen == "lab-1"
    button(page, "mirror_limb").click()
    qtbot.waitUntil(lambda: page.message.text() == "Mirroring lab-1: done.", timeout=60_000)
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
            "Remove “Lab 1” (lab-1)? Its responses cannot be restored, and its designs open "
            "read-only.",
            NO,
        )
    ]


def test_a_limb_of_the_same_name_is_replaced_after_a_question(
    user_data, tmp_path, page, qtbot, monkeypatch
):
    installed()
    page.show_limbs()
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


def test_what_a_file_said_goes_with_it_and_later_typing_stays(user_data, tmp_path, page, qtbot):
    installed(note="cold hands", band_hz=(40.0, 1500.0), left=True, synthetic=True)
    export_limb("lab-1", tmp_path / "lab.h5")
    for name in ("first", "second"):
        np.save(tmp_path / f"{name}.npy", np.zeros((7, 31, 2, 9)))
    opened(page, tmp_path / "lab.h5", "responses", qtbot)
    values = page.form.values()
    assert (values["axes"], values["left"], values["synthetic"]) == ("xz", True, True)
    opened(page, tmp_path / "first.npy", "responses", qtbot)
    form = page.form
    assert (form.name.text(), form.title.text(), form.note.text()) == ("first", "", "")
    values = form.values()
    assert (values["band_hz"], values["left"], values["synthetic"]) == (None, False, False)
    assert page.message.text() == "The responses have 2 axes; choose as many."
    form.axes.choose("xy")
    form.left.setChecked(True)
    form.mirrored.setChecked(True)
    assert page.message.text() == "0 of 7 inputs have a place: click them, or open a table."
    form.name.setText("mine")
    opened(page, tmp_path / "second.npy", "responses", qtbot)
    assert form.name.text() == "mine"
    assert (form.values()["axes"], form.values()["mirrored"]) == ("xy", True)


def test_what_cannot_be_read_is_said_and_nothing_is_kept(user_data, tmp_path, page, qtbot):
    (tmp_path / "a.h5").write_bytes(b"nothing at all")
    opened(page, tmp_path / "a.h5", "responses", qtbot)
    assert "a.h5" in page.message.text()
    opened(page, tmp_path / "a.h5", "photograph", qtbot)
    assert "cannot be read as a picture" in page.message.text()
    np.save(tmp_path / "two.npy", np.zeros((2, 3, 9)))
    opened(page, tmp_path / "two.npy", "responses", qtbot)
    (tmp_path / "in.csv").write_text("1,2\n3,x\n")
    opened(page, tmp_path / "in.csv", "inputs", qtbot)
    assert "row 2" in page.message.text()
    assert not button(page, "import_limb").isEnabled()
    assert own_limb_names() == ()


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
    qtbot.waitUntil(lambda: page.message.text() == "Importing a limb: 25 %")
    # Whoever closes the page and opens it again can cancel it too.
    page.close()
    window.pages.show_limbs()
    again = window.findChildren(QDialog, "limb_page")[-1]
    assert again is not page
    button(again, "cancel_import").click()
    qtbot.waitUntil(lambda: again.message.text() == "Cancelled. Nothing was changed.")
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


def test_places_are_clicked_on_a_photograph(user_data, tmp_path, window, page, qtbot):
    responses = np.random.default_rng(1).standard_normal((2, 3, N_TAPS))
    np.save(tmp_path / "two.npy", responses)
    picture = QImage(200, 300, QImage.Format.Format_RGB32)
    picture.fill(Qt.GlobalColor.lightGray)
    picture.save(str(tmp_path / "hand.png"))
    opened(page, tmp_path / "two.npy", "responses", qtbot)
    assert page.form.name.text() == "two"
    assert page.message.text() == "0 of 2 inputs have a place: click them, or open a table."
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
    assert page.message.text().startswith("Click both ends of the hand's length")
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
    assert page.message.text() == "Ready to import."
    for what, points, message in (
        ("inputs", 7, "0 of 31 outputs"),
        ("outputs", 31, "Click the corners of the outline"),
        ("outline", 3, "Click both ends of the hand's length"),
        ("hand", 2, "Ready to import."),
    ):
        for k in range(points):
            page._take(page.draft.with_point(what, (10.0 * k, 7.0 * k * k)))
        assert page.message.text().startswith(message)


@pytest.fixture(scope="module")
def process():
    with LimitedProcess() as process:
        yield process


def png_of(width, height):
    """A picture that says it is so large, and holds nothing."""

    def chunk(kind, content):
        whole = kind + content
        return struct.pack(">I", len(content)) + whole + struct.pack(">I", zlib.crc32(whole))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", b"") + chunk(b"IEND", b"")


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("drawing.png", b"<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/>"),
        ("bomb.png", png_of(200_000, 200_000)),
        ("cut.png", png_of(64, 64)),
        ("none.jpg", b""),
    ],
)
def test_what_is_no_photograph_is_refused_and_the_next_is_read(tmp_path, process, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(RecordingError, match="cannot be read as a picture") as caught:
        photograph.read(tmp_path / name, process)
    assert name in str(caught.value)
    QImage(8, 8, QImage.Format.Format_RGB32).save(str(tmp_path / "next.bmp"))
    assert photograph.read(tmp_path / "next.bmp", process).width() == 8


def test_nothing_is_said_of_a_job_of_another_page(qtbot):
    runner, gate, messages, ended = JobRunner(), Event(), [], []
    page = PageJobs(runner, runner)
    page.progressed.connect(lambda job, progress: messages.append((job, progress.done)))
    for signal in (page.done, page.failed, page.cancelled):
        signal.connect(lambda *_: ended.append(1))
    own = Job("Importing a limb", lambda progress, stop: gate.wait(30.0))
    other = Job("Exporting a.csv", lambda progress, stop: None)
    page.add(own)
    for job in (other, own):
        runner.progressed.emit(job, JobProgress(done=1, total=2))
    assert messages == [(own, 1)]
    runner.done.emit(other, None)
    runner.failed.emit(other, ValueError("x"))
    runner.cancelled.emit(other)
    assert (ended, page.busy) == ([], True)
    gate.set()
    qtbot.waitUntil(lambda: ended == [1])
    assert not page.busy
    runner.close()


def button(page, name):
    return page.findChild(QPushButton, name)


def opened(page, path, what, qtbot):
    page.open_file(path, what)
    qtbot.waitUntil(lambda: not page.worker.busy, timeout=60_000)


def imported(page, name, qtbot):
    button(page, "import_limb").click()
    qtbot.waitUntil(lambda: page.message.text().startswith("Imported as"), timeout=60_000)
    assert name in own_limb_names()


@pytest.fixture
def page(window, qtbot):
    window.pages.show_limbs()
    page = window.findChild(QDialog, "limb_page")
    yield page
    page.close()
