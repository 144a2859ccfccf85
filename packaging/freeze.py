"""Build the studio as a folder that needs no Python: ``make frozen``.

It lies in ``build/frozen/skinsource``, for the system it is built on, with docs and examples, and
with ``licences`` of all that it carries.  Printed are its size, how long it takes to start, and
those licences.
"""

import shutil
import subprocess
import sys
import time
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "build/frozen"
FOLDER = WORK / "skinsource"
#: Run in the environment of the build: its packages, with texts of their licences.
LICENCES = r"""
import re, shutil, sys
from importlib.metadata import distributions
from pathlib import Path
out = Path(sys.argv[1])
for package in sorted(distributions(), key=lambda package: package.name.lower()):
    about, texts = package.metadata, []
    if re.match("(?i)pip$|setuptools|altgraph|pyinstaller-hooks", package.name):
        continue
    for file in package.files or ():
        if re.search("(?i)licen[cs]e|copying|notice", file.name) and file.locate().is_file():
            texts.append(file.locate())
    for number, text in enumerate(texts):
        (out / package.name).mkdir(parents=True, exist_ok=True)
        shutil.copy(text, out / package.name / f"{number}-{text.name}")
    kinds = [line.split(" :: ")[-1] for line in about.get_all("Classifier", ())
             if line.startswith("License")]
    said = about.get("License-Expression") or ", ".join(kinds)
    said = said or (about.get("License") or "").split("\n")[0] or "see its texts"
    if package.name == "imageio-ffmpeg":
        said += "; the program ffmpeg in it: GPL-3.0"
    print(f"{package.name} {package.version}: {said}; {len(texts)} texts")
"""


def main() -> None:
    """Build, then print what came out."""
    shutil.rmtree(WORK, ignore_errors=True)
    run(sys.executable, "-m", "build", "--wheel", "--outdir", WORK / "wheel", ROOT)
    (wheel,) = (WORK / "wheel").glob("*.whl")
    venv.create(WORK / "venv", with_pip=True)
    scripts = WORK / "venv" / ("Scripts" if sys.platform == "win32" else "bin")
    run(scripts / "python", "-m", "pip", "install", "--quiet", f"{wheel}[all]", "pyinstaller>=6.22")
    run(
        *(scripts / "pyinstaller", "--noconfirm", "--log-level", "WARN"),
        *("--distpath", WORK, "--workpath", WORK / "work", ROOT / "packaging/skinsource.spec"),
    )
    shutil.copytree(ROOT / "examples", FOLDER / "examples")
    manual = FOLDER / "_internal/skinsource/_manual"
    shutil.copytree(manual / "docs", FOLDER / "docs")
    shutil.copy(manual / "README.md", FOLDER)
    write_licences(scripts / "python")
    size = sum(file.stat().st_size for file in FOLDER.rglob("*") if not file.is_symlink())
    sys.stdout.write((FOLDER / "licences/LICENCES.txt").read_text(encoding="utf-8"))
    begun_s = time.perf_counter()
    run(FOLDER / "skinsource", "--version")
    sys.stdout.write(
        f"{FOLDER}: {size / 1e6:.0f} MB; the command starts in "
        f"{time.perf_counter() - begun_s:.1f} s\n"
    )


def write_licences(python: Path) -> None:
    """Write what each package and each library of the system in the folder is licensed under."""
    out = FOLDER / "licences"
    out.mkdir()
    lines = output(python, "-c", LICENCES, out).splitlines()
    lines.append(f"Python {sys.version.split()[0]}: PSF-2.0")
    if shutil.which("dpkg"):
        lines += sorted(system_libraries(out))
    (out / "LICENCES.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def system_libraries(out: Path) -> set[str]:
    """Copy the copyright files of Debian's packages whose libraries the folder carries."""
    names = [file.name for file in (FOLDER / "_internal").glob("lib*.so*")]
    owners = subprocess.run(  # noqa: S603  names of files
        ["dpkg", "-S", *(f"*/{name}" for name in names)],  # noqa: S607
        capture_output=True,
        text=True,
        check=False,
    ).stdout
    packages = {line.split(":")[0] for line in owners.splitlines() if ":" in line}
    lines = set()
    for package in packages:
        text = Path("/usr/share/doc") / package / "copyright"
        if text.is_file():
            (out / package).mkdir(exist_ok=True)
            shutil.copy(text, out / package)
            lines.add(f"{package} of the system: see licences/{package}/copyright")
    return lines


def run(*command: object) -> None:
    """Run a command, and end with it if it fails."""
    subprocess.run(list(map(str, command)), check=True)  # noqa: S603  our own


def output(*command: object) -> str:
    """Return what a command prints."""
    return subprocess.run(  # noqa: S603  our own
        list(map(str, command)), check=True, capture_output=True, text=True
    ).stdout


if __name__ == "__main__":
    main()
