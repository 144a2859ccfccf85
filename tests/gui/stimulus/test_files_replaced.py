"""File > Export…, Stimulus as many files: what is there already is not lost unasked."""

import pytest
from PySide6.QtWidgets import QMessageBox

from tests.gui.stimulus.stimulus_bench import choose, export

_Answer = QMessageBox.StandardButton


@pytest.fixture
def asked(monkeypatch):
    """Questions that were asked; each was answered with the last of ``answers``."""
    questions, answers = [], [_Answer.Cancel]

    def question(_parent, _title, text, *_):
        questions.append(text)
        return answers[-1]

    monkeypatch.setattr(QMessageBox, "question", question)
    return questions, answers


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_the_file_of_another_channel_is_replaced_only_if_the_user_says_so(
    page, desk, qtbot, save_as, asked, tmp_path
):
    questions, answers = asked
    choose(page, qtbot, "format", "pwle")
    path = save_as("twenty.pwle.json")
    mine = tmp_path / "twenty_channel-2.pwle.json"
    mine.write_text("mine")
    export(desk, page, qtbot)
    assert questions == ["twenty_channel-2.pwle.json exists already. Replace it?"]
    assert (mine.read_text(), path.exists()) == ("mine", False)
    answers.append(_Answer.Yes)
    # The dialog stayed open.
    export(desk, page, qtbot)
    assert path.exists()
    assert mine.read_text() != "mine"


def test_a_sidecar_that_is_there_without_its_file_is_not_lost_unasked(
    page, desk, qtbot, save_as, asked, tmp_path
):
    save_as("drive.wav")
    (tmp_path / "drive.wav.json").write_text("mine")
    export(desk, page, qtbot)
    assert asked[0] == ["drive.wav.json exists already. Replace it?"]
    assert contents(tmp_path).get("drive.wav.json") == b"mine"
