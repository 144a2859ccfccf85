import gc

from skinsource_gui.state.document import MOST_STEPS, Document, ReplaceDesign
from skinsource_gui.state.preferences import start_design


def steps_in_memory():
    return sum(isinstance(tracked, ReplaceDesign) for tracked in gc.get_objects())


def test_the_oldest_steps_are_forgotten_and_freed(qtbot):
    document = Document(start_design("synthetic-1"))
    gc.collect()
    before = steps_in_memory()
    for number in range(MOST_STEPS + 200):
        document.edit("a", document.design.with_clip(1, onset_s=number / 10))
    gc.collect()
    assert document.undo_stack.count() == MOST_STEPS
    assert steps_in_memory() - before == MOST_STEPS
    while document.undo_stack.canUndo():
        document.undo_stack.undo()
    assert document.design.inputs[0].clips[0].onset_s == 19.9


def test_a_document_whose_saved_state_is_forgotten_stays_modified(qtbot, tmp_path):
    document = Document(start_design("synthetic-1"))
    document.mark_saved(tmp_path / "a.skinsource")
    for number in range(MOST_STEPS + 1):
        document.edit("a", document.design.with_clip(1, onset_s=(1 + number) / 10))
    while document.undo_stack.canUndo():
        document.undo_stack.undo()
    assert document.modified
