// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the tables over functions and seeds share: how they are asked for, and their medians.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
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

/// The upper of the two middle ones of an even number of values; NaN of none.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? std::nan("") : values[values.size() / 2];
}

}  // namespace drawpoint::benchmarks
