// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A study is a problem, a black box and a name; from these, `run` makes a whole program:
///
///     int main(int argc, char** argv) {
///       return drawpoint::studies::run(argc, argv,
///                                      {.name = "my_study", .problem = problem, .black_box = f});
///     }
///
/// The program has the commands run, check, confirm, ask, tell, exclude, status, live, fit, validate, front,
/// compare, report, replay, export, evaluate and rerun-responses (docs/reference/studies.md). Every run is a process of
/// its own with one thread, so that a crash is one failed run; each finished run is stored before the next one starts.
/// Equal (x, seed) must give equal outcomes: a run that was lost is simply run again.
///
/// A figure of a simulation ("panel") is a JSON object with "type", "title", "caption" and, by type,
///   path   contour, planned, actual: {x: [], z: []}; stages?: [{name, x, z}]; x_label, z_label
///   plan   from above: x, y: middles of columns along and across, heights: [[per x] per y]; walls: [y, y];
///          curves: [{name, x, y}]; place: {name, x: [low, high], y: [low, high]}; x_label, y_label, z_label
///   scene  shapes: [{vertices: [[x,y,z]..], faces: [[i,j,k..]..]}], bodies: [{shape, color, opacity, name}],
///          frames: [{t, label, poses: [[x,y,z,qw,qx,qy,qz] or null, one per body]}], camera: {eye, target},
///          poster_frame; metres, seconds, z up; faces counter-clockwise seen from outside. In place of all
///          poses each body may have track: [[frame, x,y,z,qw,qx,qy,qz] or [frame], where it hides], its poses
///          in some frames, between which it moves evenly; or with: k, to move as body k does. follow?: the
///          body that a camera goes with; look? of a body: rock, tyre (a cylinder about its y axis), steel,
///          paint, glass, lamp, or drift; drift?: {from, length, width, height, raise: {x, radius}}: rough rock
///          along x up to length, on z = 0, with lamps, drawn in place of the bodies that look so; signals?:
///          [{name, unit, t: [], y: [], lines?: [{name, y}]}], drawn below in time with the scene
///   lines  series: [{name, x: [], y: []}]; x_label, y_label
///   table  columns: [], rows: [[]..]
/// and note?: how to read it, which a page says once where several figures have the same; in_scene?: true where
/// a scene of the same run shows it too, beside which it is left out; cycle?: see Presentation::replay.

#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/studies/cycle_work.hpp>
#include <drawpoint/studies/finding.hpp>
#include <drawpoint/studies/headline.hpp>
#include <drawpoint/studies/mark.hpp>
#include <drawpoint/studies/options.hpp>

#include <Eigen/Core>
#include <concepts>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace drawpoint::studies {

// The library and its users hand Eigen's vectors to each other, and free them.
static_assert(
    EIGEN_MAX_ALIGN_BYTES == 16 && EIGEN_MALLOC_ALREADY_ALIGNED == 1,
    "drawpoint: this file lays out or allocates Eigen types otherwise than the library of studies. Link "
    "Drawpoint::studies, or define EIGEN_MAX_ALIGN_BYTES=16 and EIGEN_MALLOC_ALREADY_ALIGNED=1 before "
    "Eigen is included for the first time");

/// Where one run may write and read, and what holds for all runs of its study.
struct RunContext {
  std::filesystem::path log;  ///< run log that this run may write; its folder exists, the file does not
  std::filesystem::path
      shared;                 ///< folder common to all runs of the study, filled by Study::prepare; read only
  OptionValues options = {};  ///< a value of every Study::options
  /// Takes where a long run is, in a few words for people. Empty where nobody listens.
  std::function<void(const std::string&)> progress = {};
  /// Takes what passes between a run and its program, as "request" or "reply" and its text. Empty where nobody
  /// looks.
  std::function<void(const std::string& what, const std::string& text)> shows = {};
};

/// How many runs a study makes when the command line does not say.
struct Defaults {
  int runs = 40;        ///< training runs, at least 2
  int validation = 10;  ///< independent validation runs, may be 0
  int adaptive = 0;     ///< runs chosen by what the training runs show, may be 0
};

/// Any of f(x), f(x, seed), f(x, seed, context) whose result converts to doe::Outcome, behind one type.
class StudyFunction {
 public:
  using Erased = std::function<doe::Outcome(const Eigen::VectorXd&, doe::Seed, const RunContext&)>;

  StudyFunction() = default;

  template <class F>
  requires(!std::same_as<std::remove_cvref_t<F>, StudyFunction>) StudyFunction(F f)
      : f_(erase(std::move(f))) {}

  doe::Outcome operator()(const Eigen::VectorXd& x, doe::Seed seed, const RunContext& context) const {
    return f_(x, seed, context);
  }
  explicit operator bool() const { return static_cast<bool>(f_); }

 private:
  template <class F>
  static Erased erase(F f) {
    using X = const Eigen::VectorXd&;
    if constexpr (std::is_invocable_r_v<doe::Outcome, const F&, X, doe::Seed, const RunContext&>) {
      return f;
    } else if constexpr (std::is_invocable_r_v<doe::Outcome, const F&, X, doe::Seed>) {
      return [f = std::move(f)](X x, doe::Seed seed, const RunContext&) { return doe::Outcome(f(x, seed)); };
    } else {
      static_assert(
          std::is_invocable_r_v<doe::Outcome, const F&, X>,
          "drawpoint: not a study's black box. Expected a callable f(x), f(x, seed) or f(x, seed, context) "
          "with const Eigen::VectorXd& x, drawpoint::doe::Seed seed, "
          "const drawpoint::studies::RunContext& context "
          "and a result that converts to drawpoint::doe::Outcome");
      return [f = std::move(f)](X x, doe::Seed, const RunContext&) { return doe::Outcome(f(x)); };
    }
  }

