# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Which runs no model sees: those that somebody has excluded, and those with a value that cannot be."""

import math

TOO_LARGE, TOO_MANY_MEDIANS = 1e100, 1e12


def _inside(response, value):
    """The bound that the value misses by round-off alone, or the value."""
    sizes = [abs(bound) for bound in (response.lower, response.upper) if math.isfinite(bound)]
    tolerance = 1024 * 2.0**-52 * (max(sizes, default=0.0) or 1.0)
    if value < response.lower and response.lower - value <= tolerance:
        return response.lower
    if value > response.upper and value - response.upper <= tolerance:
        return response.upper
    return value


def _fault(response, value, median):
    if not math.isfinite(value):
        return "is no finite number"
    if not response.lower <= _inside(response, value) <= response.upper:
        return "lies outside of its range"
    if abs(value) >= TOO_LARGE:
        return "has a size that no model takes"
    if abs(value) > TOO_MANY_MEDIANS * max(median, 1.0):
        return "is more than 1e12 times the median size"
    return ""


def leave_out(columns, responses, corrections):
    """Makes them failed in the columns `status` and `reason`, which are lists here."""
    excluded = {}
    for correction in corrections:
        if correction["what"] == "exclude":
            excluded[correction["run"]] = correction["why"]
        elif correction["what"] == "include":
            excluded.pop(correction["run"], None)
    status, reason = columns["status"], columns["reason"]
    for run, why in excluded.items():
        if 1 <= run <= len(status) and status[run - 1] in ("done", "failed"):
            status[run - 1], reason[run - 1] = "failed", "left out: excluded by hand: " + why
    for response in responses:
        values = columns[response.name]
        sizes = sorted(abs(v) for s, v in zip(status, values) if s == "done" and math.isfinite(v))
        median = sizes[(len(sizes) - 1) // 2] if sizes else 0.0
        for k, value in enumerate(values):
            fault = _fault(response, value, median) if status[k] == "done" else ""
            if fault:
                status[k], reason[k] = "failed", f'left out: "{response.name}" {fault}'
