// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/one_run.h>
#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/plain_text.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace drawpoint::studies {
namespace {

void show_point(const doe::Problem& problem, const Eigen::VectorXd& x, doe::Seed seed) {
  std::string text;
  for (std::size_t k = 0; k < problem.variables.size(); ++k) {
    const doe::Variable& v = problem.variables[k];
    const double value = x[static_cast<Eigen::Index>(k)];
    text += v.name + " = ";
    text += v.kind == doe::VariableKind::categorical ? v.levels[static_cast<std::size_t>(value)]
                                                     : doe::detail::with_unit(value, v.unit);
    text += ", ";
  }
  std::printf("--- one run at %sseed %llu\n", text.c_str(), static_cast<unsigned long long>(seed));
  std::fflush(stdout);
}

/// What the program prints comes between the two by itself.
void show_exchange(const std::string& what, const std::string& text) {
  constexpr std::size_t most = 20000;
  std::printf("--- %s\n%s%s", what.c_str(), plain_text(text, most).c_str(), text.ends_with('\n') ? "" : "\n");
  if (what == "request") std::printf("--- printed\n");
  std::fflush(stdout);
}

}  // namespace

int check_command(const Study& study, const PointSettings& given) {
  require_simulator(study);
  PointSettings settings = given;
  if (settings.x.empty()) settings.x = typed(middle_of(study.problem));
  const Eigen::MatrixXd points = checked_points(study.problem, settings.x);
  if (points.rows() > 1) throw UsageError("--x: got " + std::to_string(points.rows()) + " points; give one");
  std::optional<TemporaryFolder> temporary;
  temporary.emplace();
  RunContext context =
      context_of(study, settings, temporary->path() / "run.h5", shared_folder(study, settings, temporary));
  context.shows = show_exchange;
  const Eigen::VectorXd x = points.row(0);
  show_point(study.problem, x, settings.seed);
  const auto start = std::chrono::steady_clock::now();
  const Made made = make_run(study, x, settings.seed, context);
  std::printf("--- the run took %.3g s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  std::fflush(stdout);
  print(study.problem, made.outcome, false, {});
  return made.outcome.failed();
}

}  // namespace drawpoint::studies
