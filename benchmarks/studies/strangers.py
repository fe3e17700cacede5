# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""Faults of strangers, for fault_table: what programs leave and reply, simulators that change, tables that lie, clusters
that refuse, and copies of a folder at random moments."""
import os
import shutil
import signal
import subprocess
import time

# Executed by one simulator in four, in place of a good end.
HOSTILE = {
    "log_is_directory": "os.remove(request['log']); os.mkdir(request['log'])",
    "log_is_pipe": "os.remove(request['log']); os.mkfifo(request['log'])",
    "log_is_link": "os.remove(request['log']); os.symlink('/etc/passwd', request['log'])",
    "reply_is_pipe": "os.mkfifo(sys.argv[2]); os._exit(0)",
    "reply_is_directory": "os.mkdir(sys.argv[2]); os._exit(0)",
    "reply_has_key_twice": "open(sys.argv[2], 'w').write('{\"values\": {\"cost\": 1, \"cost\": 2, \"wear\": 3}}'); os._exit(0)",
    "reply_is_no_number": "open(sys.argv[2], 'w').write('{\"values\": {\"cost\": NaN, \"wear\": 3}}'); os._exit(0)",
    "reply_is_huge": "open(sys.argv[2], 'w').write('[' * 20000000); os._exit(0)",
    "prints_without_end": "print('\\x1b[31m' * 1000000); os._exit(3)",
}
TABLES = {
    "decimal_commas": "x,y,cost,wear\n0,5,0,25,1,5,2,75\n",
    "column_twice": "x,y,cost,cost,wear\n0.5,0.25,1,2,3\n",
    "beyond_the_box": "x,y,cost,wear\n1.5,0.25,1,2\n",
    "no_number": "x,y,cost,wear\n0.5,0.25,nan,2\n",
    "hexadecimal": "x,y,cost,wear\n0.5,0.25,0x10,2\n",
    "short_row": "x,y,cost,wear\n0.5,0.25,1\n",
}


def faults(table):
    """table: the module of fault_table, whose Bench, Cluster and words are taken."""
    return [*(hostile(table, name, code) for name, code in HOSTILE.items()),
            *(lying(table, name, text) for name, text in TABLES.items()),
            *(made(table) for made in (changed, copied_at_rest, copied_in_motion, slurm_refuses, slurm_environment,
                                       slurm_cancels, slurm_time_limit))]


def named(name, fault):
    fault.__name__ = name
    return fault


def hostile(table, name, code):
    """Those runs fail, the study ends, and with a good simulator it goes on."""
    def fault(bench):
        study = bench.study()
        study.environment["HOSTILE"] = code
        running = study.start(*table.FIXED, "--keep-going", "--time-limit", "20")
        said = running.communicate(timeout=180)[0]
        if running.returncode not in (0, 1):
            raise RuntimeError(said)
        failed, before = study.count("failed"), table.done_rows(study)
        victims = sum(int(seed) % 4 == 0 for seed in seeds(study))
        words = study.command("status")[1]
        study.environment.pop("HOSTILE")
        table.go_on(study, *table.FIXED, "--retry-failed")
        result = table.cost(bench, study, table.FIXED, before)
        result["others failed"] = max(0, failed - victims)
        result["not noticed"] = max(0, victims - failed)
        return result, table.told(words, study, "times: ", "once: ")
    return named(name, fault)


def seeds(study):
    rows = study.command("export")[1].splitlines()
    column = rows[0].split(",").index("seed")
    return [row.split(",")[column] for row in rows[1:]]


def lying(table, name, text):
    """The table is refused and the study as it was."""
    def fault(bench):
        study = bench.copy()
        before = study.rows()
        (study.place / "table.csv").write_text(text)
        code, _, said = study.command("run", "--import", str(study.place / "table.csv"))
        return {"silent": int(code == 0 or study.rows() != before)}, table.told(said, study, "--import")
    return named("table_" + name, fault)


def changed(table):
    """By something that no file tells: what is made again on resume must show it."""
    def simulator_changed(bench):
        study = bench.study()
        running = study.start(*table.FIXED)
        least = bench.random.randint(2, 12)
        table.wait_until(lambda: study.store.exists() and study.count("done") >= least or running.poll() is not None)
        table.kill(running.pid, signal.SIGINT)
        running.communicate()
        before = len(table.done_rows(study))
        study.environment["FACTOR"] = "2"
        code, said = study.run(*table.FIXED)
        mixed = len(table.done_rows(study)) - before
        return {"silent": int(code == 0 and mixed > 0), "mixed rows": mixed}, table.told(said, study, "spot check", "studies:")
    return simulator_changed


def copies(bench, study, running, count, at_rest):
    """Folders as they were at random moments; at rest: the driver is stopped meanwhile, as by a power cut."""
    made = []
    while running.poll() is None and len(made) < count:
        time.sleep(bench.random.uniform(0.0, 0.15))
        if not study.store.exists():
            continue
        if at_rest:
            os.kill(running.pid, signal.SIGSTOP)
        to = study.place / f"copy_{len(made)}"
        try:
            shutil.copytree(study.out, to, ignore=lambda *_: {".lock"})
        except shutil.Error:  # of runs in flight files come and go; all others are copied
            pass
        if at_rest:
            os.kill(running.pid, signal.SIGCONT)
        made.append(to)
    return made


def copied(table, at_rest):
    def fault(bench):
        study = bench.study()
        running = study.start(*table.FIXED)
        folders = copies(bench, study, running, 10, at_rest)
        running.communicate()
        reference = bench.reference(*table.FIXED)[0]
        result = {"copies": len(folders), "refused": 0, "lost": 0, "differ": 0}
        words = "nothing"
        whole = study.out
        for folder in folders:
            study.out = folder
            code, _, error = study.command("status")
            stored = set(table.done_rows(study)) if code == 0 else set()
            code, said = study.run(*table.FIXED) if code == 0 else (1, error)
            if code != 0:
                result["refused"] += 1
                words = table.told(said, study)
                continue
            result["lost"] += len(stored - set(study.rows()))
            result["differ"] += sum(a != b for a, b in zip(study.rows(), reference))
            shutil.rmtree(folder)
        study.out = whole
        if at_rest and result["refused"]:
            raise RuntimeError(f"{result['refused']} copies do not go on: {words}")
        return result, words
    return named("copied_at_rest" if at_rest else "copied_in_motion", fault)


def copied_at_rest(table):
    return copied(table, True)


def copied_in_motion(table):
    return copied(table, False)


def slurm_refuses(table):
    """A controller that takes ten jobs: arrays are halved until they fit."""
    def slurm_refuses_arrays(bench):
        with table.Cluster(bench) as cluster:
            with open(cluster.folder / "slurm.conf", "a") as conf:
                conf.write("MaxJobCount=10\nMinJobAge=2\n")  # ended jobs count until that age [s]
            cluster.kill_daemon("slurmctld")
            time.sleep(1)
            cluster.shell("slurmctld")
            study = bench.study()
            study.environment.update(cluster.environment, PAUSE="0.3")
            code, said = study.run("--slurm")
            if code != 0:
                raise RuntimeError(said)
            return table.cost(bench, study), table.told(said, study, "Slurm takes", "refuse", "array")
    return slurm_refuses_arrays


def slurm_environment(table):
    """Variables of a user that would turn every command."""
    def slurm_environment_turned(bench):
        with table.Cluster(bench) as cluster:
            study = bench.study()
            study.environment.update(cluster.environment, PAUSE="0.1", SQUEUE_PARTITION="other", SQUEUE_FORMAT="%i",
                                     SBATCH_WAIT="1", SBATCH_PARTITION="other", SCANCEL_STATE="RUNNING")
            code, said = study.run("--slurm")
            if code != 0:
                raise RuntimeError(said)
            return table.cost(bench, study), table.told(said, study, "studies:")
    return slurm_environment_turned


def slurm_cancels(table):
    """Somebody cancels all tasks that run: those runs fail with that reason, and are made again when asked for."""
    def slurm_cancels_tasks(bench):
        with table.Cluster(bench) as cluster:
            study = bench.study()
            study.environment.update(cluster.environment, PAUSE="1")
            running = study.start("--slurm", *table.FIXED)
            table.wait_until(lambda: study.store.exists() and study.count("done") >= bench.random.randint(1, 6))
            subprocess.run(["scancel", "--state=RUNNING", "--user=root"], env=cluster.environment, capture_output=True)
            running.communicate(timeout=180)
            words = study.command("status")[1]
            before = table.done_rows(study)
            failed = study.count("failed")
            table.go_on(study, "--slurm", *table.FIXED, "--retry-failed")
            return {**table.cost(bench, study, table.FIXED, before), "cancelled": failed}, \
                table.told(words, study, "times: ", "once: ")
    return slurm_cancels_tasks


def slurm_time_limit(table):
    """Slurm ends a quarter of the tasks after its least limit, a minute; those runs fail with that reason."""
    def slurm_limits_time(bench):
        with table.Cluster(bench) as cluster:
            study = bench.study()
            study.environment.update(cluster.environment, HOSTILE="time.sleep(600)")
            running = study.start("--slurm", "--slurm-option=--time=1", "--keep-going", *table.FIXED)
            said = running.communicate(timeout=600)[0]
            if running.returncode not in (0, 1):
                raise RuntimeError(said)
            words, failed, before = study.command("status")[1], study.count("failed"), table.done_rows(study)
            victims = sum(int(seed) % 4 == 0 for seed in seeds(study))
            study.environment.pop("HOSTILE")
            table.go_on(study, "--slurm", *table.FIXED, "--retry-failed")
            return {**table.cost(bench, study, table.FIXED, before), "not noticed": victims - failed}, \
                table.told(words, study, "times: ", "once: ")
    return slurm_limits_time
