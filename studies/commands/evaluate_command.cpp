// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/one_run.h>
#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/run/program/printed_text.h>
#include <drawpoint/studies/run/run_ends.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <fcntl.h>
#include <unistd.h>
#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/detail/stranger_file.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

/// The reply channel belongs to this process alone: a program that the black box starts must not keep it
/// open.
void keep_private(int descriptor) {
  if (descriptor >= 0 && fcntl(descriptor, F_SETFD, FD_CLOEXEC) != 0) {
    throw UsageError("--result-descriptor " + std::to_string(descriptor) + ": not an open file descriptor");
  }
}

void reply(int descriptor, const Made& made) {
  const std::string text = reply_text(made.outcome, made.trouble);
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = write(descriptor, text.data() + written, text.size() - written);
    if (count < 0)
      throw std::runtime_error(std::string("studies: cannot pass on the outcome: ") + std::strerror(errno));
    written += static_cast<std::size_t>(count);
  }
}

/// `as_stored`: whether a run that was made again came out as before.
int pass_on(const Study& study, const PointSettings& settings, const Made& made,
            const std::optional<bool>& as_stored = {}) {
  if (settings.result_descriptor >= 0) {
    reply(settings.result_descriptor, made);
  } else {
    print(study.problem, made.outcome, settings.json, as_stored);
  }
  return as_stored ? !*as_stored : made.outcome.failed();
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
  stored.settings.x = typed(stored.run.x);
  stored.settings.seed = stored.run.seed;
  stored.settings.options = store.identity().options;
  if (stored.settings.shared.empty()) stored.settings.shared = folder.shared();
  return stored;
}

/// But for what the run printed, which was kept in the folder alone.
bool same_reason(const std::string& here, const std::string& stored) {
  const std::string plain = plain_text(here);
  return stored == plain || stored.starts_with(plain + printed_last_begins);
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
  const bool same = outcome.failed()
                        ? run.status == Status::failed && same_reason(outcome.reason(), run.reason)
                        : run.status == Status::done && outcome.values() == run.y;
  std::fprintf(stderr, same ? "%s: as stored, bit for bit\n" : "%s: not as stored\n", name.c_str());
  return same;
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
    doe::detail::clear_away(context.log);  // what an attempt that was killed has left
  else
    context.progress = [](const std::string& where) { std::fprintf(stderr, "%s\n", where.c_str()); };
  const Made made = make_run(study, x, settings.seed, context);
  return pass_on(study, settings, made,
                 stored ? compare_with_stored(stored->run, made.outcome) : std::optional<bool>());
}

int prepare_command(const Study& study, const PointSettings& settings) {
  keep_private(settings.result_descriptor);
  const doe::Outcome outcome = doe::detail::guarded<doe::Outcome>([&]() -> doe::Outcome {
    if (study.prepare) study.prepare(context_of(study, settings, {}, settings.shared));
    return Eigen::VectorXd(0);
  });
  return pass_on(study, settings, {outcome});
}

}  // namespace drawpoint::studies
