#!/usr/bin/env python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether one strategy beats another on piles that the study has not seen, of several kinds. Each pile meets all strategies
with the same seed, so that differences are paired. One row per kind, pile and strategy, written as it comes; rows that the
table has already are not made again.

    unseen_piles.py PROGRAM runs.csv --folder FOLDER --strategy reference=0,1.1,.5,.5,1,1.5 --strategy recommended=...
                    --kind usual --kind low:pile-mass=70 --kind well_broken:sizes=well_broken,pile-mass=70
                    [--piles 10] [--cycles 3] [--jobs 2] [--differences differences.csv]

A kind is a name and the options of the study that differ from its defaults. FOLDER keeps the piles that are poured: seeds
101 and on, where a study's own has seed 1. Differences are those of every strategy from the first: mean over the piles and
half of its 95 % interval by Student's t.
"""

import argparse
import concurrent.futures
import csv
import math
import pathlib
import statistics
import sys

from evaluation import evaluated

FIRST_PILE = 101
# 97.5 % quantiles of Student's t by degrees of freedom.
STUDENT = [None, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
           2.120, 2.110, 2.101, 2.093, 2.086]


def options_of(given, kind, pile):
    chosen = dict(option.split("=", 1) for option in given.kinds[kind].split(",") if option)
    return {"seed": pile, "pile": pile, "cycles": given.cycles, "shared": given.folder / f"{kind}_{pile}", **chosen}


def rows_of(table):
    if not table.exists():
        return []
    with open(table, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def pile_runs(given, kind, pile, missing):
    """The strategies of one pile, one after the other: the first pours it."""
    return [(name, evaluated(given.program, given.strategies[name], options_of(given, kind, pile))) for name in missing]


def make_runs(given):
    rows = rows_of(given.table)
    made = {(row["kind"], row["pile"], row["strategy"]) for row in rows}
    with open(given.table, "a", newline="") as file, concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        writer = csv.writer(file, lineterminator="\n")
        if not rows:
            words = " ".join([f"--strategy {name}={x}" for name, x in given.strategies.items()] +
                             [f"--kind {kind}" for kind in given.given_kinds])
            file.write(f"# unseen_piles.py {given.program.name} --cycles {given.cycles} {words}\n")
        header = list(rows[0])[3:] if rows else None
        waiting = []
        for kind in given.kinds:
            for pile in range(FIRST_PILE, FIRST_PILE + given.piles):
                missing = [name for name in given.strategies if (kind, str(pile), name) not in made]
                if missing:
                    waiting.append((kind, pile, pool.submit(pile_runs, given, kind, pile, missing)))
        for kind, pile, future in waiting:
            for name, values in future.result():
                if header is None:
                    header = list(values)
                    writer.writerow(["kind", "pile", "strategy", *header])
                writer.writerow([kind, pile, name, *(f"{values[key]:.6g}" for key in header)])
                file.flush()
                print(kind, pile, name, f"{values[header[0]]:.4g}", file=sys.stderr, flush=True)


def differences(given):
    rows = rows_of(given.table)
    first, *others = given.strategies
    responses = [key for key in rows[0] if key not in ("kind", "pile", "strategy")]
    value = {(row["kind"], row["pile"], row["strategy"]): row for row in rows}
    for kind in dict.fromkeys(row["kind"] for row in rows):
        piles = [pile for (of, pile, name) in value if of == kind and name == first]
        for response in responses:
            base = [float(value[kind, pile, first][response]) for pile in piles]
            yield [kind, first, response, len(base), f"{statistics.mean(base):.4g}", "", ""]
            for other in others:
                paired = [pile for pile in piles if (kind, pile, other) in value]
                if not paired:
                    continue
                gained = [float(value[kind, pile, other][response]) - float(value[kind, pile, first][response])
                          for pile in paired]
                half = (STUDENT[min(len(gained) - 1, 20)] * statistics.stdev(gained) / math.sqrt(len(gained))
                        if len(gained) > 1 else math.nan)
                mean = statistics.mean(float(value[kind, pile, other][response]) for pile in paired)
                yield [kind, other, response, len(gained), f"{mean:.4g}", f"{statistics.mean(gained):.3g}", f"{half:.2g}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("table", type=pathlib.Path)
    parser.add_argument("--folder", type=pathlib.Path, required=True)
    parser.add_argument("--strategy", action="append", required=True, metavar="NAME=X", dest="given_strategies")
    parser.add_argument("--kind", action="append", required=True, metavar="NAME[:OPTION=VALUE,...]", dest="given_kinds")
    parser.add_argument("--piles", type=int, default=10)
    parser.add_argument("--cycles", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--differences", type=pathlib.Path)
    given = parser.parse_args()
    given.strategies = dict(text.split("=", 1) for text in given.given_strategies)
    given.kinds = {kind.split(":", 1)[0]: kind.partition(":")[2] for kind in given.given_kinds}
    given.folder.mkdir(parents=True, exist_ok=True)
    make_runs(given)
    with (open(given.differences, "w", newline="") if given.differences else sys.stdout) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["kind", "strategy", "response", "piles", "mean", "more than the first", "95 % half width"])
        writer.writerows(differences(given))


if __name__ == "__main__":
    main()
