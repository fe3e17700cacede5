// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The tests' Slurm cluster for other programs: starts one of two nodes in the folder, says so on standard
/// output, and ends it when standard input ends.

#include <cstdio>
#include <cstdlib>
#include <drawpoint/tests/support/slurm_cluster.hpp>
#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  const int cores = argc == 3 ? std::atoi(argv[2]) : 2;
  if (argc < 2 || argc > 3 || cores < 1) {
    std::cerr
        << "slurm_cluster FOLDER [CORES]: starts a Slurm cluster there, of two nodes with so many cores each "
           "(default 2, 1 or more), until standard input ends\n";
    return 2;
  }
  try {
    const drawpoint::support::SlurmCluster cluster(argv[1], 2, cores);
    std::cout << "ready" << std::endl;
    while (std::cin.get() != EOF) {
    }
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
