#!/usr/bin/python3
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""One table of what fit_quality and fit_quality_peers.py printed for the same cases, as Markdown.

  fit_quality --designs maximin,corners,sobol --runs 40,60 --ways default,chosen,likeliest >ours
  fit_quality --designs maximin,corners,sobol --runs 40,60 --write cases && fit_quality_peers.py cases >peers
  fit_quality_table.py ours peers

Per way to fit: NRMSE, median of the seeds; per cent of new observations within the 95 % interval; fits that did not
converge or failed, where there are any. The last columns: the error of `default` and of `chosen` over the least of plain maximum
likelihood and the other programs. Under the table per design and number of runs: how often that is at most 1.05, and the geometric mean of each
one's error over those of the two."""
import itertools
import math
import sys
from pathlib import Path

OURS = ["default", "chosen"]
NOISE = "nothing"  # the errors of these functions say whether noise is followed; a ratio of them says little


def rows_of(path):
    """{(function, design, runs): {way: (NRMSE, per cent held, not converged)}}"""
    rows = {}
    for line in Path(path).read_text().splitlines()[1:]:
        function, design, runs, way, error, _, _, _, _, held, _, _, unsettled, *_ = line.split()
        rows.setdefault((function, design, int(runs)), {})[way] = (float(error), float(held), int(unsettled))
    return rows


def cell(error, held, unsettled):
    return f"{error:.3g}; {held:.0f}" + (f" ({unsettled} not)" if unsettled else "")


def over_best(by_way, ours):
    return by_way[ours][0] / min(error for way, (error, _, _) in by_way.items() if way not in OURS)


def geometric_mean(ratios):
    return math.exp(sum(map(math.log, ratios)) / len(ratios))


def print_summary(joined, design, runs, cases):
    judged = [joined[case] for case in cases if not case[0].startswith(NOISE)]
    for ours in OURS:
        near = sum(over_best(by_way, ours) <= 1.05 for by_way in judged)
        means = ", ".join(f"{way} {geometric_mean([by_way[way][0] / by_way[ours][0] for by_way in judged]):.2f}"
                          for way in judged[0] if way not in OURS)
        print(f"* {design}, {runs} runs, {ours}: first or within 5 % of the first in {near} of {len(judged)}; errors over its own: {means}")


def main():
    tables = [rows_of(path) for path in sys.argv[1:]]
    cases = [case for case in tables[0] if all(case in table for table in tables)]
    joined = {case: {way: row for table in tables for way, row in table[case].items()} for case in cases}
    ways = list(joined[cases[0]])
    print("| Function, design, runs | " + " | ".join(ways) + " | " + " | ".join(f"{ours} over the least" for ours in OURS) + " |")
    print("|" + "---|" * (len(ways) + 1 + len(OURS)))
    for (function, design, runs), by_way in joined.items():
        cells = [cell(*by_way[way]) for way in ways] + [f"{over_best(by_way, ours):.2f}" for ours in OURS]
        print(f"| {function}, {design}, {runs} | " + " | ".join(cells) + " |")
    print()
    for (design, runs), group in itertools.groupby(sorted(cases, key=lambda case: case[1:]), key=lambda case: case[1:]):
        print_summary(joined, design, runs, list(group))


if __name__ == "__main__":
    main()
