// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A program as a black box whose runs are tasks on an existing Slurm cluster.
///
///     doe::evaluate(doe::slurm_array({"/home/me/simulate", "--x={x}", "--seed={seed}"},
///                                    {.slurm = {.folder = "/scratch/me/runs", .options = {"--mem=2G"}}}),
///                   problem, X)
///
/// Words of the command, values and failures are as in process_pool.hpp: equal programs give equal outcomes
/// on both. slurm_jobs.hpp says where the runs live and what happens when a node is lost. If the caller dies,
/// its tasks run on; the same call (points, seeds, folder) then takes over what they have done. The programs,
/// `folder` and `output` must have the same names on all nodes. Linux only.

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/detail/command_runs.hpp>
#include <drawpoint/doe/slurm_jobs.hpp>

namespace drawpoint::doe {

struct SlurmArrayOptions {
  SlurmOptions slurm = {};                                      ///< folder, words for sbatch, tasks at a time
  double time_limit = std::numeric_limits<double>::infinity();  ///< of a run [s], above 0; then it is killed
  std::filesystem::path output = {};  ///< folder for what runs print, as ProcessPoolOptions::output
  std::stop_token stop = {};  ///< requested: what Slurm has is cancelled, these and the others have failed
};

/// What slurm_array returns: a batch function. One call at a time.
class SlurmArrayFunction {
 public:
  SlurmArrayFunction(std::vector<std::string> command, SlurmArrayOptions options)
      : command_{std::move(command), options.time_limit, options.output}, options_(std::move(options)) {
    command_.check("doe::slurm_array");
  }

  /// X: n x d, one run per row. Throws as SlurmJobs.
  std::vector<Outcome> operator()(const Eigen::MatrixXd& X, std::span<const Seed> seeds) const {
    SlurmJobs jobs(options_.slurm);
    std::vector<Outcome> outcomes = detail::carry_out(command_, jobs, X, seeds, options_.stop);
    if (jobs.running() > 0) jobs.cancel();
    jobs.forget();
    return outcomes;
  }

 private:
  detail::RunCommand command_;
  SlurmArrayOptions options_;
};

/// The black box. Throws std::invalid_argument for an empty command, one without {x}, and options out of
/// range.
inline SlurmArrayFunction slurm_array(std::vector<std::string> command, SlurmArrayOptions options) {
  return SlurmArrayFunction(std::move(command), std::move(options));
}

static_assert(BatchFunction<SlurmArrayFunction>);

}  // namespace drawpoint::doe
