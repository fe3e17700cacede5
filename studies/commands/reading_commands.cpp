// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/options/frame_options.h>
#include <drawpoint/studies/commands/options/mark_options.h>
#include <drawpoint/studies/commands/options/run_options.h>
#include <drawpoint/studies/commands/reading_commands.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/joined.h>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::studies {
namespace {

/// "Example: PROGRAM COMMAND", as it is typed here: through `drawpoint` too, and with a file of a program.
std::string example_of(const CLI::App& command) {
  return "Example: " + command.get_parent()->get_name() + " " + command.get_name();
}

constexpr int most_points = 1'000'000;
constexpr int most_run = 1'000'000'000;

void add_export_options(CLI::App& command, const Study& study, ExportSettings& settings) {
  command
      .add_option(
          "--what", settings.what,
          "every run, the front that the models predict, or the study's findings held against its runs")
      ->check(CLI::IsMember({"runs", "front", "findings"}))
      ->default_str("runs");
  add_table_options(command, settings, {"csv", "json", "hdf5"});
  command.footer("hdf5 is the whole study in one file: problem, runs and front.\n" + example_of(command) +
                 " --format hdf5 --file " + study.name + ".h5");
}

void add_front_options(CLI::App& command, FrontSettings& settings) {
  command
      .add_option("--limit", settings.limit,
                  "points shown, those that confirm would simulate first: the recommended one, the best of "
                  "each objective, the "
                  "balanced one, knees, then others far apart")
      ->check(CLI::Range(1, most_points))
      ->capture_default_str();
  command.add_flag("--all", settings.every_point, "show every point");
  command.footer(example_of(command) + " --limit 10");
}

void add_predict_options(CLI::App& command, Settings& settings, const doe::Problem& problem) {
  command.add_option("--x", settings.predict.x, "a point: " + names_of(problem) + "; repeatable")
      ->delimiter(',');
  command.add_option("--points", settings.predict.points,
                     "table of points, comma-separated, with a column per variable; others are left alone");
  add_table_options(command, settings.exported, {"csv", "json"});
  command.footer(
      "Of each response: what is expected, the interval that should hold 95 of 100 runs there, and the "
      "standard error "
      "of what is expected.\n" +
      example_of(command) + " --points grid.csv --file surface.csv");
}

void add_compare_options(CLI::App& command, Settings& settings) {
  command
      .add_option("--with", settings.compare.with,
                  "folder B of the same study; --out is A, and neither is changed")
      ->required()
      ->check(folder_complaint);
  command.footer(
      "Runs at equal points are paired. Give both studies the same --seed and --runs: then they have equal "
      "points and "
      "equal random numbers.\n" +
      example_of(command) + " --out results/one --with results/other");
}

void add_validate_options(CLI::App& command, Settings& settings) {
  command
      .add_option("--with", settings.compare.with,
                  "folder of the same study and options whose validation runs are taken in place of those of "
                  "--out, so that several studies are judged by the same runs; neither is changed")
      ->check(folder_complaint);
  command.footer(example_of(command) + " --out results/adaptive --with results/one_shot");
}

void add_replay_options(CLI::App& command, ReplaySettings& settings) {
  command.add_option("--run", settings.run, "number of the run")->required()->check(CLI::Range(1, most_run));
  command
      .add_option("--cycle", settings.cycle,
                  "of a run of several cycles, one alone (default: all on the page, the first as pictures)")
      ->check(CLI::Range(1, 1'000'000'000));
  command.add_option("--file", settings.file, "page to write (default: replay_0007.html in the folder)");
  add_frame_options(command, settings.frames);
  const std::string example = example_of(command) + " --run 7 ";
  command.footer(example + "--file run_7.html\n" + example +
                 "--cycle 2 --video run_7.mp4 --camera side --speed 2\n" + example +
                 "--frames pictures --from 4 --to 4 --size 1920x1080");
}

void add_share_options(CLI::App& command, Settings& settings) {
  command.add_option("--out,folder", settings.out, "folder of the study")
      ->check(folder_complaint)
      ->capture_default_str();
  command.add_option("--output", settings.share.file,
                     "file to write (default: the folder's name and .drawpoint, beside it)");
  command.add_flag("!--no-logs", settings.share.logs, "without the logs of runs, which are most of it");
  command.add_flag("--replace", settings.share.replace, "write over a file that is there already");
  command.footer("An SQLite archive, which sqlite3 -Ax unpacks too, unchecked.\n" + example_of(command) +
                 " results/ore --output ore.drawpoint");
}

void add_open_options(CLI::App& command, Settings& settings) {
  command.add_option("file", settings.share.file, "what the command share wrote")->required();
  command.add_option("--out,folder", settings.out, "folder to make; nothing is written over")
      ->check(folder_complaint)
      ->capture_default_str();
  command.footer(example_of(command) + " ore.drawpoint results/ore");
}

void add_recommend_options(CLI::App& command, Settings& settings, const doe::Problem& problem) {
  command
      .add_option("--against", settings.recommend.against,
                  "a point, as NAME=VALUE,..., to compare with, and to be no worse than where that can be "
                  "(default: the middle of the box)")
      ->check([](const std::string& text) { return text.empty() ? "give NAME=VALUE,... of a point" : ""; });
  add_mark_option(command, problem, settings);
  const auto at_lower = [](const doe::Variable& v) {
    return v.name + "=" + doe::detail::number_text(v.lower);
  };
  command.footer(example_of(command) + " --against " + joined(problem.variables, at_lower, ","));
}

void add_json_flag(CLI::App& command, Settings& settings) {
  command.add_flag("--json", settings.json,
                   "last line of standard output is one JSON object; everything else goes to standard error");
}

void add_live_options(CLI::App& command, LiveSettings& settings) {
  command.add_option("--port", settings.port, "port of 127.0.0.1 (default: one that is free)")
      ->check(CLI::Range(0, 65535));
  command.footer("From another machine: ssh -L 8080:127.0.0.1:8080 HOST, and the same port on both sides.\n" +
                 example_of(command) + " --port 8080");
}

using Command = int (*)(const Study&, const Settings&);

/// A command with a name, a line of help, and what it does.
class Reader {
 public:
  Reader(CLI::App& app, const Study& study, Settings& settings, std::function<int()>& action)
      : app_(app), study_(study), settings_(settings), action_(action) {}

  CLI::App& add(const std::string& name, const std::string& help, Command command) const {
    CLI::App& added = *app_.add_subcommand(name, help);
    added.callback([command, &study = study_, &settings = settings_, &action = action_] {
      action = [command, &study, &settings] {
        return command(as_begun(study, Folder{settings.out}), settings);
      };
    });
    return added;
  }
  /// The same, with --out and --json.
  CLI::App& add_with_json(const std::string& name, const std::string& help, Command command) const {
    CLI::App& added = add(name, help, command);
    add_folder_options(added, settings_);
    return added;
  }

 private:
  CLI::App& app_;
  const Study& study_;
  Settings& settings_;
  std::function<int()>& action_;
};

}  // namespace

std::string folder_complaint(const std::string& text) {
  return text.empty() ? "an empty name; give the folder of the study" : "";
}

void add_folder_option(CLI::App& command, Settings& settings) {
  command.add_option("--out", settings.out, "folder of the study")
      ->check(folder_complaint)
      ->capture_default_str();
}

void add_table_options(CLI::App& command, ExportSettings& settings, const std::vector<std::string>& formats) {
  command
      .add_option("--format", settings.format,
                  formats.size() > 2 ? "comma-separated values, one JSON object, or an HDF5 file"
                                     : "comma-separated values, or one JSON object")
      ->check(CLI::IsMember(formats))
      ->capture_default_str();
  command.add_option("--file", settings.file, "file to write (default: standard output)");
}

void add_folder_options(CLI::App& command, Settings& settings) {
  command.add_option("--out", settings.out, "folder of the study: store, run logs, report")
      ->check(folder_complaint)
      ->capture_default_str();
  add_json_flag(command, settings);
}

void define_reading_commands(CLI::App& app, const Study& study, Settings& settings,
                             std::function<int()>& action) {
  const Reader commands(app, study, settings, action);
  CLI::App& status = commands.add_with_json(
      "status", "say how many runs are planned, done and failed, and why", status_command);
  status.footer(example_of(status) + " --json");
  CLI::App& live = commands.add(
      "live", "serve a page that follows the study while it runs, on this machine alone, until Ctrl-C",
      live_command);
  add_folder_option(live, settings);
  add_live_options(live, settings.live);
  CLI::App& fit = commands.add_with_json(
      "fit", "say how each response is fitted, and how well runs are predicted without themselves",
      fit_command);
  fit.footer(example_of(fit) + " --out results/" + study.name);
  add_validate_options(
      commands.add_with_json("validate", "hold the models against the validation runs, one by one",
                             validate_command),
      settings);
  add_front_options(
      commands.add_with_json("front", "show the predicted front, and how far to trust it", front_command),
      settings.front);
  CLI::App& predict = commands.add("predict", "say what the models expect at points of your own, as a table",
                                   predict_command);
  add_folder_option(predict, settings);
  add_predict_options(predict, settings, study.problem);
  add_recommend_options(
      commands.add_with_json("recommend",
                             "say one strategy, what it gains and how sure that is, and how to simulate it",
                             recommend_command),
      settings, study.problem);
  add_compare_options(commands.add_with_json("compare",
                                             "say what another folder of this study, made with another "
                                             "choice, changes on average and on the front",
                                             compare_command),
                      settings);
  CLI::App& report =
      commands.add_with_json("report", "make the report again from the stored runs", report_command);
  add_mark_option(report, study.problem, settings);
  report.footer(example_of(report) + " --out results/" + study.name);
  CLI::App& replay = commands.add(
      "replay", "write one run as a page with its figures, or its scene as pictures and as a film",
      replay_command);
  add_folder_option(replay, settings);
  add_replay_options(replay, settings.replay);
  CLI::App& exported =
      commands.add("export", "write the runs or the front as a table for other programs", export_command);
  add_folder_option(exported, settings);
  add_export_options(exported, study, settings.exported);
  CLI::App& share =
      commands.add("share", "put store, report and logs into one file for another machine", share_command);
  add_share_options(share, settings);
  add_json_flag(share, settings);
  CLI::App& open =
      commands.add("open", "make a folder of such a file, every part of it checked", open_command);
  add_open_options(open, settings);
  add_json_flag(open, settings);
}

}  // namespace drawpoint::studies
