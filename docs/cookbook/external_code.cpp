// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/full_factorial.hpp>
#include <drawpoint/doe/process_pool.hpp>
#include <filesystem>
#include <fstream>

using namespace drawpoint;

const doe::Problem pushing{.variables = {{"speed", "m/s", 0.5, 2.5}, {"slope", "deg", -5.0, 25.0}},
                           .responses = {{"distance", "m"}}};

// Any language will do. The two numbers come as two words; the answer goes to file descriptor 3. This one
// coasts uphill, in steps of 1 ms, until it stands.
const char* const program = R"(
awk -v v="$1" -v slope="$2" 'BEGIN {
  a = 9.81 * (sin(slope * 3.14159265 / 180) + 0.05)
  if (a <= 0) { print "failure it rolls away" > "/dev/fd/3"; exit }
  for (dt = 0.001; v > 0; v -= a * dt) s += v * dt - a * dt * dt / 2
  print s > "/dev/fd/3"
}'
)";

int main(int argc, char** argv) {
  const std::filesystem::path csv_path = argc > 1 ? argv[1] : "external_code.csv";
  const std::filesystem::path script = csv_path.string() + ".sh";
  std::ofstream(script) << program;

  const auto simulate = doe::process_pool({"sh", script.string(), "{x}"}, {.jobs = 2, .time_limit = 10.0});
  const doe::Evaluations runs = doe::evaluate(simulate, pushing, doe::full_factorial(pushing, 5));

  double largest = 0.0;
  std::ofstream csv(csv_path);
  csv << "speed,slope,distance\n";
  for (const doe::Evaluation& run : runs.rows) {
    if (run.outcome.failed()) continue;
    const double a = 9.81 * (std::sin(run.x[1] * std::acos(-1.0) / 180.0) + 0.05),
                 exact = run.x[0] * run.x[0] / (2.0 * a);
    largest = std::max(largest, std::abs(run.outcome.values()[0] - exact));
    csv << run.x[0] << ',' << run.x[1] << ',' << run.outcome.values()[0] << '\n';
  }
  std::printf("%zu runs, %d failed: %s\n", runs.rows.size(), runs.failed(),
              runs.rows[0].outcome.reason().c_str());
  std::printf("the others are right to a millimetre: %s\n", largest < 0.001 ? "yes" : "no");
  return largest < 0.001 ? 0 : 1;
}
