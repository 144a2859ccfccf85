"""Stores with another content than the installation writes."""

import json
from pathlib import Path
from zipfile import ZipFile, ZipInfo

from skinsource.limbs.dataset import published


def offset_of(path: Path, name: str) -> int:
    """First byte of an array in a store."""
    with ZipFile(path) as store:
        info = store.getinfo(f"{name}.npy")
        return info.header_offset + 30 + len(info.filename)


def flip(path: Path, offset: int) -> None:
    """Turn a bit."""
    content = bytearray(path.read_bytes())
    content[offset] ^= 1
    path.write_bytes(content)


def rewrite(path: Path, *without: str, **about: object) -> None:
    """Write a store again, without some of its members, and with other facts about it."""
    with ZipFile(path) as store:
        contents = {name: store.read(name) for name in store.namelist() if name not in without}
    facts = {**json.loads(contents[published.ABOUT]), **about}
    facts = {name: value for name, value in facts.items() if value is not None}
    contents[published.ABOUT] = json.dumps(facts).encode()
    with ZipFile(path, "w") as store:
        for name, content in contents.items():
            store.writestr(ZipInfo(name), content)
