"""Where one-line faults can be planted in the product, and how a planted one is found again.

A fault is a changed line of a function.  It is kept as texts without a line number: it can be
planted again after the code around it has moved, even to another file.
"""

import ast
import random
from collections.abc import Iterable, Iterator
from dataclasses import astuple, dataclass
from fnmatch import fnmatch
from itertools import islice
from pathlib import Path
from typing import NamedTuple

PRODUCT = ("core/skinsource", "skinsource_gui")

#: Files that were about to be rewritten when the places were drawn.
LEFT_OUT = (
    "core/skinsource/base/child_process.py",
    "core/skinsource/base/crash_log.py",
    "core/skinsource/base/lock.py",
    "core/skinsource/export/stimulus_export/*",
    "core/skinsource/limbs/dataset/*",
    "core/skinsource/limbs/reading_child.py",
    "core/skinsource/readers/*process*",
    "core/skinsource/readers/limits.py",
    "core/skinsource/studies/sweeps/*",
    "skinsource_gui/fields/*editor*",
    "skinsource_gui/fields/number_field.py",
    "skinsource_gui/panels/compare/*",
    "skinsource_gui/panels/timeline/head*",
    "skinsource_gui/shell/dock*",
    "skinsource_gui/state/conductor.py",
    "skinsource_gui/state/engine.py",
    "skinsource_gui/state/job*",
)
#: Of these only functions outside of classes: the classes were about to be rewritten.
WITHOUT_CLASSES = "core/skinsource/export/formats/*"
#: Functions of which only people read what they return.
FOR_PEOPLE = {"__repr__", "__str__"}
#: Calls that are a matter of taste, or give names to widgets.
TASTE = {
    "setContentsMargins", "setSpacing", "setStretch", "setStretchFactor", "addStretch",
    "addSpacing", "setZValue", "setMinimumWidth", "setMinimumHeight", "QSize", "resize",
    "setHorizontalSpacing", "setVerticalSpacing", "setAlignment", "setWordWrap", "setObjectName",
    "setPen", "setBrush", "setCapStyle", "setRenderHint", "setFont", "show_font",
}  # fmt: skip
KINDS = ("comparison", "arithmetic", "logic", "constant", "argument", "result", "call")

Function = ast.FunctionDef | ast.AsyncFunctionDef
BLOCKS = ast.FunctionDef | ast.ClassDef | ast.If | ast.For | ast.While | ast.With | ast.Try

TURNED: dict[type[ast.AST], tuple[str, str]] = {
    ast.Lt: ("<", ">="), ast.GtE: (">=", "<"), ast.Gt: (">", "<="), ast.LtE: ("<=", ">"),
    ast.Eq: ("==", "!="), ast.NotEq: ("!=", "=="), ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"), ast.In: ("in", "not in"), ast.NotIn: ("not in", "in"),
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"),
    ast.FloorDiv: ("//", "*"), ast.Mod: ("%", "//"), ast.Pow: ("**", "*"),
    ast.BitAnd: ("&", "|"), ast.And: ("and", "or"), ast.Or: ("or", "and"),
}  # fmt: skip


@dataclass(frozen=True)
class Fault:
    """A line of a function and what it is changed to, both without the blanks around them."""

    file: str
    function: str
    kind: str
    line: str
    changed: str


class Change(NamedTuple):
    """Other text in a line; the columns count bytes."""

    kind: str
    number: int
    start: int
    end: int
    text: str


class Place(NamedTuple):
    """Where the line of a fault stands: its file, its number, the lines of its statement."""

    file: str
    number: int
    statement: range


def product_files(project: Path) -> list[str]:
    """Name the files of the product, beginning at the project's folder."""
    paths = [path for folder in PRODUCT for path in sorted((project / folder).rglob("*.py"))]
    return [path.relative_to(project).as_posix() for path in paths]


