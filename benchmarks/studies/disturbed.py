# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""A small study of an external program that notes each of its starts and ends, so that a fault's cost can be counted:
what the store says, and what was really computed."""
import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

SIMULATOR = """
import json, os, sys, time
request = json.load(open(sys.argv[1]))
x, y, seed = request["x"]["x"], request["x"]["y"], request["seed"]
def note(what):
    descriptor = os.open(os.environ["TALLY"], os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o600)
    os.write(descriptor, f"{what} {x!r} {y!r} {seed}\\n".encode())
    os.close(descriptor)
note("begin")
time.sleep(float(os.environ.get("PAUSE", "0.05")))
with open(request["log"], "wb") as log:
    log.write((f"{x!r} {y!r} {seed}\\n" * 100000)[:int(os.environ.get("LOG_BYTES", "3000"))].encode())
noise = 1e-3 * (seed % 1000) / 1000 * float(os.environ.get("FACTOR", "1"))
if seed % 4 == 0:
    exec(os.environ.get("HOSTILE", ""))
note("end")
json.dump({"values": {"cost": x * x + y + noise, "wear": (x - 1) ** 2 + y / 2 - noise}}, open(sys.argv[2], "w"))
"""
STUDY = {
    "name": "disturbed",
    "variables": [{"name": "x", "unit": "m", "lower": 0, "upper": 1}, {"name": "y", "unit": "m", "lower": 0, "upper": 1}],
    "responses": [{"name": "cost", "unit": "EUR", "goal": "minimize"}, {"name": "wear", "unit": "1", "goal": "minimize"}],
    "command": [sys.executable, "-I", "-S", "simulator.py"],
    "defaults": {"runs": 16, "validation": 4, "adaptive": 4},
}
TIMES = {"seconds", "started", "finished", "checksum"}


STARTED = []  # in groups of their own, which no Ctrl-C of ours reaches


def end_all():
    """What an injection that went wrong has left."""
    while STARTED:
        started = STARTED.pop()
        if started.poll() is None:
            os.killpg(started.pid, signal.SIGKILL)
            started.wait()


class Disturbed:
    """The study in a folder of its own, with the commands that a user would give."""

    def __init__(self, programs, place):
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        self.place, self.out = place, place / "out"
        (place / "simulator.py").write_text(SIMULATOR)
        (place / "study.json").write_text(json.dumps(STUDY))
        self.program = [str(programs / "external_program"), str(place / "study.json")]
        self.environment = dict(os.environ, TALLY=str(place / "tally"))

    def line(self, *words):
        return [*self.program, *words, "--out", str(self.out)]

    def start(self, *words):
        """In the background, with a group of its own for its terminal's sake."""
        started = subprocess.Popen(self.line("run", "--jobs", "4", *words), cwd=self.place, env=self.environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   start_new_session=True, preexec_fn=heeding_interrupts)
        STARTED.append(started)
        return started

    def run(self, *words):
        """Exit code and all that it said."""
        study = self.start(*words)
        said = study.communicate()[0]
        return study.returncode, said

    def command(self, *words):
        end = subprocess.run(self.line(*words), cwd=self.place, env=self.environment, capture_output=True, text=True)
        return end.returncode, end.stdout, end.stderr

    @property
    def store(self):
        return self.out / "study.db"

    def rows(self):
        """What the runs are and gave, bit for bit, without times."""
        with sqlite3.connect(f"file:{self.store}?mode=ro", uri=True) as database:
            names = [row[1] for row in database.execute("PRAGMA table_info(runs)") if row[1] not in TIMES]
            quoted = ", ".join(f'quote("{name}")' for name in names)
            return list(database.execute(f"SELECT {quoted} FROM runs ORDER BY id"))

    def count(self, status):
        with sqlite3.connect(f"file:{self.store}?mode=ro", uri=True) as database:
            return database.execute("SELECT count(*) FROM runs WHERE status = ?", (status,)).fetchone()[0]

    def notes(self, what):
        """How often each run did it."""
        tally = self.place / "tally"
        lines = tally.read_text().splitlines() if tally.exists() else []
        return Counter(line.split(" ", 1)[1] for line in lines if line.startswith(what))

    def left_over(self):
        """Files that only runs in flight have."""
        ours = {"study.db", "report.html", "logs", ".lock", "shared"}
        return [f.name for f in self.out.iterdir() if f.name not in ours]


def heeding_interrupts():
    """Also where this program itself is in the background of a shell, which has them ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def children(process):
    """Process numbers of its children."""
    try:
        return [int(n) for n in Path(f"/proc/{process}/task/{process}/children").read_text().split()]
    except FileNotFoundError:
        return []


def named(process):
    try:
        return Path(f"/proc/{process}/comm").read_text().strip()
    except FileNotFoundError:
        return ""


def watches(process):
    """Its children that end the others should it die."""
    return [child for child in children(process) if named(child) == "drawpoint-watch"]


def workers(process):
    return [child for child in children(process) if named(child) != "drawpoint-watch"]


def kill(process, sign=signal.SIGKILL):
    try:
        os.kill(process, sign)
    except ProcessLookupError:
        pass


def wait_until(condition, patience=60):
    end = time.monotonic() + patience
    while not condition():
        if time.monotonic() > end:
            raise RuntimeError("waited in vain for a minute")
        time.sleep(0.01)
