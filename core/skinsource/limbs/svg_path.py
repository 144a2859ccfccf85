"""Outlines from SVG paths and polygons, with the transforms around them; for the child process."""

import re
from collections.abc import Iterator
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.errors import quoted

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_TOKEN = re.compile(rf"([MmLlHhVvCcSsQqTtAaZz])|({_NUMBER})|([\s,]+)")
_FLAG = re.compile(r"(\b\B)|([01])|([\s,]+)")
_TRANSFORM = re.compile(r"(matrix|translate|scale|rotate)\s*\(([^)]*)\)")
_COUNTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
#: Straight pieces that a curve becomes.
PIECES = 24
_MOST_POINTS = 200_000
Affine = Floats


def outline_of(svg: bytes) -> Floats:
    """Return the closed line of an SVG with the largest area, (n, 2); y points down.

    Raises
    ------
    ValueError
        There is none, or the text is no SVG.
    """
    try:
        root = ElementTree.fromstring(svg)  # noqa: S314  in the child, without entities of its own
    except ElementTree.ParseError as error:
        raise ValueError(f"it is no SVG ({error})") from error
    lines = [line for line in _lines(root, np.eye(3), 0) if len(line) >= 3]
    if not lines:
        raise ValueError("it has no path or polygon with an inside")
    return max(lines, key=_area)


def _area(line: Floats) -> float:
    x, y = line.T
    return abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))


