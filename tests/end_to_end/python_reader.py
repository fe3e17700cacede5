# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""drawpoint_reader against the command export and against damage. Usage: python_reader.py FORMULA_DEMO FOLDER_OF_PACKAGE"""

import csv
import io
import math
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import unittest

PROGRAM, PACKAGE = sys.argv[1:3]
sys.path.insert(0, PACKAGE)
import drawpoint_reader  # noqa: E402
from drawpoint_reader.checksums import digits  # noqa: E402


def said(*words):
    return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stdout


class Reader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.folder = str(pathlib.Path(cls.place.name) / "study")
        said("run", "--runs", "12", "--validation", "4", "--adaptive", "2", "--out", cls.folder)
        said("exclude", "--run", "3", "--why", "the belt had stopped", "--out", cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def setUp(self):
        self.study = drawpoint_reader.open(self.folder)

    def test_columns_are_those_of_export_bit_for_bit(self):
        exported = list(csv.reader(io.StringIO(said("export", "--out", self.folder))))
        names = [name.split(" ")[0] for name in exported[0]]
        columns = self.study.columns()
        self.assertEqual(len(exported) - 1, 18)
        for row, line in enumerate(exported[1:]):
            for name, text in zip(names, line):
                value = columns[name][row]
                if isinstance(value, str):
                    self.assertEqual(value, text, name)
                elif text == "":
                    self.assertTrue(math.isnan(value), name)
                else:
                    self.assertEqual(float(value), float(text), name)

    def test_problem_and_corrections(self):
        self.assertEqual(self.study.name, "formula_demo")
        self.assertEqual([v.name for v in self.study.variables], ["alpha", "beta", "gamma", "kappa"])
        self.assertEqual(self.study.label("production"), "production [kg/s]")
        self.assertEqual(self.study.corrections[0]["why"], "the belt had stopped")
        self.assertEqual(list(self.study.columns("failed")["run"]), [3])
        self.assertEqual(len(self.study.columns("done", "validation")["run"]), 4)
        with self.assertRaisesRegex(KeyError, "no variable or response"):
            self.study.unit("speed")

    def test_a_frame_where_pandas_is(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            with self.assertRaisesRegex(ImportError, "columns"):
                self.study.frame()
            return
        frame = self.study.frame()
        self.assertEqual(frame.index.name, "run")
        self.assertEqual(len(frame), 17)

    def test_damage_is_refused(self):
        other = pathlib.Path(self.place.name) / "other"
        other.mkdir(exist_ok=True)
        store = other / "study.db"
        for change, words in (("UPDATE runs SET production = 1 WHERE id = 2", "run 2 does not fit its checksum"),
                              ("DELETE FROM runs WHERE id = 5", "17 of 18 runs"),
                              ("UPDATE study SET value = '2' WHERE key = 'seed'", "the table study does not fit"),
                              ("PRAGMA user_version = 99", "schema version 99")):
            store.write_bytes((pathlib.Path(self.folder) / "study.db").read_bytes())
            with sqlite3.connect(store) as database:
                database.execute(change)
            database.close()
            with self.assertRaisesRegex(drawpoint_reader.StudyError, words):
                drawpoint_reader.open(other)
        store.write_bytes(b"no database")
        with self.assertRaisesRegex(drawpoint_reader.StudyError, "cannot be read"):
            drawpoint_reader.open(other)
        with self.assertRaisesRegex(drawpoint_reader.StudyError, "holds no study"):
            drawpoint_reader.open(self.place.name)

    def test_logs_are_found_and_checked(self):
        import h5py

        with self.assertRaisesRegex(drawpoint_reader.StudyError, "run 1 has no log"):
            self.study.log(1)
        file = pathlib.Path(self.folder) / "logs" / "run_0001.h5"
        with h5py.File(file, "w") as log:
            log["numbers"] = [1.0, 2.0]
        self.study._columns["log"][0] = digits(file.read_bytes())
        with self.study.log(1, check=True) as log:
            self.assertEqual(list(log["numbers"]), [1.0, 2.0])
        self.study._columns["log"][0] = "0" * 16
        with self.assertRaisesRegex(drawpoint_reader.StudyError, "not the log that run 1 wrote"):
            self.study.log(1, check=True)
        file.unlink()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
