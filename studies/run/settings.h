// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the command line says, after parsing. An empty optional means "as stored in the output folder, else
/// the study's default", so that a study resumes without repeating its options.

#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/studies/options.hpp>

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// The user asked for something that cannot be: exit code 2. Everything else that goes wrong is exit code 1.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Options of `confirm`.
struct ConfirmSettings {
  int points = 6;                   ///< of the front per round, 1 or more; with `x` 0 or more
  int rounds = 3;                   ///< at most, 1 or more
  std::vector<std::string> x = {};  ///< points besides those of the front, one after the other, as typed
};

/// Options of `ask`.
struct AskSettings {
  std::optional<int> count = {};  ///< runs at most, 1 or more
  bool confirm = false;           ///< points of the front in place of an adaptive batch
};

/// Options of `exclude`.
struct ExcludeSettings {
  std::optional<std::int64_t> run = {};  ///< empty: the ledger is shown
  std::string why = {};
  bool undo = false;  ///< taken in again
};

/// Options of `export`; of `ask` but for `what`.
struct ExportSettings {
  std::string what = {};            ///< runs, which empty stands for, front or findings
  std::string format = "csv";       ///< or json; of `export` also hdf5, the whole study
  std::filesystem::path file = {};  ///< empty: standard output
};

/// Options of `predict`.
struct PredictSettings {
  std::vector<std::string> x = {};    ///< points, one after the other, as typed
  std::filesystem::path points = {};  ///< a table of points; empty: none
};

/// Options of `share` and `open`.
struct ShareSettings {
  std::filesystem::path file =
      {};                ///< all files of the study; of `share` empty: the folder's name, beside it
  bool logs = true;      ///< those of runs go with it
  bool replace = false;  ///< of `share`: a file that is there already
};

/// Options of `front`.
struct FrontSettings {
  int limit = 6;             ///< points shown, 1 or more: as many as a round of `confirm` simulates
  bool every_point = false;  ///< all of them
};

/// Options of `replay` that make pictures of the page.
struct FrameSettings {
  std::filesystem::path folder = {};  ///< for PNG files; empty: none are kept
  std::filesystem::path video = {};   ///< empty: none
  std::optional<double> from = {};    ///< [s]; empty: from the first picture of the scene
  std::optional<double> to = {};      ///< [s]; empty: to the last
  double fps = 20.0;                  ///< frames per second of film
  double speed = 1.0;                 ///< seconds of the run per second of film
  std::string size = "1280x720";      ///< width x height [pixel]
  std::string camera = "home";        ///< or side, above
  std::string given = {};             ///< one of the options above but the first two; empty: none was
};

/// Options of `replay`.
struct ReplaySettings {
  std::int64_t run = 0;
  std::optional<int> cycle = {};  ///< alone; empty: all on a page, the first as pictures
  std::filesystem::path file =
      {};  ///< empty: replay_0001.html in the folder, of one cycle replay_0001_cycle_2.html
  FrameSettings frames = {};  ///< where it names a folder or a video, in place of the page
};

/// Options of `live`.
struct LiveSettings {
  int port = 0;  ///< of 127.0.0.1; 0: any that is free
};

/// Options of `tell`.
struct TellSettings {
  std::filesystem::path table = {};
  bool replace = false;  ///< runs that have ended otherwise are corrected
  std::string why = {};  ///< with replace
};

/// Options of `recommend`.
struct RecommendSettings {
  std::string against = {};  ///< a point as NAME=VALUE,...; empty: the middle of the box
};

/// Options of `compare`, and of `validate` with another folder.
struct CompareSettings {
  std::filesystem::path with = {};  ///< the folder that `out` is compared with
};

/// Options of `rerun-responses`.
struct RerunSettings {
  std::filesystem::path from = {};  ///< the folder whose runs are taken
};

/// Which runs a study makes.
struct PlanSettings {
  std::optional<int> runs = {};        ///< training points, 2 or more
  std::optional<int> validation = {};  ///< validation points, 0 or more
  std::optional<int> replicates = {};  ///< runs per training point, each with a seed of its own, 1 or more
  std::optional<doe::Seed> seed = {};  ///< study seed
  std::optional<int> adaptive = {};    ///< adaptive points, 0 or more
  std::optional<int> batch = {};       ///< adaptive points chosen together, 1 or more
  std::optional<std::string> criteria = {};  ///< who chooses them: model/sampling/criteria.h
  std::optional<double> target = {};         ///< error of the mean at which to stop choosing; 0: none
  std::optional<std::string> until =
      {};  ///< errors at which to stop choosing: model/fits/stop_rule.h; "": none
  std::filesystem::path imported = {};                     ///< table of points made elsewhere; empty: none
  double hours = std::numeric_limits<double>::infinity();  ///< after which no batch is begun
};

/// How runs are made.
struct ExecutionSettings {
  std::optional<int> jobs = {};  ///< processes or tasks at a time, 1 or more; empty: all there are
  bool slurm = false;            ///< runs are tasks on a Slurm cluster
  std::vector<std::string> slurm_options = {};  ///< words for sbatch
  int slurm_array = 0;                          ///< tasks of one job array; 0: as many as Slurm takes
  double time_limit = 0.0;                      ///< [s] a run may take; 0 means no limit
  std::string budget = {};                      ///< wall time of a command, run/budget.h; empty: no end
  bool retry_failed = false;
  bool keep_going = false;                      ///< though the first runs all fail alike
  bool spot_check = true;                       ///< on resume, one run is made again and compared
  std::vector<std::string> leading_words = {};  ///< of the study, for its processes
  std::function<void(const std::filesystem::path& log)> finish_log = {};  ///< of the study
};

/// Options of the commands that work on an output folder: run, confirm, status, report and their like.
struct Settings {
  std::filesystem::path out = {};
  OptionValues options = {};            ///< of the study, those given
  std::vector<std::string> marks = {};  ///< NAME=VALUE,..., points to show in the report
  bool json = false;  ///< last line of standard output is one JSON object, the rest goes to standard error
  PlanSettings plan = {};
  ExecutionSettings execution = {};
  AskSettings ask = {};
  CompareSettings compare = {};
  ConfirmSettings confirm = {};
  ExcludeSettings exclude = {};
  ExportSettings exported = {};
  FrontSettings front = {};
  LiveSettings live = {};
  PredictSettings predict = {};
  RecommendSettings recommend = {};
  ReplaySettings replay = {};
  RerunSettings rerun = {};
  ShareSettings share = {};
  TellSettings tell = {};
  std::string program = {};  ///< what was typed before the command, for advice
  std::string command = {};  ///< the command line as typed, for the report
};

/// Options of `evaluate`, which runs one point in this process.
struct PointSettings {
  std::optional<std::int64_t> run =
      {};  ///< a run of the study in `out`, whose point, seed and options are taken
  std::filesystem::path out = {};
  std::vector<std::string> x = {};  ///< in the order of the problem's variables, as typed
  doe::Seed seed = 1;
  std::filesystem::path log = {};     ///< empty: a temporary file
  std::filesystem::path shared = {};  ///< folder that Study::prepare fills
  OptionValues options = {};          ///< of the study, those given
  int result_descriptor = -1;         ///< open file descriptor that takes the outcome as JSON; -1: print it
  bool json = false;
};

}  // namespace drawpoint::studies
