"""A process that measures stimuli: ``python -m skinsource.studies.sweeps.worker``.

It reads one JSON text a line: ``{"plan": text}`` first, then ``{"measure": [numbers]}``, answered
by one line for each number, ``{"stimulus": number, "metrics": {…}}`` or, instead of metrics,
``"error": sentence``.  It ends when its input does.
"""

import gc
import json
import os
import sys
from typing import IO

from skinsource.base.allocation import keep_freed_memory
from skinsource.studies.sweeps.measuring import Measurer, metrics_or_reason
from skinsource.studies.sweeps.plan import plan_of


def main() -> None:
    """Answer requests until there are no more."""
    answers = _own_output()
    keep_freed_memory()
    # Modules stay: a garbage collection through them takes as long as a hundred stimuli.
    gc.freeze()
    measurer: Measurer | None = None
    for line in sys.stdin.buffer:
        request = json.loads(line)
        if "plan" in request:
            measurer = Measurer(plan_of(request["plan"]))
        elif measurer is not None:
            for number in request["measure"]:
                outcome = metrics_or_reason(measurer, number)
                kind = "error" if isinstance(outcome, str) else "metrics"
                text = json.dumps({"stimulus": number, kind: outcome})
                answers.write(text.encode() + b"\n")
                answers.flush()


def _own_output() -> IO[bytes]:
    """Return the file for the answers; prints of libraries go to another one."""
    own = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return own


if __name__ == "__main__":
    main()