def _lines(element: ElementTree.Element, outer: Affine, depth: int) -> Iterator[Floats]:
    if depth > 32:
        raise ValueError("it has more than 32 groups in groups")
    here = outer @ _affine(element.get("transform", ""))
    kind = element.tag.rpartition("}")[2]
    if kind in ("defs", "clipPath", "mask", "symbol"):
        return
    if kind == "path":
        for line in path_lines(element.get("d", "")):
            yield _transformed(line, here)
    elif kind in ("polygon", "polyline"):
        numbers = [float(number) for number in re.findall(_NUMBER, element.get("points", ""))]
        yield _transformed(np.array(numbers[: len(numbers) // 2 * 2]).reshape(-1, 2), here)
    for inner in element:
        yield from _lines(inner, here, depth + 1)


def _transformed(line: Floats, affine: Affine) -> Floats:
    return np.asarray(line @ affine[:2, :2].T + affine[:2, 2])


def _affine(text: str) -> Affine:
    affine = np.eye(3)
    for name, inside in _TRANSFORM.findall(text):
        v = [float(number) for number in re.findall(_NUMBER, inside)]
        step = np.eye(3)
        if name == "matrix" and len(v) == 6:
            step[:2] = np.array(v).reshape(3, 2).T
        elif name == "translate" and len(v) in (1, 2):
            step[:2, 2] = v[0], (v[1] if len(v) == 2 else 0.0)
        elif name == "scale" and len(v) in (1, 2):
            step[0, 0], step[1, 1] = v[0], v[-1]
        elif name == "rotate" and len(v) in (1, 3):
            turn = np.deg2rad(v[0])
            step[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
            centre = np.array(v[1:] or (0.0, 0.0))
            step[:2, 2] = centre - step[:2, :2] @ centre
        else:
            raise ValueError(f"its transform {quoted(text)} is not understood")
        affine = affine @ step
    return affine


def path_lines(text: str) -> list[Floats]:
    """Return the lines of a path's text, (n, 2) each, curves in `PIECES` straight pieces.

    Raises
    ------
    ValueError
        It is no text of a path.

    Examples
    --------
    >>> path_lines("M 1,2 h 3 v 4 z")[0].tolist()
    [[1.0, 2.0], [4.0, 2.0], [4.0, 6.0]]
    """
    pen = _Pen()
    for command, numbers in _commands(text):
        pen.draw(command, numbers)
        if sum(map(len, pen.lines)) > _MOST_POINTS:
            raise ValueError(f"it has more than {_MOST_POINTS} points")
    return [np.array(line).reshape(-1, 2) for line in pen.lines if line]


def _commands(text: str) -> Iterator[tuple[str, list[float]]]:
    """Yield each command with as many numbers as it takes."""
    numbers: list[float] = []
    command, at = "", 0
    while at < len(text):
        # The two flags of an arc need nothing between them.
        is_flag = command in ("A", "a") and len(numbers) in (3, 4)
        token = (_FLAG if is_flag else _TOKEN).match(text, at)
        if token is None:
            raise ValueError(f"its path has {quoted(text[at : at + 10])} at {at + 1}")
        letter, number, _ = token.groups()
        at = token.end()
        if letter:
            if numbers:
                raise ValueError(f"its path has too few numbers for {quoted(command)}")
            command = letter
            if command in "Zz":
                yield command, []
        elif number:
            if not command or command in "Zz":
                raise ValueError("its path has a number without a command")
            numbers.append(float(number))
            if len(numbers) == _COUNTS[command.upper()]:
                yield command, numbers
                numbers = []
                # Further pairs after a move are lines.
                command = {"M": "L", "m": "l"}.get(command, command)
    if numbers:
        raise ValueError(f"its path ends within {quoted(command)}")


class _Pen:
    """Draws commands one after another."""

    def __init__(self) -> None:
        self.lines: list[list[Floats]] = []
        self._at = self._start = np.zeros(2)
        # Where the last curve came from, which a smooth one goes on from.
        self._handle: Floats | None = None
        self._handle_of = ""

    def draw(self, command: str, numbers: list[float]) -> None:
        """Carry out one command."""
        kind = command.upper()
        base = self._at if command.islower() else np.zeros(2)
        if kind == "Z":
            self._at = self._start
            self._handle_of = ""
            return
        if kind in "HV":
            end = self._at.copy()
            axis = "HV".index(kind)
            end[axis] = numbers[0] + base[axis]
            self._line(end)
        elif kind == "A":
            self._arc(numbers, base + numbers[5:])
        else:
            points = [base + numbers[k : k + 2] for k in range(0, len(numbers), 2)]
            self._to(kind, points)
        self._handle_of = kind

    def _to(self, kind: str, points: list[Floats]) -> None:
        if kind == "M":
            self._at = self._start = points[0]
            self.lines.append([points[0]])
        elif kind == "L":
            self._line(points[0])
        else:
            if kind in "ST":
                points = [self._mirrored_handle("CS" if kind == "S" else "QT"), *points]
            self._handle = points[-2]
            self._curve([self._at, *points])

    def _mirrored_handle(self, kinds: str) -> Floats:
        if self._handle is None or not self._handle_of or self._handle_of not in kinds:
            return self._at
        return 2 * self._at - self._handle

    def _line(self, end: Floats) -> None:
        if not self.lines:
            raise ValueError("its path does not begin with a move")
        self.lines[-1].append(end)
        self._at = end

    def _curve(self, points: list[Floats]) -> None:
        for t in np.linspace(0.0, 1.0, PIECES + 1)[1:]:
            left = points
            while len(left) > 1:  # de Casteljau
                left = [a + t * (b - a) for a, b in pairwise(left)]
            self._line(left[0])

    def _arc(self, numbers: list[float], end: Floats) -> None:
        """Draw an arc: from end points to centre, as in appendix B.2.4 of SVG 2."""
        rx, ry, turn, large, sweep = abs(numbers[0]), abs(numbers[1]), *numbers[2:5]
        start = self._at
        if rx == 0.0 or ry == 0.0 or np.array_equal(start, end):
            self._line(end)
            return
        angle = np.deg2rad(turn)
        frame = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        half = frame @ (start - end) / 2
        grown = max(1.0, float(np.hypot(half[0] / rx, half[1] / ry)))
        rx, ry = rx * grown, ry * grown
        square = (half[0] / rx) ** 2 + (half[1] / ry) ** 2
        size = np.sqrt(max(0.0, 1.0 / square - 1.0)) * (-1.0 if large == sweep else 1.0)
        centre = size * np.array([rx * half[1] / ry, -ry * half[0] / rx])
        first = np.arctan2((half[1] - centre[1]) / ry, (half[0] - centre[0]) / rx)
        last = np.arctan2((-half[1] - centre[1]) / ry, (-half[0] - centre[0]) / rx)
        way = last - first
        if way < 0.0 and sweep != 0.0:
            way += 2 * np.pi
        elif way > 0.0 and sweep == 0.0:
            way -= 2 * np.pi
        for t in first + way * np.linspace(0.0, 1.0, PIECES + 1)[1:]:
            at = np.array([rx * np.cos(t), ry * np.sin(t)]) + centre
            self._line(frame.T @ at + (start + end) / 2)
        self._at = self.lines[-1][-1] = end
