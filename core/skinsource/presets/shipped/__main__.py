"""Writes the shipped presets to the data folder: ``python -m skinsource.presets.shipped``."""

from skinsource.presets.preset_file import SUFFIX
from skinsource.presets.shelf import shipped_folder
from skinsource.presets.shipped import SHIPPED
from skinsource.presets.storing import save_preset


def main() -> None:
    """Write every file anew, and delete those of presets that are no more."""
    folder = shipped_folder()
    for old in folder.glob(f"*{SUFFIX}"):
        old.unlink()
    for preset in SHIPPED:
        save_preset(folder, preset)


if __name__ == "__main__":
    main()