  Erased f_;
};

/// Either of f(logs), f(logs, options) that gives a Result, behind one type.
template <class Result, class Logs>
class LogFunction {
 public:
  using Erased = std::function<Result(const Logs&, const OptionValues&)>;

  LogFunction() = default;

  template <class F>
  requires(!std::same_as<std::remove_cvref_t<F>, LogFunction>) LogFunction(F f) : f_(erase(std::move(f))) {}

  Result operator()(const Logs& logs, const OptionValues& options) const { return f_(logs, options); }
  explicit operator bool() const { return static_cast<bool>(f_); }

 private:
  template <class F>
  static Erased erase(F f) {
    if constexpr (std::is_invocable_r_v<Result, const F&, const Logs&, const OptionValues&>)
      return f;
    else
      return [f = std::move(f)](const Logs& logs, const OptionValues&) { return f(logs); };
  }

  Erased f_;
};

using HeadlineFunction = LogFunction<std::vector<Headline>, std::vector<std::filesystem::path>>;
using CycleFunction = LogFunction<CycleWork, std::filesystem::path>;
using FigureFunction = LogFunction<nlohmann::json, std::filesystem::path>;
using ContrastFunction = LogFunction<nlohmann::json, std::vector<std::filesystem::path>>;

/// What makes the runs: a folder never mixes those of two.
struct Simulator {
  /// Such as another program and its checksum, or a model by a name that changes with what it simulates. Empty: this
  /// program, whatever its version.
  std::string name = {};
  std::string note = {};  ///< said once, when a folder is begun: what counts as the simulator; empty: nothing
  /// Libraries that the black box is made with, each with its version, such as "Simbody 3.7.0": for --version.
  std::vector<std::string> libraries = {};
  /// Words that stand before the command on the command line, such as the file that the study was read from.
  /// The processes of its runs are started with these, whatever was typed.
  std::vector<std::string> leading_words = {};
  /// The study as a file without what makes its runs, for people who have neither: `share` packs it as study.json.
  std::string definition = {};
  /// Nobody says whether it gives equal values at equal points: a design of twenty runs or more asks it, by one more
  /// run at its point nearest to the middle.
  bool asks_for_chance = false;
};

/// What the logs of runs are good for.
struct Logs {
  /// Called with the log of a run that has ended, by itself or not, before it is kept: a black box that writes
  /// more files than that one makes one of them. May throw; the log is then kept as it is.
  std::function<void(const std::filesystem::path& log)> finish = {};
  /// The responses as a function of a run's log and the study's options alone, equal to what the black box
  /// gave: with it, `rerun-responses` takes them anew from the logs that there are, after a response or an
  /// option of responses has changed. May return a doe::Failure, or throw.
  std::function<doe::Outcome(const std::filesystem::path& log, const OptionValues& options)> responses = {};
  /// The cycles of a run, from its log: with them the report says what other hauls would change.
  CycleFunction cycles = {};
};

/// What summary and report show beside the models.
struct Presentation {
  /// Figures of one run for the report, from its log: a JSON array of panels, whose kinds stand above.
  FigureFunction illustrate = {};
  /// Figures of one run for its replay, where these are more than for the report: of every cycle. A panel with
  /// "cycle": 3 is of that cycle, and the page shows one cycle at a time. Empty: those of `illustrate`.
  FigureFunction replay = {};
  /// Figures for the report that set runs against each other, from the logs of all runs that succeeded, which
  /// are named by their run, run_0012.h5: a JSON array of panels, shown two in a row.
  ContrastFunction contrast = {};
  /// Figures from the logs of all runs that succeeded, said first in summary and report.
  HeadlineFunction headlines = {};
  /// Points with names, such as those of a source; the one called "reference" is what the recommendation is
  /// compared with.
  std::vector<Mark> marks = {};
  /// What is claimed about the black box and whether its runs bear it out, said in summary and report.
  std::function<std::vector<Finding>(const StudyResults& results)> findings = {};
};

/// All that makes a study: name, problem and black box, and what more it has to say. Name: letters, digits, '_' and
/// '-'; it names the default output folder `results/<name>`.
struct Study {
  std::string name = {};
  doe::Problem problem = {};
  StudyFunction black_box = {};  ///< empty: runs are made elsewhere, by ask and tell
  std::string about = {};        ///< one or two sentences for the report's head
  Defaults defaults = {};
  std::vector<StudyOption> options = {};
  std::vector<Preset> presets = {};
  /// Why these values cannot go together, with what is allowed; empty: they can. Asked before a folder is made.
  std::function<std::string(const OptionValues& options)> options_complaint = {};
  /// Called once, before the first run, to fill the empty folder `shared`; may take long. Everything it
  /// writes is kept or nothing.
  std::function<void(const RunContext& context)> prepare = {};
  Simulator simulator = {};
  Logs logs = {};
  Presentation presentation = {};
};

/// The whole command line. Returns the exit code: 0 success, 1 failure, 2 wrong usage, 130 interrupted.
/// Prints; never throws. The process keeps memory that it frees (commands/freed_memory.h).
int run(int argc, char** argv, const Study& study);

}  // namespace drawpoint::studies
