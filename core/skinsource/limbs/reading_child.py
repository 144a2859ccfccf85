"""The process in which foreign files are read: ``python -m skinsource.limbs.reading_child``.

A parser that crashes, hangs or fills the memory takes this process down, and nothing else.

It reads requests from its input, one JSON text a line:

- ``{"do": "look", "path": ...}``, answered by ``{"found": ...}``;
- ``{"do": "read", "path": ..., "keys": [...], "start": ..., "stop": ...}``, answered by blocks,
  ``{"block": [series, samples, "f4" or "f8"]}`` followed by their bytes, and ``{"end": true}``;
- ``{"do": "overview", "path": ..., "key": ..., "samples": ..., "columns": ...}``, answered by
  ``{"done": samples}`` while it is at work, one block of least and largest, and ``{"end": true}``.

- ``{"do": "limb", "points" or "arrays", "path": ...}`` and ``{"do": "responses", ...}``, answered
  by what `skinsource.limbs.limb_import` finds, and blocks as above.

Instead of any of them comes ``{"error": sentence, "kind": "format" or "storage"}``.  It ends when
its input does.
"""

import json
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

import numpy as np

from skinsource.base.child_process import limit_memory, limit_time, own_output
from skinsource.base.errors import FileFormatError, SkinSourceError
from skinsource.base.files import path_text
from skinsource.base.quoting import printable
from skinsource.limbs import limb_import
from skinsource.readers import limits, readers
from skinsource.readers.reader import Overview, to_tree

# Longest computing time of an answer; the parent waits for less, but it may have ended.
_CPU_S = 120


def main() -> None:
    """Answer requests until there are no more."""
    answers = own_output()
    warnings.simplefilter("ignore")
    limit_memory(limits.MEMORY_BYTES)
    _answer(answers, {"ready": True})
    for line in sys.stdin.buffer:
        limit_time(_CPU_S)
        request = json.loads(line)
        path = Path(request["path"])
        try:
            _carry_out(answers, request, path)
        except SkinSourceError as error:
            kind = "format" if isinstance(error, FileFormatError) else "storage"
            _answer(answers, {"error": str(error), "kind": kind})
        except MemoryError:
            _fail(
                answers, request, path, f"it needs more than {limits.MEMORY_BYTES} bytes of memory"
            )
        except Exception as error:  # noqa: BLE001  on a damaged file a parser may fail in any way
            _fail(answers, request, path, f"{printable(error) or type(error).__name__}")


def _carry_out(answers: IO[bytes], request: dict[str, Any], path: Path) -> None:
    if request["do"] == "look":
        _answer(answers, {"found": to_tree(readers.look(path))})
        return
    if request["do"] == "overview":
        _answer_overview(answers, request, path)
        return
    if request["do"] in ("limb", "points", "arrays"):
        _answer(answers, limb_import.look(request, path))
        return
    for block in _blocks(request, path):
        kind = "<f4" if block.dtype == np.float32 else "<f8"
        _answer(answers, {"block": [*block.shape, kind[1:]]}, np.ascontiguousarray(block, kind))
        limit_time(_CPU_S)
    _answer(answers, {"end": True})


def _blocks(request: dict[str, Any], path: Path) -> Iterator[Any]:
    if request["do"] == "responses":
        return limb_import.blocks(request, path)
    return readers.blocks(path, request["keys"], int(request["start"]), int(request["stop"]))


def _answer_overview(answers: IO[bytes], request: dict[str, Any], path: Path) -> None:
    n = int(request["samples"])
    overview = Overview(n, int(request["columns"]))
    for block in readers.blocks(path, [request["key"]], 0, n):
        overview.add(block)
        _answer(answers, {"done": overview.done})
        limit_time(_CPU_S)
    extremes = overview.extremes
    _answer(answers, {"block": [*extremes.shape, "f8"]}, np.ascontiguousarray(extremes, "<f8"))
    _answer(answers, {"end": True})


def _fail(answers: IO[bytes], request: dict[str, Any], path: Path, reason: str) -> None:
    usual = "WAV, FLAC, AIFF, OGG, a table of numbers, NPY, NPZ, MATLAB or HDF5"
    expected = limb_import.EXPECTED.get(request["do"], usual)
    sentence = (
        f"{path_text(Path(path.name))}: cannot be read ({reason.rstrip('.')}), expected "
        f"{expected}. It may be damaged; record or export it again."
    )
    _answer(answers, {"error": sentence, "kind": "format"})


def _answer(answers: IO[bytes], what: dict[str, Any], content: Any = b"") -> None:
    answers.write(json.dumps(what).encode("ascii") + b"\n")
    answers.write(content)
    answers.flush()


if __name__ == "__main__":
    main()
