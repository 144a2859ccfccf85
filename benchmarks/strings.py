"""Lists the strings that users read, where they are, and what is too long or unclear in them."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
#: Kinds of strings by what takes them, a parameter or what is called; "": nobody reads them.
_TAKERS = {
    "label": "label text title short setWindowTitle QLabel QCheckBox QPushButton addAction addMenu",
    "tooltip": "hint setToolTip show_tooltip",
    "help": "help description epilog",
    "error": "Refusal",
    "message": "sentence",
    "": "name get getattr TypeError ValueError ValidationError setObjectName keywords metavar cast",
}
KIND_OF = {name: kind for kind, names in _TAKERS.items() for name in names.split()}
MOST_WORDS = {"label": 4, "tooltip": 12}
BANNED = re.compile(
    r"what plays|\bkept\b|\bshall\b|\basks? for\b|of which\b|\bcome by\b|\bof ours\b|\bis told\b"
)
#: A cure, or a place for one; what begins with "it" is a part of a longer message.
CURE = re.compile(
    r"^its? |expected|must|allowed|\{\}\.?$|\b(?:accept|add|ask|call|change|check|choose|click|"
    r"close|connect|copy|correct|delete|deselect|draw|enter|export|give|hand over|import|install|"
    r"leave|lower|make|match|measure|move|mute|name|open|press|put|raise|remove|resample|run|save|"
    r"see|select|shorten|store|switch|take|try|type|unmute|use|zoom)\b",
    re.IGNORECASE,
)


class Found(NamedTuple):
    """A string that users read."""

    where: str
    kind: str
    text: str

    def faults(self) -> list[str]:
        """Return what is wrong with it; a label with values or a full stop is a sentence."""
        text = self.text.partition("\t")[0]
        is_sentence = self.kind == "label" and ("{}" in text or text.endswith((".", "?")))
        n_words = len(re.findall(r"\S*(?:\w|{})\S*", text))
        most = n_words if is_sentence else MOST_WORDS.get(self.kind, n_words)
        faults = [f"{n_words} words"] if n_words > most else []
        if self.kind == "error":
            n_sentences = len(re.findall(r"[.?!](?=\s|$)|[^.?!\s]$", text))
            faults += [f"{n_sentences} sentences"] * (n_sentences > 2)
            faults += ["no cure"] * (not CURE.search(text))
        return faults + BANNED.findall(text)


def _text_of(node: ast.AST) -> str:
    if isinstance(node, ast.JoinedStr):
        return "".join(_text_of(part) or "{}" for part in node.values)
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def _parameters(tree: ast.Module) -> dict[str, list[str]]:
    """Return the parameters of functions, and the fields of classes."""
    found = {}
    classes = (node for node in tree.body if isinstance(node, ast.ClassDef))
    for node in [*tree.body, *(part for each in classes for part in each.body)]:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = [each.arg for each in node.args.args if each.arg != "self"]
        elif isinstance(node, ast.ClassDef):
            fields = (part.target for part in node.body if isinstance(part, ast.AnnAssign))
            found[node.name] = [ast.unparse(field) for field in fields]
    return found


def _strings(node: ast.AST, kind: str, known: dict[str, list[str]]) -> Iterator[Found]:
    text = _text_of(node)
    if kind and re.search(r"[a-z]{2} \w|^[A-Z][a-z]", text):
        yield Found(str(getattr(node, "lineno", 0)), kind, text)
    parts = [(part, kind) for part in ast.iter_child_nodes(node)]
    if isinstance(node, ast.Call):
        called = getattr(node.func, "attr", getattr(node.func, "id", ""))
        usual = KIND_OF.get(called, "error" if called.endswith("Error") else kind)
        taken = [*zip([*known.get(called, []), *[""] * len(node.args)], node.args, strict=False)]
        taken += [(keyword.arg or "", keyword.value) for keyword in node.keywords]
        parts = [(part, KIND_OF.get(called) or KIND_OF.get(name, usual)) for name, part in taken]
    elif isinstance(node, ast.Expr) and _text_of(node.value):
        parts = []  # a docstring
    elif isinstance(node, ast.JoinedStr):
        parts = [(part, kind) for part in node.values if isinstance(part, ast.FormattedValue)]
    for part, its_kind in parts:
        yield from _strings(part, its_kind, known)


def strings_of_users() -> Iterator[Found]:
    """Yield all strings of the library, the studio and its tables, and the headings of pages."""
    rooms = (ROOT / "core" / "skinsource", ROOT / "skinsource_gui")
    trees = {path: ast.parse(path.read_text("utf-8")) for r in rooms for path in r.rglob("*.py")}
    own = {path: _parameters(tree) for path, tree in trees.items()}
    known = {name: names for each in own.values() for name, names in each.items()}
    for path, tree in sorted(trees.items()):
        for found in _strings(tree, "message", known | own[path]):
            yield found._replace(where=f"{path.relative_to(ROOT)}:{found.where}")
    for table in [ROOT / "data" / "words.toml", *sorted((ROOT / "resources").glob("*.toml"))]:
        other = "message" if table.stem in {"choices", "columns"} else ""
        for key, text in re.findall(r'^(\S+) = "(.*)"', table.read_text("utf-8"), re.MULTILINE):
            if kind := KIND_OF.get(key, other):
                yield Found(str(table.relative_to(ROOT)), kind, text)
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        for heading in re.findall(r"^#+ (.*)", page.read_text("utf-8"), re.MULTILINE):
            yield Found(str(page.relative_to(ROOT)), "heading", heading)


if __name__ == "__main__":
    for each in strings_of_users():
        print(f"{each.where} {each.kind}: {each.text!r}", *each.faults(), sep="  ! ")
