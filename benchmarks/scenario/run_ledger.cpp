// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <drawpoint/engine/loading/log/energy_balance.hpp>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "command.hpp"

/// What a run's log must account for: every kilogram of rock, every joule of the motors, and how far constraints and
/// contacts were off. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using namespace drawpoint::engine::loading;

namespace {

constexpr const char* about =
    "Reads the log of a loading run and prints what it has to account for, per cycle and in all:\n"
    "  rock    at first, emitted, loaded, cleared away, escaped, present at the end, and what is\n"
    "          missing in that sum;\n"
    "          a cycle that was lost gives its load to what was cleared away\n"
    "  energy  of the motors of lift, tilt and wheels; gained by machine and rock; the rest is dissipated\n"
    "  errors  deepest overlap of a rock, widest gap of a loop of the linkage, steps that had to be\n"
    "          done again\n"
    "  scatter of production, joint damage and spill from cycle to cycle, and the correlation of a cycle "
    "with\n"
    "          the next: standard errors of a run take cycles as independent\n"
    "  bucket  the rock in it at the end of each stage, mean of the cycles: which of them loads\n\n"
    "  run_ledger results/lhd_loading/logs/run_0001.h5\n"
    "  bucket_fill --piles /tmp/piles --cycles 30 --alphas 1 --seeds 1 --logs /tmp/logs\n"
    "                                                             makes the log of thirty cycles";

double number(const LoadingLog& log, const char* name) {
  const auto found = log.numbers.find(name);
  if (found == log.numbers.end())
    throw std::runtime_error(std::string("the log has no number \"") + name +
                             "\"; give one of this version or one before it that has");
  return found->second;
}

nlohmann::json rock_of(const LoadingLog& log) {
  const double loaded =
      std::accumulate(log.cycles.begin(), log.cycles.end(), 0.0,
                      [](double sum, const CycleRecord& cycle) { return sum + cycle.loaded_mass; });
  const double first = number(log, "pile_mass"), emitted = number(log, "emitted_mass"),
               cleared = number(log, "cleared_mass"), escaped = number(log, "escaped_mass"),
               present = number(log, "present_mass");
  return {{"first_kg", first},
          {"emitted_kg", emitted},
          {"loaded_kg", loaded},
          {"cleared_kg", cleared},
          {"escaped_kg", escaped},
          {"present_kg", present},
          {"missing_kg", first + emitted - loaded - cleared - escaped - present}};
}

nlohmann::json energy_of(const EnergyBalance& balance) {
  return {{"work_kJ", balance.work},
          {"machine_kJ", balance.machine},
          {"rock_kJ", balance.rock},
          {"dissipated_kJ", balance.dissipated}};
}

nlohmann::json cycles_of(const LoadingLog& log) {
  nlohmann::json cycles = nlohmann::json::array();
  const std::vector<EnergyBalance> balances = energy_balance_by_cycle(log);
  const std::vector<double> lost = lost_mass_by_cycle(log);
  for (std::size_t k = 0; k < log.cycles.size(); ++k) {
    const CycleRecord& cycle = log.cycles[k];
    nlohmann::json row = energy_of(balances[k]);
    row.update({{"cycle", cycle.number},
                {"seconds", cycle.seconds()},
                {"loaded_kg", cycle.loaded_mass},
                {"lost_kg", lost[k]}});
    cycles.push_back(row);
  }
  return cycles;
}

/// Of a measure that every cycle has. The correlation with the next is Σ (xᵢ − m)(xᵢ₊₁ − m)/Σ (xᵢ − m)²; of n
/// independent cycles it is −1/n ± 1/√n.
nlohmann::json scatter_of(const char* name, const char* unit, const std::vector<double>& by_cycle) {
  const double n = static_cast<double>(by_cycle.size());
  const double mean = std::accumulate(by_cycle.begin(), by_cycle.end(), 0.0) / n;
  double squares = 0, products = 0;
  for (std::size_t k = 0; k < by_cycle.size(); ++k) {
    squares += (by_cycle[k] - mean) * (by_cycle[k] - mean);
    if (k > 0) products += (by_cycle[k] - mean) * (by_cycle[k - 1] - mean);
  }
  nlohmann::json scatter{{"measure", name}, {"unit", unit}, {"mean", mean}};
  if (by_cycle.size() > 1) scatter["deviation"] = std::sqrt(squares / (n - 1));
  if (squares > 0) scatter["correlation_with_the_next"] = products / squares;
  return scatter;
}

nlohmann::json scatters_of(const LoadingLog& log) {
  if (log.cycles.empty()) return nlohmann::json::array();
  return {scatter_of("production", "kg/s", production_by_cycle(log)),
          scatter_of("joint damage", "s", joint_damage_by_cycle(log)),
          scatter_of("spill", "1", rock_spill_by_cycle(log))};
}

/// By stage, in the order of a cycle; cycles that lack it do not count. Empty for logs without pictures, or of a
/// version that did not weigh in them.
nlohmann::json bucket_of(const LoadingLog& log) {
  nlohmann::json all = nlohmann::json::array();
  for (const Stage stage : {Stage::drive_in, Stage::lift, Stage::curl, Stage::back_out}) {
    std::map<int, double> at_the_end;
    for (const SceneFrame& frame : log.scene.frames)
      if (frame.label == name(stage) && !std::isnan(frame.bucket_mass))
        at_the_end[frame.cycle] = frame.bucket_mass;
    if (at_the_end.empty()) continue;
    const double sum = std::accumulate(at_the_end.begin(), at_the_end.end(), 0.0,
                                       [](double s, const auto& of_cycle) { return s + of_cycle.second; });
    all.push_back({{"stage", name(stage)}, {"mean_kg", sum / static_cast<double>(at_the_end.size())}});
  }
  return all;
}

nlohmann::json ledger(const LoadingLog& log) {
  EnergyBalance sum;
  for (const EnergyBalance& balance : energy_balance_by_cycle(log)) {
    sum.work += balance.work;
    sum.machine += balance.machine;
    sum.rock += balance.rock;
    sum.dissipated += balance.dissipated;
  }
  return {{"completed", log.completed},
          {"message", log.message},
          {"cycles", cycles_of(log)},
          {"rock", rock_of(log)},
          {"energy", energy_of(sum)},
          {"scatter", scatters_of(log)},
          {"bucket", bucket_of(log)},
          {"errors",
           {{"overlap_mm", 1e3 * number(log, "largest_overlap")},
            {"loop_gap_mm", 1e3 * number(log, "largest_loop_error")},
            {"repeated_steps", number(log, "repeated_steps")},
            {"lost_cycles", number(log, "lost_cycles")}}}};
}

double of(const nlohmann::json& j, const char* key) { return j.at(key).get<double>(); }

void print(const nlohmann::json& j) {
  std::printf("cycle  time s  loaded kg     lost kg  work kJ  machine kJ  rock kJ  dissipated kJ\n");
  for (const auto& c : j.at("cycles"))
    std::printf("%5d  %6.1f  %9.0f  %10.0f  %7.0f  %10.0f  %7.0f  %13.0f\n", c.at("cycle").get<int>(),
                of(c, "seconds"), of(c, "loaded_kg"), of(c, "lost_kg"), of(c, "work_kJ"), of(c, "machine_kJ"),
                of(c, "rock_kJ"), of(c, "dissipated_kJ"));
  const auto &rock = j.at("rock"), &energy = j.at("energy"), &errors = j.at("errors");
  std::printf(
      "rock: %.0f kg at first + %.0f emitted - %.0f loaded - %.0f cleared - %.0f escaped = %.0f "
      "present, missing %.2g kg\n",
      of(rock, "first_kg"), of(rock, "emitted_kg"), of(rock, "loaded_kg"), of(rock, "cleared_kg"),
      of(rock, "escaped_kg"), of(rock, "present_kg"), of(rock, "missing_kg"));
  std::printf("energy: %.0f kJ of the motors = %.0f to the machine + %.0f to the rock + %.0f dissipated\n",
              of(energy, "work_kJ"), of(energy, "machine_kJ"), of(energy, "rock_kJ"),
              of(energy, "dissipated_kJ"));
  std::printf("errors: overlap %.1f mm, gap of a loop %.2g mm, %.0f steps done again, %.0f cycles lost\n",
              of(errors, "overlap_mm"), of(errors, "loop_gap_mm"), of(errors, "repeated_steps"),
              of(errors, "lost_cycles"));
  if (!j.at("bucket").empty()) {
    std::printf("rock in the bucket at the end of");
    for (const auto& s : j.at("bucket"))
      std::printf("%s %s %.2f t", s == j.at("bucket").front() ? "" : ",",
                  s.at("stage").get<std::string>().c_str(), 1e-3 * of(s, "mean_kg"));
    std::printf("\n");
  }
  for (const auto& s : j.at("scatter")) {
    if (!s.contains("correlation_with_the_next")) continue;
    const std::string unit = s.at("unit").get<std::string>();
    std::printf("%s: %.3g%s per cycle, deviation %.3g, correlation with the next cycle %.2f\n",
                s.at("measure").get<std::string>().c_str(), of(s, "mean"),
                (unit == "1" ? "" : " " + unit).c_str(), of(s, "deviation"),
                of(s, "correlation_with_the_next"));
  }
  if (!j.at("completed").get<bool>())
    std::printf("the run did not complete: %s\n", j.at("message").get<std::string>().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  std::string path;
  bool json = false;
  CLI::App app(about, "run_ledger");
  app.add_option("LOG_FILE", path, "of a loading run (HDF5)")->required();
  add_json_flag(app, json);
  return run_command(app, argc, argv, [&] { return show(ledger(read_log(path)), json, print); });
}