def draw(project: Path, seed: int, count: int) -> list[Fault]:
    """Draw faults by lot, as many of each kind."""
    files = [
        file
        for file in product_files(project)
        if not any(fnmatch(file, pattern) for pattern in LEFT_OUT)
    ]
    texts = {file: (project / file).read_text("utf-8") for file in files}
    optional = _optional_arguments(texts.values())
    possible = [fault for file in files for fault in _faults_of(file, texts[file], optional)]
    drawn: list[Fault] = []
    for k, kind in enumerate(KINDS):
        of_kind = sorted((fault for fault in possible if fault.kind == kind), key=astuple)
        random.Random(seed + k).shuffle(of_kind)  # noqa: S311
        whole = (fault for fault in of_kind if _is_python(texts[fault.file], fault))
        drawn += islice(whole, count * (k + 1) // len(KINDS) - count * k // len(KINDS))
    return sorted(drawn, key=astuple)


def find(project: Path, fault: Fault) -> Place | None:
    """Look a fault's line up: in its file, else in any with a function of that name."""
    for file in [fault.file, *product_files(project)]:
        path = project / file
        text = path.read_text("utf-8") if path.exists() else ""
        if fault.line not in text:
            continue
        lines = text.splitlines()
        for name, function in _functions(ast.parse(text)):
            if name != fault.function:
                continue
            for number in range(function.lineno, (function.end_lineno or 0) + 1):
                if lines[number - 1].strip() == fault.line:
                    return Place(file, number, _statement_at(function, number))
    return None


def plant(project: Path, fault: Fault, place: Place) -> None:
    """Change the line in a copy of the project."""
    path = project / place.file
    lines = path.read_text("utf-8").splitlines(keepends=True)
    old = lines[place.number - 1]
    lines[place.number - 1] = old.replace(fault.line, fault.changed)
    path.write_text("".join(lines), "utf-8")


def _functions(tree: ast.AST, prefix: str = "") -> Iterator[tuple[str, Function]]:
    """Functions and methods with their qualified names; one in a function belongs to it."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, Function):
            yield prefix + node.name, node
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, f"{prefix}{node.name}.")
        else:
            yield from _functions(node, prefix)


def _statement_at(function: Function, number: int) -> range:
    """The lines of the innermost statement with this line; of a block only its head."""
    lines = range(number, number + 1)
    for node in ast.walk(function):  # outer ones come first
        if isinstance(node, ast.stmt):
            body = node.body if isinstance(node, BLOCKS) else []
            end = body[0].lineno - 1 if body else node.end_lineno or 0
            if node.lineno <= number <= end:
                lines = range(node.lineno, end + 1)
    return lines


def _optional_arguments(texts: Iterable[str]) -> set[tuple[str, str]]:
    """Names of functions and classes of ours, with arguments that may be left out."""
    names = set()
    for text in texts:
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, Function):
                positional = node.args.args[len(node.args.args) - len(node.args.defaults) :]
                keywords = zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True)
                optional = positional + [one for one, default in keywords if default]
                names |= {(node.name, argument.arg) for argument in optional}
            elif isinstance(node, ast.ClassDef):
                fields = [f for f in node.body if isinstance(f, ast.AnnAssign) and f.value]
                names |= {
                    (node.name, f.target.id) for f in fields if isinstance(f.target, ast.Name)
                }
    return names


def _is_python(text: str, fault: Fault) -> bool:
    """Whether a file can still be read when the line is changed: parentheses may be left over."""
    try:
        ast.parse(text.replace(fault.line, fault.changed))
    except SyntaxError:
        return False
    return True


def _faults_of(file: str, text: str, optional: set[tuple[str, str]]) -> Iterator[Fault]:
    """All faults that can be planted in a file."""
    lines = text.splitlines()
    for name, function in _functions(ast.parse(text)):
        inside = [one.strip() for one in lines[function.lineno - 1 : function.end_lineno]]
        if function.name in FOR_PEOPLE or ("." in name and fnmatch(file, WITHOUT_CLASSES)):
            continue
        for change in _changes(function, lines, optional):
            old = lines[change.number - 1].encode()
            new = old[: change.start] + change.text.encode() + old[change.end :]
            line, changed = old.decode().strip(), new.decode().strip()
            if inside.count(line) == 1 and changed != line:
                yield Fault(file, name, change.kind, line, changed)


def _code(node: ast.AST) -> Iterator[ast.AST]:
    """What a function does: no annotations, defaults and texts, no sentences of errors."""
    for name, value in ast.iter_fields(node):
        hidden = name in {"annotation", "args", "returns", "decorator_list", "type_params"}
        if hidden and not isinstance(node, ast.Call):
            continue
        if isinstance(node, ast.While) and name == "test":  # it would never end
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not isinstance(
                child, ast.Raise | ast.Assert | ast.JoinedStr | ast.ClassDef
            ):
                yield child
                yield from _code(child)


def _changes(
    function: Function, lines: list[str], optional: set[tuple[str, str]]
) -> Iterator[Change]:
    """Changes of one line each."""
    taste = {
        id(part)
        for node in _code(function)
        if isinstance(node, ast.Call) and _name_of(node.func) in TASTE
        for part in ast.walk(node)
    }
    returns = ast.unparse(function.returns) if function.returns else ""
    for node in _code(function):
        if id(node) in taste:
            continue
        if isinstance(node, ast.stmt):
            yield from _changes_of_statement(node, returns, lines)
        elif isinstance(node, ast.expr) and _is_short(node):
            line = lines[node.lineno - 1].encode()
            yield from _changes_of_operation(node, line)
            if isinstance(node, ast.Call):
                yield from _dropped_arguments(node, optional)


def _changes_of_statement(node: ast.stmt, returns: str, lines: list[str]) -> Iterator[Change]:
    """A condition turned, a call left out, another result of the same type."""
    match node:
        case ast.If(test=ast.Name() | ast.Attribute() | ast.Call() as test) if _is_short(test):
            yield Change("logic", test.lineno, test.col_offset, test.col_offset, "not ")
        case ast.Expr(value=ast.Call(func=called)) if _is_short(node):
            texts = ("super()", "log", "warn")
            if _name_of(called) not in TASTE and not any(
                text in ast.unparse(called) for text in texts
            ):
                yield Change("call", *_span(node), "pass")
        case ast.Return(value=ast.expr() as value) if _is_short(node):
            number, start, end = _span(value)
            text = lines[number - 1].encode()[start:end].decode()
            if isinstance(value, ast.Constant) or text == "()":
                return
            if returns == "bool":
                yield Change("result", number, start, end, f"not ({text})")
            elif returns in {"int", "float"} and "nan" not in text:
                yield Change("result", number, start, end, f"2 * ({text})")
            elif returns.endswith("| None"):
                yield Change("result", number, start, end, "None")
            elif returns.startswith("tuple[") and returns.endswith("...]"):
                yield Change("result", number, start, end, "()")


def _changes_of_operation(node: ast.expr, line: bytes) -> Iterator[Change]:
    """An operator turned, a constant changed."""
    match node:
        case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in TURNED:
            yield _turned("comparison", line, left, op, right)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in TURNED:
            if not (_is_text(left) or _is_text(right)):
                yield _turned("arithmetic", line, left, op, right)
        case ast.BoolOp(op=op, values=[left, right]):
            yield _turned("logic", line, left, op, right)
        case ast.UnaryOp(op=ast.Not()):
            yield Change("logic", node.lineno, node.col_offset, node.col_offset + 4, "")
        case ast.Constant(value=bool() as value):
            yield Change("constant", *_span(node), str(not value))
        case ast.Constant(value=int() | float() as value):
            other = value + 1 if isinstance(value, int) else 2 * value or 1.0
            yield Change("constant", *_span(node), repr(other))


def _dropped_arguments(call: ast.Call, optional: set[tuple[str, str]]) -> Iterator[Change]:
    """A keyword left to its default."""
    before: list[ast.expr | ast.keyword] = [*call.args, *call.keywords]
    for place, keyword in enumerate(call.keywords, start=len(call.args)):
        if (_name_of(call.func), keyword.arg or "") in optional:
            start = before[place - 1].end_col_offset if place else keyword.col_offset
            yield Change("argument", call.lineno, start or 0, keyword.end_col_offset or 0, "")


def _turned(kind: str, line: bytes, left: ast.expr, op: ast.AST, right: ast.expr) -> Change:
    """Turn what stands between two operands, beside their parentheses."""
    start, end = left.end_col_offset or 0, right.col_offset
    text = line[start:end].decode().replace(*TURNED[type(op)], 1)
    return Change(kind, left.lineno, start, end, text)


def _is_short(node: ast.expr | ast.stmt) -> bool:
    return node.lineno == node.end_lineno


def _span(node: ast.expr | ast.stmt) -> tuple[int, int, int]:
    return node.lineno, node.col_offset, node.end_col_offset or 0


def _name_of(called: ast.expr) -> str:
    return called.attr if isinstance(called, ast.Attribute) else ast.unparse(called)


def _is_text(node: ast.expr) -> bool:
    """Whether operators join it: texts, lists, paths."""
    joined = isinstance(node, ast.JoinedStr | ast.List | ast.Tuple | ast.ListComp)
    is_text = isinstance(node, ast.Constant) and isinstance(node.value, str)
    is_path = any(part in ast.unparse(node).lower() for part in ("path", "folder", "director"))
    return joined or is_text or is_path
