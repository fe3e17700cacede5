// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/points.h>
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/store/folder.h>
#include <drawpoint/studies/store/option_values.h>
#include <fcntl.h>
#include <unistd.h>
#include <drawpoint/doe/black_box.hpp>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

/// A folder for the log of a run that nobody wants to keep.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "drawpoint-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("studies: cannot make a folder for the run log in " +
                               fs::temp_directory_path().string() + ": " + std::strerror(errno) +
                               "; name a file with --log");
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The reply channel belongs to this process alone: a program that the black box starts must not keep it
/// open.
void keep_private(int descriptor) {
  if (descriptor >= 0 && fcntl(descriptor, F_SETFD, FD_CLOEXEC) != 0) {
    throw UsageError("--result-descriptor " + std::to_string(descriptor) + ": not an open file descriptor");
  }
}

void reply(int descriptor, const doe::Outcome& outcome) {
  const std::string text = reply_text(outcome);
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = write(descriptor, text.data() + written, text.size() - written);
    if (count < 0)
      throw std::runtime_error(std::string("studies: cannot pass on the outcome: ") + std::strerror(errno));
    written += static_cast<std::size_t>(count);
  }
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
  if (outcome.failed()) std::fprintf(stderr, "the run failed: %s\n", outcome.reason().c_str());
  for (Eigen::Index i = 0; i < outcome.values().size(); ++i) {
    const auto& response = problem.responses[static_cast<std::size_t>(i)];
    std::printf("%s = %s\n", response.name.c_str(),
                doe::detail::with_unit(outcome.values()[i], response.unit).c_str());
  }
}

/// `as_stored`: whether a run that was made again came out as before.
int pass_on(const Study& study, const PointSettings& settings, const doe::Outcome& outcome,
            const std::optional<bool>& as_stored = {}) {
  if (settings.result_descriptor >= 0) {
    reply(settings.result_descriptor, outcome);
  } else {
    print(study.problem, outcome, settings.json, as_stored);
  }
  return as_stored ? !*as_stored : outcome.failed();
}

/// A run of a study, and what it takes to make it again.
struct RunToRepeat {
  Run run;
  PointSettings settings;
};

RunToRepeat run_to_repeat(const Study& study, const PointSettings& given) {
  if (!given.options.empty())
    throw UsageError("--run " + std::to_string(*given.run) + ": its options are the study's; leave out --" +
                     given.options.begin()->first);
  const Folder folder{given.out};
  const Store store = open_store(study, folder);
  require_same_simulator(study, store, folder);
  RunToRepeat stored{stored_run(store, folder, *given.run), given};
  if (stored.run.kind == Kind::imported)
    throw UsageError("--run " + std::to_string(*given.run) +
                     ": it was made elsewhere and imported; give its point with --x to simulate it here");
  stored.settings.x.assign(stored.run.x.begin(), stored.run.x.end());
  stored.settings.seed = stored.run.seed;
  stored.settings.options = store.identity().options;
  if (stored.settings.shared.empty()) stored.settings.shared = folder.shared();
  return stored;
}

/// Empty where nothing is stored yet. Prints the answer.
std::optional<bool> compare_with_stored(const Run& run, const doe::Outcome& outcome) {
  const std::string name = "run " + std::to_string(run.id);
  if (run.status != Status::done && run.status != Status::failed) {
    std::fprintf(stderr, "%s has not ended yet: nothing is stored to hold this against\n", name.c_str());
    return {};
  }
  if (run.status == Status::failed && !outcome.failed()) {
    std::fprintf(stderr, "%s succeeds here; it is stored as failed: %s\n", name.c_str(), run.reason.c_str());
    return false;
  }
  const bool same = outcome.failed() ? run.status == Status::failed && outcome.reason() == run.reason
                                     : run.status == Status::done && outcome.values() == run.y;
  std::fprintf(stderr, same ? "%s: as stored, bit for bit\n" : "%s: not as stored\n", name.c_str());
  return same;
}

/// What a run by hand or the preparation is told.
RunContext context_of(const Study& study, const PointSettings& settings, const fs::path& log,
                      const fs::path& shared) {
  check_options(study, settings.options);
  return {.log = log, .shared = shared, .options = with_defaults(study.options, settings.options)};
}

/// The folder appears complete or not at all.
void fill_shared(const Study& study, const PointSettings& settings, const fs::path& folder) {
  const fs::path draft = folder.string() + ".unfinished";
  fs::remove_all(draft);
  fs::create_directories(draft);
  study.prepare(context_of(study, settings, {}, draft));
  fs::rename(draft, folder);
}

/// The shared folder for a run by hand: the one that is named, filled where it is not there yet, else one
/// that is made for this run alone.
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

}  // namespace

int evaluate_command(const Study& study, const PointSettings& given) {
  require_simulator(study);
  if (!given.run && given.x.empty())
    throw UsageError("evaluate: give a point with --x, or a run of a study with --run; see evaluate --help");
  std::optional<RunToRepeat> stored;
  if (given.run) stored = run_to_repeat(study, given);
  const PointSettings& settings = stored ? stored->settings : given;
  const Eigen::MatrixXd points = checked_points(study.problem, settings.x);
  if (points.rows() > 1) throw UsageError("--x: got " + std::to_string(points.rows()) + " points; give one");
  const Eigen::VectorXd x = points.row(0);
  keep_private(settings.result_descriptor);
  std::optional<TemporaryFolder> temporary;
  if (settings.log.empty()) temporary.emplace();
  RunContext context =
      context_of(study, settings, settings.log.empty() ? temporary->path() / "run.h5" : settings.log,
                 shared_folder(study, settings, temporary));
  if (context.log.has_parent_path()) fs::create_directories(context.log.parent_path());
  if (settings.result_descriptor >= 0)
    fs::remove(context.log);  // what an attempt that was killed has left
  else
    context.progress = [](const std::string& where) { std::fprintf(stderr, "%s\n", where.c_str()); };
  const auto black_box = [&](const Eigen::VectorXd& point, doe::Seed seed) {
    return study.black_box(point, seed, context);
  };
  const doe::Outcome outcome = doe::detail::call(black_box, study.problem, x, settings.seed);
  return pass_on(study, settings, outcome,
                 stored ? compare_with_stored(stored->run, outcome) : std::optional<bool>());
}

int prepare_command(const Study& study, const PointSettings& settings) {
  keep_private(settings.result_descriptor);
  const doe::Outcome outcome = doe::detail::guarded<doe::Outcome>([&]() -> doe::Outcome {
    if (study.prepare) study.prepare(context_of(study, settings, {}, settings.shared));
    return Eigen::VectorXd(0);
  });
  return pass_on(study, settings, outcome);
}

}  // namespace drawpoint::studies
