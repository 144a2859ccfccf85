"""The entries of the File menu."""

from skinsource_gui.pages.files.exports import EXPORTS
from skinsource_gui.shell.actions.spec import ActionSpec, action

FILE: tuple[ActionSpec, ...] = (
    action(
        "new_design",
        "New",
        "Start over with an empty design",
        "Ctrl+N",
        command="files.new",
        keywords="clear empty reset blank",
    ),
    action(
        "open_design",
        "Open…",
        "Open a design file",
        "Ctrl+O",
        command="files.ask_and_open",
        keywords="load read import",
    ),
    action(
        "show_scenes",
        "Scenes…",
        "Open a panel of the paper's figures as a design",
        command="scenes.show",
        keywords="paper figure gallery example examples demo template interference wavelet",
    ),
    action(
        "make_show",
        "Show…",
        "Order designs for a lecture, each with its title, sentence and knob",
        command="presenter.make_show",
        keywords="present lecture slides talk skinshow order list",
    ),
    action(
        "show_left_over",
        "Recover unsaved work…",
        "Open work that an earlier session did not save",
        command="keeping.show",
        keywords="recover restore autosave crash lost backup",
    ),
    action(
        "import_recording",
        "Import recording…",
        "Place a signal from WAV, FLAC, CSV, NPY, MATLAB, HDF5 or others",
        "Ctrl+I",
        command="imports.ask_and_import",
        keywords="open load wav flac aiff ogg csv tsv npy npz mat matlab hdf5 audio",
    ),
    action(
        "own_limbs",
        "Own limbs…",
        "Import impulse responses that you measured yourself, with outline and places",
        command="pages.show_limbs",
        keywords="import limb lab responses hdf5 outline svg photograph mirror left hand",
    ),
    action(
        "check_recording",
        "Check against a recording…",
        "Compare the prediction with recorded responses, and write a report",
        command="pages.show_check",
        keywords="measurement validate compare error correlation linearity superposition report",
    ),
    action(
        "save_design",
        "Save",
        "Save the design",
        "Ctrl+S",
        command="files.save",
        keywords="write store keep",
        separated=True,
    ),
    action(
        "save_design_as",
        "Save as…",
        "Save under another name",
        "Ctrl+Shift+S",
        command="files.ask_and_save",
        keywords="copy rename",
    ),
    action(
        "export",
        "Export…",
        "Write stimulus, pictures, films, tables, data or the whole project",
        "Ctrl+E",
        command="exports.show",
        keywords="save write wav csv png pdf npz zip mp4 actuator",
        separated=True,
    ),
    action(
        "cancel_job",
        "Cancel task",
        "Stop the running export, installation or benchmark, and clean up",
        "Ctrl+.",
        command="jobs.cancel",
        keywords="stop abort export installation benchmark",
    ),
    action(
        "quit_studio",
        "Quit",
        "Close the studio",
        "Ctrl+Q",
        command="frame.close",
        keywords="exit end leave",
        separated=True,
    ),
)

#: Each entry of the dialog, for the palette.
EXPORT_ENTRIES = tuple(
    ActionSpec(
        name=f"export_{export.name}",
        text=export.text,
        hint=export.hint,
        keys=export.keys,
        keywords=f"save write {export.keywords}",
        command="exports.show",
        argument=export.name,
    )
    for export in EXPORTS
)
