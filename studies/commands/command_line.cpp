// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/freed_memory.h>
#include <drawpoint/studies/commands/options/did_you_mean.h>
#include <drawpoint/studies/commands/options/mark_options.h>
#include <drawpoint/studies/commands/options/problem_text.h>
#include <drawpoint/studies/commands/options/questions.h>
#include <drawpoint/studies/commands/options/run_options.h>
#include <drawpoint/studies/commands/reading_commands.h>
#include <drawpoint/studies/run/store/joined.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <drawpoint/studies/run/store/plain_text.h>
#include <drawpoint/studies/say/live/server.h>
#include <drawpoint/studies/say/versions.h>
#include <CLI/CLI.hpp>
#include <drawpoint/doe/problem.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <new>
#include <sstream>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

constexpr int failure = 1;
constexpr int wrong_usage = 2;
/// Those that are told; prepare is for `run` alone.
constexpr std::array<const char*, 21> commands = {
    "run",    "check",  "confirm",  "ask",   "tell",    "exclude",         "status",
    "live",   "fit",    "validate", "front", "predict", "recommend",       "compare",
    "report", "replay", "export",   "share", "open",    "rerun-responses", "evaluate"};

/// Behind the program and the study's leading words.
std::vector<std::string> typed_words(int argc, char** argv, const Study& study) {
  return {argv + std::min(argc, 1 + static_cast<int>(study.simulator.leading_words.size())), argv + argc};
}

/// `prog --runs 5` means `prog run --runs 5`.
std::vector<std::string> with_command(std::vector<std::string> words) {
  const std::string first = words.empty() ? "" : words.front();
  const bool help = first == "--help" || first == "-h" || first == "--help-all" || first == "--version";
  const bool named =
      first == "prepare" || std::find(commands.begin(), commands.end(), first) != commands.end();
  if (!first.empty() && first[0] != '-' && !named)
    throw UsageError("unknown command \"" + first + "\"" +
                     did_you_mean(first, {commands.begin(), commands.end()}) + "; the commands are " +
                     joined(commands));
  if (!help && !named) words.insert(words.begin(), "run");
  return words;
}

/// The first `count` words of the command line. `drawpoint NAME` is the first where that program started this
/// one.
std::string first_words(int count, char** argv) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    if (i > 0) text += ' ';
    text += i == 0 ? std::filesystem::path(argv[0]).filename().string() : argv[i];
  }
  return text;
}

/// What is typed before a command.
std::string program_of(int argc, char** argv, const Study& study) {
  return first_words(std::min(argc, 1 + static_cast<int>(study.simulator.leading_words.size())), argv);
}

/// Before the options that it sets: CLI11 takes them in this order, whatever was typed first.
void add_preset_option(CLI::App& command, const Study& study, OptionValues& values) {
  if (study.presets.empty()) return;
  std::string help;
  for (const Preset& preset : study.presets)
    help += (help.empty() ? "" : "; ") + preset.name + ": " + preset.help + " (" +
            options_text(preset.values) + ")";
  command
      .add_option_function<std::string>(
          "--preset", [&](const std::string& name) { values = preset_named(study.presets, name).values; },
          help)
      ->check([&](const std::string& name) { return preset_complaint(study.presets, name); })
      ->group("Options of " + study.name);
}

/// Those that the study declares; what is given goes to `values`.
void add_study_options(CLI::App& command, const Study& study, OptionValues& values, bool kept) {
  add_preset_option(command, study, values);
  for (const auto& option : study.options) {
    std::string help = option.help + ": " + allowed_values(option);
    help += " (default " + option.value + (kept ? ", or what the folder was made with)" : ")");
    command
        .add_option_function<std::string>(
            "--" + option.name,
            [&values, name = option.name](const std::string& text) { values[name] = text; }, help)
        ->check([option](const std::string& text) { return complaint(option, text); })
        ->group("Options of " + study.name);
  }
}

void add_point_options(CLI::App& command, PointSettings& settings) {
  command.add_option("--shared", settings.shared,
                     "folder common to all runs; filled first where it is not there yet");
  command
      .add_option("--result-descriptor", settings.result_descriptor,
                  "file descriptor that takes the outcome as JSON")
      ->group("")
      ->check(CLI::Range(3, 1'000'000));
}

