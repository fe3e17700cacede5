// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The tests' Slurm cluster for other programs: starts one of two nodes in the folder, says so on standard
/// output, and ends it when standard input ends.

#include <cstdio>
#include <drawpoint/tests/support/slurm_cluster.hpp>
#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "slurm_cluster FOLDER: starts a Slurm cluster there until standard input ends\n";
    return 2;
  }
  try {
    const drawpoint::support::SlurmCluster cluster(argv[1], 2);
    std::cout << "ready" << std::endl;
    while (std::cin.get() != EOF) {
    }
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
