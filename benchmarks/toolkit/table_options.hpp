// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How the tables over functions are asked for.

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>
#include <vector>

namespace drawpoint::benchmarks {

inline void add_functions(CLI::App& app, std::vector<std::string>& functions,
                          const std::vector<std::string>& names) {
  app.add_option("--functions", functions, "of the list, with commas between (default: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
}

/// Ends the program where the command line is wrong or asks for help.
inline void parse_or_exit(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
}

}  // namespace drawpoint::benchmarks
