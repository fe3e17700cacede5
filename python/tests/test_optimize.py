# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
import math
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import drawpoint


def bowl(x):
    return (x[0] - 0.3) ** 2 + (x[1] + 0.2) ** 2


def test_the_optimum_of_a_bowl_is_found():
    seen = []
    found = drawpoint.optimize(bowl, [-1, -1], [1, 1], 25, callback=lambda x, y: seen.append((x, y)))
    assert found.status == "budget_spent" and found.feasible and found.exact
    assert found.y[0] < 1e-6 and found.x == pytest.approx([0.3, -0.2], abs=1e-3)
    assert found.y[0] == bowl(found.x) and len(found.best) == 1
    assert found.expected.run[0] == -1 and found.expected.x[0] == pytest.approx([0.3, -0.2], abs=1e-2)
    assert found.runs.X.shape == (25, 2) and found.runs.Y.shape == (25, 1) and len(seen) == 25
    assert (np.array([x for x, _ in seen]) == found.runs.X).all()
    assert (np.array([y for _, y in seen]) == found.runs.Y).all()
    assert (found.runs.X[found.best.run[0]] == found.x).all()
    again = drawpoint.optimize(bowl, [-1, -1], [1, 1], 25)
    assert (again.runs.X == found.runs.X).all()


def test_the_front_of_two_objectives_keeps_a_limit():
    def simulate(x):
        return x[0] ** 2, (x[0] - 2) ** 2, x[1]

    found = drawpoint.optimize(
        simulate, [-3, 0], [3, 1], 24, goals=["minimize", "minimize", ("at_least", 0.5)], deterministic=True
    )
    assert found.feasible and found.expected is None and len(found.best) > 5
    assert (found.best.y[:, 2] >= 0.5).all() and (-1e-9 <= found.best.x[:, 0]).all() and (found.best.x[:, 0] <= 2).all()
    assert len(drawpoint.front(found.best.y[:, :2])) == len(found.best)


def test_noisy_functions_get_seeds_and_intervals():
    def noisy(x, seed):
        return bowl(x) + 0.05 * np.random.default_rng(seed).standard_normal()

    found = drawpoint.optimize(noisy, [-1, -1], [1, 1], 30, pass_seed=True)
    assert not found.exact and (found.best.lower < found.best.y).all() and (found.best.y < found.best.upper).all()
    assert bowl(found.x) < 0.2
    assert (found.runs.Y == drawpoint.optimize(noisy, [-1, -1], [1, 1], 30, pass_seed=True).runs.Y).all()


def test_failed_runs_are_kept_with_their_reasons():
    def fragile(x):
        if x[0] < -0.5:
            raise ArithmeticError("bucket stuck")
        if x[0] > 0.8:
            return math.nan
        return None if x[1] > 0.9 else bowl(x)

    found = drawpoint.optimize(fragile, [-1, -1], [1, 1], 25)
    failed = np.isnan(found.runs.Y[:, 0])
    x = found.runs.X
    assert (failed == ((x[:, 0] < -0.5) | (x[:, 0] > 0.8) | (x[:, 1] > 0.9))).all() and 2 <= failed.sum() < 15
    reasons = set(found.runs.reasons)
    assert {"", "ArithmeticError: bucket stuck"} <= reasons
    assert any("nan" in reason for reason in reasons)
    assert found.y[0] < 1e-3


def test_a_search_without_a_single_success_says_why():
    with pytest.warns(drawpoint.RunWarning, match="4 failed.*the first failure: KeyError: 'radius'"):
        found = drawpoint.optimize(lambda x: {}["radius"], [0], [1], 4)
    assert found.status == "nothing_succeeded" and len(found.best) == 0


def test_whole_numbers_and_levels_are_kept():
    found = drawpoint.optimize(
        lambda x: (x[0] - 3) ** 2 + x[1], [0, 0], [9, 2], 15, kinds=["integer", ["a", "b", "c"]], deterministic=True
    )
    assert list(found.x) == [3.0, 0.0] and (found.runs.X == np.round(found.runs.X)).all()


def test_a_journal_is_gone_on_with(tmp_path):
    calls = []

    def counted(x):
        calls.append(x)
        return bowl(x)

    journal = tmp_path / "runs.csv"
    whole = drawpoint.optimize(counted, [-1, -1], [1, 1], 16)
    calls.clear()
    drawpoint.optimize(counted, [-1, -1], [1, 1], 13, journal=journal, first=12)
    drawpoint.optimize(counted, [-1, -1], [1, 1], 16, journal=journal, first=12)
    assert len(calls) == 16
    assert whole.runs.X.shape == (16, 2)


