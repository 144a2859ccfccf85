"""Reads files of version 1 in a process of its own.

Nothing but checksums of HDF5's own lies over them: HDF5 itself has to look at every byte, and no
file shall take the studio down.  What the process found comes back as a file of today, whose
checksum is verified like that of any other.
"""

import subprocess
from collections.abc import Sequence

from skinsource.design_file import version_1
from skinsource.errors import FileFormatError, InvalidInputError, StorageError
from skinsource.files.assets import PACKAGE
from skinsource.files.child_limits import child_command, child_environment

#: The process; it says first which of these follows.
COMMAND = child_command("skinsource.design_file.version_1_child")
FOUND, DAMAGED, REFUSED = b"found\n", b"damaged\n", b"refused\n"
#: Starting Python on a busy machine is most of it.
LONGEST_S = 60.0
_GIVEN_UP = "{reason}, so it was given up. The file is damaged; go back to an earlier copy."


def as_today(image: bytes, command: Sequence[str] = COMMAND, longest_s: float = LONGEST_S) -> bytes:
    """Return the image of a file of today with the same content.

    Raises
    ------
    FileFormatError
        It is no file of version 1, it is damaged, or reading it crashed or took too long.
    InvalidInputError
        It holds what no design may hold.
    StorageError
        No process can be started.
    """
    version_1.check_beginning(image)
    try:
        done = subprocess.run(  # noqa: S603  ourselves
            list(command),
            input=image,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=child_environment(str(PACKAGE.parent)),
            timeout=longest_s,
            check=False,
        )
    except subprocess.TimeoutExpired as error:
        raise FileFormatError(_GIVEN_UP.format(reason="reading it takes too long")) from error
    except OSError as error:
        raise StorageError(
            f"no other process can be started to read it ({error.strerror or error}). Close other "
            "programs, then try again."
        ) from error
    for beginning in (FOUND, DAMAGED, REFUSED):
        if done.returncode == 0 and done.stdout.startswith(beginning):
            content = done.stdout.removeprefix(beginning)
            if beginning == FOUND:
                return content
            kind = FileFormatError if beginning == DAMAGED else InvalidInputError
            raise kind(content.decode("utf-8", "replace"))
    raise FileFormatError(_GIVEN_UP.format(reason="reading it crashed"))
