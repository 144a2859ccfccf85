"""One-line faults for the nightly check of the tests: drawn by lot, found again, planted."""

import ast
from pathlib import Path

import pytest

from tests.nightly.fault_places import KINDS, Fault, draw, find, plant

CODE = '''
"""A module of a product."""


def louder(level, *, by=1.0):
    """Return a level, or refuse one that is no number."""
    if not isinstance(level, float):
        raise TypeError("no level + 1")
    return level + by


class Meter:
    def peak(self, levels) -> float:
        highest = max(level for level in levels if level > 0.0 and level < 9.0)
        self.show(louder(highest, by=2.0))
        return highest
'''
FAULT = Fault(
    "core/skinsource/levels.py", "louder", "arithmetic", "return level + by", "return level - by"
)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "core" / "skinsource"
    folder.mkdir(parents=True)
    (folder / "levels.py").write_text(CODE, "utf-8")
    return tmp_path


def test_each_fault_changes_one_line_that_can_still_be_read(project: Path) -> None:
    file = project / "core" / "skinsource" / "levels.py"
    faults = draw(project, seed=1, count=len(KINDS))
    assert {fault.kind for fault in faults} == set(KINDS)
    assert draw(project, seed=1, count=len(KINDS)) == faults
    for fault in faults:
        place = find(project, fault)
        assert place is not None
        plant(project, fault, place)
        changed = file.read_text("utf-8")
        ast.parse(changed)
        pairs = zip(CODE.splitlines(), changed.splitlines(), strict=True)
        assert [new.strip() for old, new in pairs if old != new] == [fault.changed]
        assert "no level + 1" in changed
        file.write_text(CODE, "utf-8")


def test_a_fault_is_found_where_its_function_has_gone(project: Path) -> None:
    folder = project / "core" / "skinsource"
    (folder / "moved").mkdir()
    (folder / "levels.py").rename(folder / "moved" / "loudness.py")
    place = find(project, FAULT)
    assert place is not None
    assert (place.file, place.number) == ("core/skinsource/moved/loudness.py", 9)


def test_a_fault_whose_line_was_rewritten_is_gone(project: Path) -> None:
    file = project / "core" / "skinsource" / "levels.py"
    file.write_text(CODE.replace("return level + by", "return by + level"), "utf-8")
    assert find(project, FAULT) is None
