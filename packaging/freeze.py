"""Build the studio as a folder that needs no Python: ``make frozen``.

It lies in ``build/frozen/skinsource``, and packed beside it, for the system it is built on, with
docs, examples and ``licences`` of all that it carries.  Printed are its size, how long it takes to
start, and those licences.
"""

import platform
import runpy
import shutil
import subprocess
import sys
import time
import venv
from pathlib import Path

from uv import find_uv_bin

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "build/frozen"
FOLDER = WORK / "skinsource"
VERSION = runpy.run_path(str(ROOT / "core/skinsource/version.py"))["__version__"]
SYSTEM = f"{platform.system()} {platform.machine()}"
#: All but Parquet: Arrow takes 160 MB, and only writes tables of sweeps.
EXTRAS = "gui,audio,lsl,dataset,pandas,plot,video"
#: ffmpeg of later ones is twice as large; it reads nothing but our own frames.
OTHERS = ("pyinstaller>=6.22", "imageio-ffmpeg==0.6.0")
#: Parts of Qt that PyInstaller takes along and nothing of ours loads: GTK's theme with forty
#: libraries of the system, screens without a desktop, networks, texts in other languages.
UNUSED = (
    *("platformthemes/*gtk3*", "egldeviceintegrations", "generic", "networkinformation", "tls"),
    *(f"platforms/*{name}*" for name in ("eglfs", "linuxfb", "minimalegl", "vkkhr", "vnc")),
    "translations",
)
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
    venv.create(WORK / "venv")
    scripts = WORK / "venv" / ("Scripts" if sys.platform == "win32" else "bin")
    python = scripts / "python"
    installing = (find_uv_bin(), "pip", "install", "--quiet", "--python", python)
    run(*installing, f"{wheel}[{EXTRAS}]", *OTHERS)
    leave_out(python)
    run(
        *(scripts / "pyinstaller", "--noconfirm", "--log-level", "WARN"),
        *("--distpath", WORK, "--workpath", WORK / "work", ROOT / "packaging/skinsource.spec"),
    )
    shutil.copytree(ROOT / "examples", FOLDER / "examples")
    shutil.copytree(FOLDER / "_internal/skinsource/_manual", FOLDER / "docs")
    for part in ("applications", "icons", "mime"):
        shutil.copytree(WORK / "venv/share" / part, FOLDER / "share" / part)
    write_readme()
    write_licences(python)
    name = f"skinsource-{VERSION}-{SYSTEM}".replace(" ", "-").lower()
    kind = "zip" if sys.platform == "win32" else "gztar"
    packed = Path(shutil.make_archive(str(WORK / name), kind, WORK, FOLDER.name))
    size = sum(file.stat().st_size for file in FOLDER.rglob("*") if not file.is_symlink())
    sys.stdout.write((FOLDER / "licences/LICENCES.txt").read_text(encoding="utf-8"))
    begun_s = time.perf_counter()
    run(FOLDER / "skinsource", "--version")
    sys.stdout.write(
        f"{FOLDER}: {size / 1e6:.0f} MB, packed {packed.stat().st_size / 1e6:.0f} MB; "
        f"the command starts in {time.perf_counter() - begun_s:.1f} s\n"
    )


def leave_out(python: Path) -> None:
    """Remove what the folder does not need from the environment of the build."""
    qt = Path(output(python, "-c", "import PySide6; print(*PySide6.__path__)").strip())
    for found in [path for pattern in UNUSED for path in qt.rglob(pattern)]:
        if found.is_dir():
            shutil.rmtree(found)
        else:
            found.unlink(missing_ok=True)


def write_readme() -> None:
    """Write what a user reads first."""
    libc = " ".join(platform.libc_ver()).strip()
    system = f"{SYSTEM} with {libc} or newer" if libc else SYSTEM
    text = (ROOT / "packaging/folder.txt").read_text(encoding="utf-8")
    text = text.format(version=VERSION, system=system)
    (FOLDER / "README.txt").write_text(text, encoding="utf-8")


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
