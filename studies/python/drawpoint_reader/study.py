# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""A study's folder (docs/reference/studies.md, "The folder")."""

import json
import math
import pathlib
import sqlite3
from dataclasses import dataclass

import numpy as np

from .checksums import RowText, digits
from .left_out import leave_out

APPLICATION, SCHEMA = 0x44727770, 5
FIXED = ("id", "kind", "point", "replicate", "seed", "status", "reason", "seconds", "started", "finished", "log")
WHOLE = ("run", "point", "replicate")


class StudyError(RuntimeError):
    """The folder holds no sound study of a version that this package reads."""


@dataclass(frozen=True)
class Variable:
    name: str
    unit: str
    lower: float
    upper: float
    kind: str = "real"
    levels: tuple = ()


@dataclass(frozen=True)
class Response:
    name: str
    unit: str
    goal: str
    limit: float = math.nan
    lower: float = -math.inf
    upper: float = math.inf
    standard_error: str = ""
    standard_error_freedom: float = 0.0


def _text(value):
    return "" if value is None else str(value)


def _number(value):
    return math.nan if value is None else float(value)


def _row_checksum(row):
    text = RowText()
    for value in row[:7]:
        text.add(_text(value))
    text.add_number(float(row[7] or 0))
    for value in row[8:11]:
        text.add(_text(value))
    for value in row[12:]:
        if value is None:  # as the program writes what is not known
            text.add(str(0x7FF8000000000000))
        else:
            text.add_number(float(value))
    return text.checksum()


