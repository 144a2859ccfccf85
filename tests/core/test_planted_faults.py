"""One-line faults for the nightly check of the tests: they are found again, and planted."""

from pathlib import Path

from tests.nightly.planted_faults import Fault, find, plant

CODE = """
class Meter:
    def louder(self, level, *, by=1.0):
        return level + by
"""
FAULT = Fault("core/skinsource/levels.py", "Meter.louder", "return level + by", "return level - by")


def test_a_fault_is_found_where_its_function_has_gone_until_its_line_is_rewritten(tmp_path: Path):
    file = tmp_path / "core" / "skinsource" / "moved" / "loudness.py"
    file.parent.mkdir(parents=True)
    file.write_text(CODE, "utf-8")
    place = find(tmp_path, FAULT)
    assert place == ("core/skinsource/moved/loudness.py", 4)
    plant(tmp_path, FAULT, place)
    assert file.read_text("utf-8") == CODE.replace("+", "-")
    assert find(tmp_path, FAULT) is None