/// Before what the study is about, at the end of a command's help.
void show_example(CLI::App& command, const CLI::App& app, const Study& study, const std::string& words) {
  command.footer("Example: " + app.get_name() + words + "\n\n" + problem_text(study.problem));
}

struct Parsed {
  Settings settings;
  PointSettings point;
  std::function<int()> action;
};

void define_commands_that_run(CLI::App& app, Parsed& parsed, const Study& study) {
  auto* run =
      app.add_subcommand("run", "make the runs that are missing, then the report (also without a command)");
  add_folder_options(*run, parsed.settings);
  add_run_options(*run, parsed.settings, study.defaults);
  add_execution_options(*run, parsed.settings);
  add_sampling_options(*run, parsed.settings, study.defaults);
  add_time_options(*run, parsed.settings);
  add_mark_option(*run, study.problem, parsed.settings);
  add_study_options(*run, study, parsed.settings.options, true);
  show_example(*run, app, study, " run --runs 40 --adaptive 24 --out results/adaptive");
  run->callback([&] { parsed.action = [&] { return run_command(study, parsed.settings); }; });
  auto* confirm = app.add_subcommand(
      "confirm",
      "simulate points of the predicted front until prediction and simulation agree, then the report");
  add_folder_options(*confirm, parsed.settings);
  add_execution_options(*confirm, parsed.settings);
  add_confirm_options(*confirm, parsed.settings.confirm, study.problem);
  add_mark_option(*confirm, study.problem, parsed.settings);
  show_example(*confirm, app, study, " confirm --points 6 --rounds 2");
  confirm->callback([&] { parsed.action = [&] { return confirm_command(study, parsed.settings); }; });
}

/// For those who make the runs themselves.
void define_asking_commands(CLI::App& app, Parsed& parsed, const Study& study) {
  Settings& settings = parsed.settings;
  auto* ask =
      app.add_subcommand("ask",
                         "give the runs that are to be made elsewhere, as a table; the same again until "
                         "tell has taken what came out");
  add_folder_option(*ask, settings);
  add_table_options(*ask, settings.exported);
  ask->add_option("--count", settings.ask.count, "runs at most (default: all that are planned)")
      ->check(CLI::Range(1, 1'000'000));
  auto* confirm = ask->add_flag(
      "--confirm", settings.ask.confirm,
      "where none is planned: points of the predicted front, as confirm chooses them, in place of "
      "an adaptive batch");
  ask->add_option("--points", settings.confirm.points, "with --confirm: points of the front")
      ->needs(confirm)
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  ask->add_flag("--retry-failed", settings.execution.retry_failed, "give the failed runs again");
  add_run_options(*ask, settings, study.defaults);
  add_sampling_options(*ask, settings, study.defaults);
  add_study_options(*ask, study, settings.options, true);
  show_example(*ask, app, study,
               " ask --file runs.csv; then add the responses as columns, and " + app.get_name() +
                   " tell --file runs.csv");
  ask->callback([&] { parsed.action = [&] { return ask_command(study, settings); }; });
  auto* tell = app.add_subcommand("tell", "take what came out of runs made elsewhere");
  add_folder_options(*tell, settings);
  tell->add_option("--file", settings.tell.table,
                   "table with the columns run and every response; status (done or failed), reason and "
                   "seconds if you like")
      ->required();
  auto* replace =
      tell->add_flag("--replace", settings.tell.replace,
                     "correct runs that have ended otherwise; what stood there is kept in the ledger");
  tell->add_option("--why", settings.tell.why, "with --replace: the reason, kept in the ledger")
      ->needs(replace);
  show_example(*tell, app, study, " tell --file runs.csv");
  tell->callback([&] { parsed.action = [&] { return tell_command(study, settings); }; });
}

