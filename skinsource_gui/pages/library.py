"""Edit > Save to library…: asks which clips become a preset, and under which name."""

from dataclasses import dataclass

from PySide6 import QtWidgets
from PySide6.QtCore import Signal

from skinsource.base.errors import InvalidInputError, counted
from skinsource.design import edits
from skinsource.design.clips import Fragment
from skinsource.design.design import Design, View
from skinsource.design.presets.presets import Preset, tags_of, whole_design
from skinsource_gui.fields.choice_field import DropDown
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.qt.buttons import Answer, answers
from skinsource_gui.qt.layouts import add_row, in_column


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """Clips that can be saved, their text in the list of choices, and a suggested name."""

    text: str
    name: str
    fragment: Fragment


def fragments_to_save(design: Design, view: View) -> tuple[Choice, ...]:
    """Return selected clips, clips of the selected tracks, and the whole design; each once."""
    tracks = [track for track in design.inputs if track.id in view.selected_inputs]
    on_tracks = tuple(clip.id for track in tracks for clip in track.clips)
    choices: list[Choice] = []
    for text, ids in (
        ("Selected", view.selected_clips),
        ("On the selected tracks" if len(tracks) > 1 else "On the selected track", on_tracks),
    ):
        fragment = edits.fragment_of(design, ids)
        if fragment is not None:
            choices.append(_choice(text, _name(fragment), fragment))
    everything = whole_design(design)
    if everything is not None:
        choices.append(_choice("The whole design", design.title or _name(everything), everything))
    once: list[Choice] = []
    for choice in choices:
        if all(choice.fragment != other.fragment for other in once):
            once.append(choice)
    return tuple(once)


def _choice(text: str, name: str, fragment: Fragment) -> Choice:
    clips = counted(sum(len(lane.clips) for lane in fragment.lanes), "clip")
    if len(fragment.lanes) > 1:
        clips += f" on {len(fragment.lanes)} tracks"
    return Choice(text=f"{text}: {clips}", name=name[:100], fragment=fragment)


def _name(fragment: Fragment) -> str:
    first = fragment.lanes[0].clips[0]
    return first.label.strip() or first.waveform.title


TITLE = "Save to library"


class SavePage(ToolPage):
    """Asks what is saved, and for its name, tags, description and source.

    Parameters
    ----------
    choices
        What can be saved, the likeliest first; at least one.
    """

    #: `Preset`.
    chosen = Signal(object)

    def __init__(self, choices: tuple[Choice, ...], parent: QtWidgets.QWidget) -> None:
        super().__init__(parent, "save_to_library_page", TITLE)
        self.setMinimumWidth(460)
        self._choices = choices
        self.what = DropDown()
        self.what.addItems([choice.text for choice in choices])
        self.name, self.tags = QtWidgets.QLineEdit(), QtWidgets.QLineEdit()
        self.description, self.source = QtWidgets.QLineEdit(), QtWidgets.QLineEdit()
        self.message.hide()
        self.buttons = answers(self, Answer.Save)
        form = QtWidgets.QFormLayout()
        self.tags.setPlaceholderText("with commas between: tap, texture")
        self.description.setPlaceholderText("what it is for")
        self.source.setPlaceholderText("where its numbers come from")
        for label, field, name in (
            ("Keep", self.what, "library_what"),
            ("Name", self.name, "library_name"),
            ("Tags", self.tags, "library_tags"),
            ("Description", self.description, "library_description"),
            ("Source", self.source, "library_source"),
        ):
            add_row(form, name, label, field)
        in_column(form, self.message, None, self.buttons, of=self)
        self.what.currentIndexChanged.connect(self._suggest)
        self.name.textChanged.connect(self._check)
        self._suggest()
        self.name.setFocus()

    def show_problem(self, text: str) -> None:
        """Show why it was not saved; the page stays."""
        self.complain(text)
        self.message.show()

    def _suggest(self) -> None:
        suggested = {choice.name for choice in self._choices}
        # What was typed stays.
        if not self.name.text() or self.name.text() in suggested:
            self.name.setText(self._choices[self.what.currentIndex()].name)
            self.name.selectAll()
        self._check()

    def _check(self) -> None:
        self.buttons.button(Answer.Save).setEnabled(bool(self.name.text().strip()))

    def accept(self) -> None:
        try:
            preset = Preset(
                name=" ".join(self.name.text().split()),
                tags=tags_of(self.tags.text()),
                source=self.source.text().strip(),
                description=self.description.text().strip(),
                fragment=self._choices[self.what.currentIndex()].fragment,
            )
        except InvalidInputError as error:
            self.show_problem(str(error))
            return
        self.chosen.emit(preset)
