// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/one_run.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <drawpoint/doe/black_box.hpp>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

/// The folder appears complete or not at all.
void fill_shared(const Study& study, const PointSettings& settings, const fs::path& folder) {
  const fs::path draft = folder.string() + ".unfinished";
  fs::remove_all(draft);
  fs::create_directories(draft);
  study.prepare(context_of(study, settings, {}, draft));
  fs::rename(draft, folder);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "drawpoint-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("studies: cannot make a folder for the run log in " +
                             fs::temp_directory_path().string() + ": " + std::strerror(errno) +
                             "; name a file with --log");
  }
  path_ = name;
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Made make_run(const Study& study, const Eigen::VectorXd& x, doe::Seed seed, const RunContext& context) {
  Made made;
  const auto black_box = [&](const Eigen::VectorXd& point, doe::Seed of_run) -> doe::Outcome {
    try {
      return study.black_box(point, of_run, context);
    } catch (const ProgramTrouble& trouble) {
      made.trouble = trouble.kind;
      return doe::Failure{trouble.what()};
    }
  };
  made.outcome = doe::detail::call(black_box, study.problem, x, seed);
  return made;
}

void print(const doe::Problem& problem, const doe::Outcome& outcome, bool as_json,
           const std::optional<bool>& as_stored) {
  if (as_json) {
    nlohmann::json line = {{"failed", outcome.failed()}};
    if (as_stored) line["as_stored"] = *as_stored;
    if (outcome.failed()) line["reason"] = outcome.reason();
    for (Eigen::Index i = 0; i < outcome.values().size(); ++i) {
      line["values"][problem.responses[static_cast<std::size_t>(i)].name] = outcome.values()[i];
    }
    std::printf("%s\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return;
  }
  if (outcome.failed()) std::fprintf(stderr, "the run failed: %s\n", plain_text(outcome.reason()).c_str());
  for (Eigen::Index i = 0; i < outcome.values().size(); ++i) {
    const auto& response = problem.responses[static_cast<std::size_t>(i)];
    std::printf("%s = %s\n", response.name.c_str(),
                doe::detail::with_unit(outcome.values()[i], response.unit).c_str());
  }
}

RunContext context_of(const Study& study, const PointSettings& settings, const fs::path& log,
                      const fs::path& shared) {
  check_options(study, settings.options);
  return {.log = log, .shared = shared, .options = with_defaults(study.options, settings.options)};
}

fs::path shared_folder(const Study& study, const PointSettings& settings,
                       std::optional<TemporaryFolder>& temporary) {
  if (!settings.shared.empty() && (fs::exists(settings.shared) || !study.prepare)) return settings.shared;
  if (settings.shared.empty() && !temporary) temporary.emplace();
  const fs::path folder = settings.shared.empty() ? temporary->path() / "shared" : settings.shared;
  if (study.prepare)
    fill_shared(study, settings, folder);
  else
    fs::create_directory(folder);
  return folder;
}

}  // namespace drawpoint::studies