void define_exclude(CLI::App& app, Parsed& parsed, const Study& study) {
  ExcludeSettings& settings = parsed.settings.exclude;
  auto* exclude = app.add_subcommand(
      "exclude", "leave a run out of models and report; without --run: list all corrections");
  add_folder_options(*exclude, parsed.settings);
  auto* run = exclude->add_option("--run", settings.run, "the run")->check(CLI::Range(1, 1'000'000'000));
  exclude->add_option("--why", settings.why, "the reason, kept in the ledger")->needs(run);
  exclude->add_flag("--undo", settings.undo, "take the run in again")->needs(run);
  show_example(*exclude, app, study, " exclude --run 7 --why \"the belt had stopped\"");
  exclude->callback([&] { parsed.action = [&] { return exclude_command(study, parsed.settings); }; });
}

void define_rerun_responses(CLI::App& app, Parsed& parsed, const Study& study) {
  auto* rerun = app.add_subcommand("rerun-responses",
                                   "take the responses anew from the logs of another folder's runs, after "
                                   "one has changed; nothing is simulated");
  rerun
      ->add_option("--from", parsed.settings.rerun.from,
                   "folder of the study whose runs are taken; stays as it is")
      ->required()
      ->check(folder_complaint);
  add_folder_options(*rerun, parsed.settings);
  add_study_options(*rerun, study, parsed.settings.options, true);
  show_example(*rerun, app, study,
               " rerun-responses --from results/" + study.name + " --out results/" + study.name + "_anew");
  rerun->callback([&] { parsed.action = [&] { return rerun_responses_command(study, parsed.settings); }; });
}

void define_point_commands(CLI::App& app, Parsed& parsed, const Study& study) {
  const int most_runs = 1'000'000'000;
  auto* evaluate = app.add_subcommand("evaluate", "make one run in this process and print its responses");
  auto* x =
      evaluate->add_option("--x", parsed.point.x, "the point: " + names_of(study.problem))->delimiter(',');
  auto* seed = evaluate->add_option("--seed", parsed.point.seed, "seed of this run")
                   ->check(seed_complaint)
                   ->capture_default_str();
  auto* run =
      evaluate
          ->add_option("--run", parsed.point.run,
                       "in place of --x: this run of the study in --out, its point, seed and options, and "
                       "whether it comes out as stored")
          ->check(CLI::Range(1, most_runs))
          ->excludes(x)
          ->excludes(seed);
  evaluate->add_option("--out", parsed.point.out, "with --run: folder of the study")
      ->needs(run)
      ->check(folder_complaint)
      ->capture_default_str();
  evaluate->add_option("--log", parsed.point.log, "file for the run log (default: not kept)");
  evaluate->add_flag("--json", parsed.point.json, "print one JSON object");
  add_point_options(*evaluate, parsed.point);
  add_study_options(*evaluate, study, parsed.point.options, false);
  show_example(*evaluate, app, study, " evaluate --run 7");
  evaluate->callback([&] { parsed.action = [&] { return evaluate_command(study, parsed.point); }; });
  auto* check = app.add_subcommand(
      "check", "make one run and show all of it: request, reply, what was printed; nothing is stored");
  check
      ->add_option("--x", parsed.point.x,
                   "the point: " + names_of(study.problem) + " (default: the middle of the box)")
      ->delimiter(',');
  check->add_option("--seed", parsed.point.seed, "seed of this run")
      ->check(seed_complaint)
      ->capture_default_str();
  add_study_options(*check, study, parsed.point.options, false);
  show_example(*check, app, study, " check");
  check->callback([&] { parsed.action = [&] { return check_command(study, parsed.point); }; });
  auto* prepare = app.add_subcommand("prepare", "fill the folder common to all runs")->group("");
  add_point_options(*prepare, parsed.point);
  add_study_options(*prepare, study, parsed.point.options, false);
  prepare->callback([&] { parsed.action = [&] { return prepare_command(study, parsed.point); }; });
}

/// Those of `run` that most people need.
std::string first_options(const CLI::App& app) {
  const CLI::App& run = *app.get_subcommand("run");
  const CLI::Formatter formatter;
  std::string text = "Options of run that matter first; " + app.get_name() + " run --help has all of them:\n";
  for (const char* name : {"--out", "--runs", "--validation", "--adaptive", "--target", "--hours", "--jobs",
                           "--time-limit", "--seed", "--import"}) {
    std::ostringstream line;
    CLI::detail::format_help(line, "  " + std::string(name), run.get_option(name)->get_description(), 20);
    text += line.str();
  }
  return text + "\n";
}

/// A suggestion in place of an option that the command does not know (did_you_mean.h); empty where there is none.
std::string meant_by(const CLI::App& app, const CLI::ParseError& error) {
  const std::string what = error.what();
  const std::size_t at = what.find("--");
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const bool unknown = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  if (!unknown || at == std::string::npos || chosen.empty()) return "";
  std::vector<std::string> known;
  for (const CLI::Option* option : chosen.front()->get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  return did_you_mean(what.substr(at, what.find_first_of(" =", at) - at), known);
}

int parse_and_act(int argc, char** argv, const Study& study) {
  Parsed parsed;
  parsed.settings.out = parsed.point.out = std::filesystem::path("results") / study.name;
  parsed.settings.command = first_words(argc, argv);
  parsed.settings.execution.leading_words = study.simulator.leading_words;
  parsed.settings.execution.finish_log = study.logs.finish;
  const std::string program = parsed.settings.program = program_of(argc, argv, study);
  CLI::App app(study.about.empty() ? "Drawpoint study " + study.name : study.about, program);
  app.set_help_flag("-h,--help", "show this text; behind a command, its options");
  app.set_help_all_flag("--help-all", "show all commands with their options");
  app.set_version_flag("--version", version_text(study) + "\ncpp-httplib " + http_version(),
                       "say what this program is made of");
  app.require_subcommand(1);
  define_commands_that_run(app, parsed, study);
  define_asking_commands(app, parsed, study);
  define_reading_commands(app, study, parsed.settings, parsed.action);
  define_exclude(app, parsed, study);
  define_rerun_responses(app, parsed, study);
  define_point_commands(app, parsed, study);
  app.footer(first_options(app) + problem_text(study.problem));
  const std::vector<std::string> typed = typed_words(argc, argv, study);
  if (answered(app, typed, first_words(std::min(argc, 1), argv), study)) return 0;
  auto words = with_command(typed);
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      std::ostringstream text;
      app.exit(e, text);
      return std::fputs(text.str().c_str(), stdout) < 0;
    }
    std::fprintf(stderr, "%s: %s%s; see %s --help\n", study.name.c_str(), e.what(), meant_by(app, e).c_str(),
                 program.c_str());
    return wrong_usage;
  }
  check_typed_marks(study, parsed.settings);
  return parsed.action();
}

/// The words that std::invalid_argument and std::runtime_error carry, after the program's name.
int complain(const Study& study, const char* what, int code) {
  constexpr std::size_t most = 20000;
  std::fprintf(stderr, "%s: %s\n", study.name.c_str(), plain_text(what, most).c_str());
  return code;
}

void check_line(const std::string& what, const std::string& text) {
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }))
    throw std::invalid_argument("studies::Study: " + what +
                                " holds a control character; use printable text on one line");
}

