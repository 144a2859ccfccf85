"""Exports that are killed: how many leave half a file under the final name.

Two of three are killed just before or just after a file is moved to its final name, the others at
random times.  Run as a program: ``python killed_exports.py KILLS [SEED]``; it prints what it found
as JSON, and ends with 1 if there was one.
"""

import hashlib
import itertools
import json
import os
import secrets
import signal
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import skinsource as ss

#: Of so many moves one is chosen: all of the first formats of an order, with their sidecars.
MOVES = 10


def designs() -> list[ss.Design]:
    """Two designs whose files differ in length and content."""
    return [
        ss.Design(
            limb="synthetic-1",
            inputs=(ss.track(7, ss.waveforms.Noise(seed=seed, duration_s=0.2 * seed)),),
        )
        for seed in (1, 2)
    ]


def state(path: Path) -> str:
    """What stands under a final name, as a digest over all of it; "" for nothing."""
    if path.is_dir():
        inside = sorted(file for file in path.rglob("*") if file.is_file())
        content = b"".join(
            str(file.relative_to(path)).encode() + file.read_bytes() for file in inside
        )
    elif path.exists():
        content = path.read_bytes()
    else:
        return ""
    return hashlib.sha256(content).hexdigest()


def targets(folder: Path) -> dict[str, Path]:
    """Where each format is written to."""
    return {name: folder / f"stimulus.{name}" for name in ss.export_formats()}


def export_without_end(folder: Path, order: list[str]) -> None:
    """Replace all files again and again, by those of the other design."""
    both = designs()
    while True:
        for name in order:
            path = targets(folder)[name]
            for design in both:
                ss.export_stimulus(design, path, format=name)


def die_at_move(number: int, *, after: bool) -> None:
    """Kill this process at its ``number``-th move, from 0: before it, or after it."""
    move = Path.replace
    moves = itertools.count()

    def replace(self: Path, target: Path) -> Path:
        last = next(moves) == number
        if last and not after:
            os.kill(os.getpid(), signal.SIGKILL)
        moved = move(self, target)
        if last:
            os.kill(os.getpid(), signal.SIGKILL)
        return moved

    Path.replace = replace


def whole_states(folder: Path) -> set[str]:
    """Digests of all whole files and sidecars."""
    states = {""}
    for design in designs():
        for name, path in targets(folder).items():
            ss.export_stimulus(design, path, format=name)
            states |= {state(path), state(path.with_name(f"{path.name}.json"))}
    return states


def kill_exports(folder: Path, kills: int, seed: int) -> dict:
    """Kill ``kills`` children, and look at all final names after each."""
    whole = whole_states(folder)
    rng = np.random.default_rng(seed)
    broken: list[str] = []
    states: set[str] = set()
    at_moves = 0
    for kill in range(kills):
        order = rng.permutation(ss.export_formats()).tolist()
        number, at_move = int(rng.integers(MOVES)), kill % 3 < 2
        child = os.fork()
        if child == 0:
            if at_move:
                die_at_move(number, after=kill % 3 == 1)
            export_without_end(folder, order)
        if not at_move:
            time.sleep(rng.uniform(0.0, 0.3))
            os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        at_moves += at_move
        for path in targets(folder).values():
            for target in (path, path.with_name(f"{path.name}.json")):
                states.add(state(target))
                if state(target) not in whole:
                    broken.append(target.name)
    return {"seed": seed, "at_moves": at_moves, "broken": broken, "states": len(states)}


if __name__ == "__main__":
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else secrets.randbelow(2**31)
    with tempfile.TemporaryDirectory() as name:
        found = kill_exports(Path(name), int(sys.argv[1]), seed)
    sys.stdout.write(f"{json.dumps(found)}\n")
    sys.exit(1 if found["broken"] else 0)
