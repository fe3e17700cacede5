// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/from_file/study_file.h>
#include <drawpoint/studies/run/points/imported_points.h>
#include <drawpoint/studies/run/points/told_outcomes.h>
#include <drawpoint/studies/run/program/program_reply.h>
#include <drawpoint/studies/run/run_ends.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/fuzz/own_folder.hpp>

namespace drawpoint::fuzz {
namespace {

using namespace studies;

const OwnFolder& texts_folder() {
  static const OwnFolder made;
  return made;
}

const doe::Problem& problem() {
  static const doe::Problem made{
      .variables = {{"speed", "m/s", 1.0, 6.0}, doe::categorical_variable("lining", {"steel", "rubber"})},
      .responses = {{.name = "wear", .unit = "1", .goal = doe::Goal::minimize, .lower = 0},
                    {.name = "load", .unit = "t", .goal = doe::Goal::record}}};
  return made;
}

std::vector<studies::Run> planned_runs() {
  std::vector<studies::Run> runs(3);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k].id = runs[k].point = static_cast<std::int64_t>(k) + 1;
    runs[k].x = Eigen::Vector2d(2.0, 1.0);
  }
  runs[2].status = Status::done;
  runs[2].y = Eigen::Vector2d(0.5, 3.0);
  return runs;
}

}  // namespace

void read_study_file(Bytes bytes) {
  const std::filesystem::path file = texts_folder() / "study.json";
  write(file, bytes);
  taken_or_refused([&] { study_from(file.string()); });
}

void read_reply(Bytes bytes) {
  if (bytes.empty()) return;
  const std::string text = text_of(bytes.subspan(1));
  if (bytes[0] % 2 == 0) {
    reply_of(text, problem());
    return;
  }
  doe::ProcessEnd end;
  end.reply = text;
  run_end(end, texts_folder() / "printed.txt");
}

void read_table(Bytes bytes) {
  if (bytes.empty()) return;
  const std::filesystem::path file = texts_folder() / "table.csv";
  write(file, bytes.subspan(1));
  taken_or_refused([&] {
    if (bytes[0] % 2 == 0) {
      for (const studies::Run& run : imported_runs(file, problem(), {}))
        if (!run.x.allFinite() || !run.y.allFinite()) __builtin_trap();
      return;
    }
    for (const ToldOutcome& outcome : told_outcomes(file, problem(), planned_runs(), true).outcomes)
      if (outcome.run < 1 || outcome.run > 3) __builtin_trap();
  });
}

}  // namespace drawpoint::fuzz