class Study:
    """One folder, as it was when it was opened.

    name, seed (whole number), simulator and options (texts); variables and responses in order; corrections, a list
    of dicts; folder (pathlib.Path).
    """

    def __init__(self, folder, check=True):
        self.folder = pathlib.Path(folder)
        self._file = self.folder / "study.db"
        if not self._file.is_file():
            raise StudyError(f"{self.folder} holds no study (no file study.db); name the folder that run --out made")
        try:
            self._read(check)
        except sqlite3.Error as error:
            raise StudyError(f"{self._file} cannot be read: {error}; the command status says more") from error

    def _read(self, check):
        database = sqlite3.connect(self._file.resolve().as_uri() + "?mode=ro", uri=True, timeout=10)
        database.text_factory = lambda data: data.decode("utf-8", "surrogateescape")
        try:
            database.execute("BEGIN")  # one state, though the study may run
            self._require_version(database)
            self._read_study(dict(database.execute("SELECT key, value FROM study")), check)
            self._read_corrections(database)
            self._read_runs(database.execute("SELECT * FROM runs ORDER BY id").fetchall(), check)
        finally:
            database.close()

    def _require_version(self, database):
        if database.execute("PRAGMA application_id").fetchone()[0] != APPLICATION:
            raise StudyError(f"{self._file} is an SQLite file, but not the store of a Drawpoint study")
        version = database.execute("PRAGMA user_version").fetchone()[0]
        if version != SCHEMA:
            raise StudyError(f"{self._file} has schema version {version}, and this package reads version {SCHEMA}")

    def _read_study(self, entries, check):
        stored = entries.pop("checksum", "")
        if check:
            text = RowText()
            for key in sorted(entries):
                text.add(key)
                text.add(entries[key])
            if text.checksum() != stored:
                raise StudyError(f"{self._file} is damaged: the table study does not fit its checksum")
        problem = json.loads(entries["problem"])
        self.name, self.seed, self.simulator = entries["name"], int(entries["seed"]), entries["simulator"]
        self.options = json.loads(entries["options"])
        self.variables = [Variable(v["name"], v["unit"], v["lower"], v["upper"], v.get("kind", "real"),
                                   tuple(v.get("levels", ()))) for v in problem["variables"]]
        self.responses = [Response(**r) for r in problem["responses"]]
        self._count = int(entries["rows"])

    def _read_corrections(self, database):
        known = database.execute("SELECT 1 FROM sqlite_master WHERE name = 'corrections'").fetchone()
        names = ("number", "run", "what", "why", "before", "made")
        rows = database.execute(f"SELECT {', '.join(names)} FROM corrections ORDER BY number") if known else ()
        self.corrections = [dict(zip(names, row)) for row in rows]

    def _read_runs(self, rows, check):
        if len(rows) != self._count:
            raise StudyError(f"{self._file} is damaged: it holds {len(rows)} of {self._count} runs")
        if check:
            for row in rows:
                if _row_checksum(row) != row[11]:
                    raise StudyError(f"{self._file} is damaged: run {row[0]} does not fit its checksum")
        by_column = list(zip(*rows)) if rows else [()] * (12 + len(self.variables) + 4 * len(self.responses))
        columns = {name if name != "id" else "run": list(by_column[k]) for k, name in enumerate(FIXED)}
        for name in ("reason", "started", "finished", "log"):
            columns[name] = [_text(value) for value in columns[name]]
        columns["seconds"] = [float(value or 0) for value in columns["seconds"]]
        at = 12
        for variable in self.variables:
            columns[self._free(variable.name, columns)] = self._settings(variable, by_column[at])
            at += 1
        for ending in ("", "_predicted", "_lower", "_upper"):
            for response in self.responses:
                columns[response.name + ending] = [_number(value) for value in by_column[at]]
                at += 1
        leave_out(columns, self.responses, self.corrections)
        self._columns = columns

    @staticmethod
    def _free(name, columns):
        while name in columns:
            name = "x_" + name
        return name

    @staticmethod
    def _settings(variable, values):
        return [variable.levels[round(value)] for value in values] if variable.levels else [float(v) for v in values]

    def columns(self, status=None, kind=None):
        """A dict of NumPy arrays, one entry per run: run, kind, point, replicate, seed (text), status, reason,
        seconds, started, finished, log (checksum), variables (a level by its name), responses, and of each response
        what was _predicted with the ends _lower and _upper. Natural units; NaN where there is no value.

        status: "done", "failed", "planned" or "running" alone; kind: "training", "adaptive", ... alone.
        """
        rows = [k for k, (of, made) in enumerate(zip(self._columns["status"], self._columns["kind"]))
                if status in (None, of) and kind in (None, made)]
        chosen = {}
        for name, values in self._columns.items():
            kept = [values[k] for k in rows]
            if name in WHOLE:
                chosen[name] = np.array(kept, dtype=np.int64)
            elif kept and isinstance(kept[0], str):
                chosen[name] = np.array(kept, dtype=object)
            else:
                chosen[name] = np.array(kept, dtype=float)
        return chosen

    def frame(self, status="done", kind=None):
        """The same as a pandas.DataFrame with the run as its index; of the runs that are done, unless status=None."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("frame() needs pandas (Debian: python3-pandas); columns() gives the same as a dict of "
                              "NumPy arrays") from error
        return pandas.DataFrame(self.columns(status, kind)).set_index("run")

    def unit(self, name):
        """Of a variable or a response, "1" for a pure number."""
        for quantity in (*self.variables, *self.responses):
            if quantity.name == name:
                return quantity.unit
        names = ", ".join(q.name for q in (*self.variables, *self.responses))
        raise KeyError(f'{self.name} has no variable or response "{name}"; there are {names}')

    def label(self, name):
        """For an axis: "production [kg/s]"."""
        unit = self.unit(name)
        return name if unit in ("", "1") else f"{name} [{unit}]"

    def log(self, run, check=False):
        """The log of a run as an open h5py.File (docs/how-to/reading-results.md says what is in it). check: by its
        checksum, which takes some seconds per 10 MB."""
        runs = self._columns["run"]
        if run not in runs:
            raise KeyError(f"{self.name} has no run {run}; there are 1 to {len(runs)}")
        file = self.folder / "logs" / f"run_{run:04d}.h5"
        stored = self._columns["log"][runs.index(run)]
        if not stored or not file.is_file():
            raise StudyError(f"run {run} has no log ({file})")
        if check and digits(file.read_bytes()) != stored:
            raise StudyError(f"{file} is not the log that run {run} wrote")
        import h5py

        return h5py.File(file, "r")

    def __len__(self):
        return len(self._columns["run"])

    def __repr__(self):
        done = self._columns["status"].count("done")
        return f"<study {self.name} in {self.folder}: {done} of {len(self)} runs done>"


def open_study(folder, check=True):
    """The study in the folder. check: hold every row to its checksum, about 3000 runs a second. Throws StudyError."""
    return Study(folder, check)