void check_lines(const doe::Problem& problem) {
  for (const doe::Variable& v : problem.variables) {
    check_line("the unit of \"" + v.name + "\"", v.unit);
    for (const std::string& level : v.levels) check_line("a level of \"" + v.name + "\"", level);
  }
  for (const doe::Response& r : problem.responses) check_line("the unit of \"" + r.name + "\"", r.unit);
}

void check_study(const Study& study) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (study.name.empty() || !std::all_of(study.name.begin(), study.name.end(), plain)) {
    throw std::invalid_argument("studies::Study: name \"" + study.name +
                                "\" cannot name a folder; use letters, digits, '_' and '-'");
  }
  doe::check(study.problem);
  check_lines(study.problem);
  check(study.options);
  check(study.presets, study.options);
  check_marks(study.problem, study.presentation.marks);
}

}  // namespace

int run(int argc, char** argv, const Study& study) {
  keep_freed_memory();
  try {
    check_study(study);
    const int code = parse_and_act(argc, argv, study);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return complain(study, "studies: cannot write to standard output; is the disk full?", failure);
  } catch (const UsageError& e) {
    return complain(study, e.what(), wrong_usage);
  } catch (const std::bad_alloc&) {
    return complain(study,
                    "studies: memory ran out; end other programs, give --jobs a smaller number, or take a "
                    "machine with more. What is stored stays",
                    failure);
  } catch (const std::out_of_range& e) {
    const std::string text =
        std::string("studies: a fault of this program: it reached beyond the end of a list (") + e.what() +
        "). What is stored stays; please report it with the command that was given";
    return complain(study, text.c_str(), failure);
  } catch (const std::exception& e) {
    return complain(study, e.what(), failure);
  }
}

}  // namespace drawpoint::studies
