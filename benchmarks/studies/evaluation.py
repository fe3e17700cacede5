# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""One run of a study's program, for the tables of this folder."""

import json
import subprocess


def evaluated(program, x, options):
    """The responses at x, by name; x as --x takes it, options by their names. A run that fails ends the program."""
    words = [program, "evaluate", f"--x={x}", "--json"]
    for name, value in options.items():
        words += [f"--{name}", value]
    ended = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if ended.returncode:
        raise SystemExit(f"{' '.join(map(str, words))}\n{ended.stderr[-2000:]}")
    said = json.loads(ended.stdout.strip().splitlines()[-1])
    return said.get("values", said)
