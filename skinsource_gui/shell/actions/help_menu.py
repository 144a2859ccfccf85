"""The entries of the Help menu."""

from skinsource_gui.pages.dataset import TITLE
from skinsource_gui.shell.actions.spec import ActionSpec, action

HELP: tuple[ActionSpec, ...] = (
    action(
        "find_action",
        "Search actions…",
        "Type a few letters of anything the studio can do",
        "Ctrl+K",
        command="pages.search",
        short="Search",
        keywords="palette find command",
    ),
    action(
        "show_accuracy",
        "Accuracy and speed…",
        "Targets and results for errors and times, and a benchmark",
        command="pages.show_accuracy",
        keywords="error benchmark precision performance",
    ),
    action(
        "show_keys",
        "Keys and mouse",
        "Every shortcut on one page",
        "F1",
        command="pages.show_keys",
        keywords="help shortcuts keyboard manual",
    ),
    action(
        "show_first_steps",
        "First steps",
        "Show the three hints of the first start",
        command="hints.show",
        keywords="tutorial introduction begin start help hints",
    ),
    action(
        "show_dataset",
        f"{TITLE}…",
        "Install the measured impulse responses, from a folder or by download",
        command="pages.show_dataset",
        keywords="dataset download install limb data matlab zenodo",
    ),
    action(
        "copy_citation",
        "Copy citation",
        "Copy the citation of paper, dataset, this version and the limb",
        command="exports.copy_citation",
        keywords="cite reference bibliography doi paper clipboard",
    ),
    action(
        "show_about",
        "About SkinSource studio",
        "Version, licence, and what to cite",
        command="pages.show_about",
        keywords="version licence cite citation help",
    ),
)
