"""Checks the list of shipped data files; run as a program it writes the list anew."""

import hashlib
import json
from pathlib import Path

from skinsource.base.assets import data_folder
from skinsource.base.files import write_bytes

NAME = "shipped_files.json"


def described(folder: Path) -> dict:
    """Name, SHA-256 and size of every file below ``folder`` except the list itself."""
    entries = []
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = path.relative_to(folder).as_posix()
        if name != NAME:
            content = path.read_bytes()
            digest = hashlib.sha256(content).hexdigest()
            entries.append({"name": name, "sha256": digest, "size": len(content)})
    return {"files": entries}


def test_the_list_describes_every_shipped_data_file():
    listed = json.loads((data_folder() / NAME).read_text(encoding="utf-8"))
    digests = described(data_folder())
    assert listed == digests, (
        f"data/{NAME} is out of date; write it anew with 'python tests/core/test_shipped_files.py'"
    )


if __name__ == "__main__":
    write_bytes(
        data_folder() / NAME, (json.dumps(described(data_folder()), indent=2) + "\n").encode()
    )
