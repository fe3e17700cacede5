// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstdio>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <filesystem>
#include <fstream>

using namespace drawpoint;

const doe::Problem hauling{.variables = {{"distance", "m", 50.0, 400.0}, {"grade", "1", -0.05, 0.15}},
                           .responses = {{"cycle", "s"}}};

// Imagine an hour each: there loaded at 200 kW, back at up to 6 m/s.
double haul(const Eigen::VectorXd& x) {
  const double weight = 9.81 * 60.0, resistance = weight * std::max(x[1] + 0.03, 0.01);  // kN
  return x[0] / std::min(200.0 / resistance, 6.0) + x[0] / 6.0 + 60.0;
}

int main(int argc, char** argv) {
  const std::filesystem::path csv_path = argc > 1 ? argv[1] : "resume.csv",
                              journal = csv_path.string() + ".journal";
  std::filesystem::remove(journal);  // left out in earnest: it is what goes on
  const Eigen::MatrixXd X = doe::latin_hypercube(hauling, 20);
  std::ofstream csv(csv_path);
  csv << "call,distance,grade,cycle\n";

  for (int call = 1; call <= 3; ++call) {
    std::stop_source stop;
    int made = 0;
    doe::EvaluateOptions options{.stop = stop.get_token(), .journal = journal};
    options.on_result = [&](const doe::Evaluation& run) {  // of the runs that are made, not of those on disk
      csv << call << ',' << run.x[0] << ',' << run.x[1] << ',' << run.outcome.values()[0] << '\n';
      if (++made == 8 && call == 1)
        stop.request_stop();  // Ctrl-C, a power failure, the end of the working day
    };
    const doe::Evaluations runs = doe::evaluate(haul, hauling, X, options);
    std::printf("call %d: %d runs made, %zu of 20 there\n", call, made, runs.rows.size());
  }
  const doe::Evaluations at_once = doe::evaluate(haul, hauling, X),
                         from_disk = doe::evaluate(haul, hauling, X, {.journal = journal});
  const bool same = at_once.y("cycle") == from_disk.y("cycle");
  std::printf("the bits of a run without a stop: %s\n", same ? "yes" : "no");
  return same ? 0 : 1;
}