def test_the_array_that_a_run_is_given_is_its_own():
    kept = []
    found = drawpoint.optimize(lambda x: kept.append(x) or bowl(x), [-1, -1], [1, 1], 12)
    assert (np.array(kept) == found.runs.X).all()


def test_several_threads_call_at_once():
    together = threading.Barrier(2, timeout=5)
    threads = set()

    def waits(x):
        threads.add(threading.get_ident())
        together.wait()
        return bowl(x)

    found = drawpoint.optimize(waits, [-1, -1], [1, 1], 12, threads=2, deterministic=True)
    assert len(found.runs) == 12 and len(threads) >= 2 and not any(found.runs.reasons)


@pytest.mark.parametrize("threads", [1, 2])
def test_what_a_callback_raises_comes_out(threads):
    def faulty(x, y):
        raise LookupError("no such plot")

    with pytest.raises(LookupError, match="no such plot"):
        drawpoint.optimize(bowl, [-1, -1], [1, 1], 20, callback=faulty, threads=threads)


@pytest.mark.parametrize("threads", [1, 2])
def test_an_exit_ends_the_search_and_is_no_failed_run(threads, tmp_path):
    calls = []

    def leaves(x):
        calls.append(x)
        if len(calls) == 5:
            raise SystemExit(7)
        return bowl(x)

    with pytest.raises(SystemExit) as caught:
        drawpoint.optimize(leaves, [-1, -1], [1, 1], 20, threads=threads, journal=tmp_path / "runs.csv")
    assert caught.value.code == 7 and len(calls) <= 6
    assert "failed" not in (tmp_path / "runs.csv").read_text()


@pytest.mark.parametrize(
    "arguments, options, message",
    [
        ((bowl, [0, 0], [1, 1], 0), {}, "kriging::optimize: budget is 0; allowed is 1 or more"),
        ((bowl, [0, 0], [1, 1], 9), {"first": 10}, "first is 10; allowed is 1 to the budget, 9"),
        ((bowl, [0, 0], [1, 1], 9), {"goals": ["record"]}, "the problem has 0 objectives"),
        ((bowl, [0, 0], [1, 1], 9), {"goals": ["least"]}, 'goal is "least"; allowed are minimize, maximize, at_most'),
        ((bowl, [0, 0], [1, 1], 9), {"goals": ["minimize", "at_most"]}, "give a finite limit"),
        ((bowl, [0, 0], [1, 1], 9), {"goals": [("at_most",)]}, "allowed are a name, or a pair"),
        ((lambda x: (1.0, 2.0), [0], [1], 9), {}, "returned 2 values where the problem has 1 responses"),
    ],
)
def test_faulty_calls_are_refused_in_words(arguments, options, message):
    with pytest.raises(ValueError, match=message):
        drawpoint.optimize(*arguments, **options)


SESSION = """
import sys, time
import numpy as np
import drawpoint

def slow(x):
    sys.stdout.write("running\\n")
    sys.stdout.flush()
    time.sleep(0.1)
    return float(x[0])

model = drawpoint.Kriging().fit(drawpoint.halton(9, [0, 0], [1, 1]), np.arange(9.0))
try:
    if sys.argv[1] == "models":
        print("running", flush=True)
        drawpoint.nsga2([model, model], [0, 0], [1, 1], generations=10**8)
    elif sys.argv[1] == "predict":
        runs = drawpoint.halton(300, [0, 0], [1, 1])
        large = drawpoint.Kriging(starts=1, deterministic=True).fit(runs, np.sin(9 * runs).sum(axis=1))
        X = np.zeros((4_000_000, 2), order="F")  # half a minute
        print("running", flush=True)
        large.predict(X, return_std=True)
    elif sys.argv[1] == "nsga2":
        drawpoint.nsga2(lambda x: (slow(x), 1.0), [0, 0], [1, 1])
    else:
        drawpoint.optimize(slow, [0, 0], [1, 1], 500, threads=int(sys.argv[1]), journal=sys.argv[2])
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize("what", ["1", "2", "nsga2", "models", "predict"])
def test_control_c_ends_the_work(what, tmp_path):
    journal = tmp_path / "runs.csv"
    command = [sys.executable, "-W", "ignore", "-c", SESSION, what, str(journal)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as session:
        try:
            assert session.stdout.readline() == "running\n"
            time.sleep(0.35)
            session.send_signal(signal.SIGINT)
            begun = time.perf_counter()
            rest, _ = session.communicate(timeout=20)
        finally:
            session.kill()
    assert rest.endswith("interrupted\n") and session.returncode == 0
    assert time.perf_counter() - begun < 5
    if journal.exists():
        text = journal.read_text()
        assert "ok" in text and "failed" not in text
