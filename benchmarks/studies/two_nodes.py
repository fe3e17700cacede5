# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
"""A Slurm cluster of this machine: two nodes, as long as the program slurm_cluster runs."""
import os
import shutil
import subprocess


class TwoNodes:
    """In a new folder. `build` has the programs, `cores` are those of a node."""

    def __init__(self, build, folder, cores=2):
        self.folder = folder
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        self.process = subprocess.Popen([build / "benchmarks" / "slurm_cluster", folder, str(cores)], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        if self.process.stdout.readline() != "ready\n":
            raise RuntimeError("the Slurm cluster does not start")
        self.environment = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()
