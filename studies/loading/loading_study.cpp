// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_contrasts.h>
#include <drawpoint/studies/loading/loading_figures.h>
#include <drawpoint/studies/loading/loading_headlines.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/loading/loading_study.h>
#include <drawpoint/engine/loading/libraries.hpp>
#include <drawpoint/engine/loading/log/log_stream.hpp>

#include <algorithm>

namespace drawpoint::studies {
namespace {

using engine::loading::LoadingLog;
using engine::loading::Scenario;

doe::Outcome responses_of(const LoadingStudy& loading, const LoadingLog& log, const OptionValues& options) {
  if (!log.completed) return doe::Failure{log.message};
  return loading.responses(log, options);
}

/// Noise is said of responses that the study has.
std::vector<Headline> headlines_of(const doe::Problem& problem, std::vector<Headline> said) {
  const std::string noise = "noise_of_";
  std::erase_if(said, [&](const Headline& headline) {
    return headline.name.rfind(noise, 0) == 0 &&
           std::none_of(problem.responses.begin(), problem.responses.end(),
                        [&](const doe::Response& r) { return noise + r.name == headline.name; });
  });
  return said;
}

}  // namespace

Study study_of(const LoadingStudy& loading) {
  return {.name = loading.name,
          .problem = loading.problem,
          .black_box =
              [loading](const Eigen::VectorXd& x, doe::Seed seed, const RunContext& run) {
                Scenario scenario = loading.scenario(x, run);
                scenario.seed = seed;
                scenario.log_file = run.log;
                return responses_of(loading, simulate_run(scenario, run), run.options);
              },
          .about = loading.about,
          .defaults = loading.defaults,
          .options = loading.options,
          .options_complaint = loading_options_complaint,
          .prepare =
              [loading](const RunContext& run) {
                settle_pile(loading.scenario(middle_of(loading.problem), run));
              },
          .simulator = {.name = engine::loading::simulator, .libraries = engine::loading::libraries()},
          .logs = {.finish = engine::loading::join_parts,
                   .responses =
                       [loading](const std::filesystem::path& log, const OptionValues& options) {
                         return responses_of(loading, engine::loading::read_log(log, loading.content),
                                             options);
                       },
                   .cycles = loading_cycles},
          .presentation = {.illustrate = loading_figures,
                           .replay = loading_replay,
                           .contrast = loading_contrasts,
                           .headlines = [loading](const std::vector<std::filesystem::path>& logs,
                                                  const OptionValues& options) {
                             return headlines_of(loading.problem, loading_headlines(logs, options));
                           }}};
}

std::vector<StudyOption> loading_options_without(const std::set<std::string>& names) {
  std::vector<StudyOption> options = loading_options();
  std::erase_if(options, [&](const StudyOption& option) { return names.count(option.name) != 0; });
  return options;
}

RunContext with_options(RunContext run, const OptionValues& values) {
  for (const auto& [name, value] : values) run.options[name] = value;
  for (const StudyOption& option : loading_options()) run.options.emplace(option.name, option.value);
  return run;
}

doe::Response recorded(const char* name, const char* unit, const std::string& description) {
  return {.name = name, .unit = unit, .goal = doe::Goal::record, .lower = 0, .description = description};
}

doe::Response standard_error(const char* name, const char* unit, const std::string& of) {
  return recorded(name, unit, "standard error of " + of + ", by the scatter of the run's cycles");
}

}  // namespace drawpoint::studies
