// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/option_tree.h>

#include <algorithm>
#include <sstream>

namespace drawpoint::studies {
namespace {

std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> shown_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

/// Text that roff prints as it is.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    const bool line_begins = escaped.empty() || escaped.back() == '\n';
    if (line_begins && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\' || c == '-') escaped += '\\';
    escaped += c == '\\' ? 'e' : c;
  }
  return escaped;
}

void write_options(std::ostream& out, const CLI::App& app) {
  const CLI::Formatter formatter;
  std::string group = "Options";
  const bool is_command = app.get_parent() != nullptr;  // whose help is the app's
  for (const CLI::Option* option : shown_options(app)) {
    if (is_command && (option == app.get_help_ptr() || option == app.get_help_all_ptr())) continue;
    if (option->get_group() != group) out << ".PP\n" << roff(group = option->get_group()) << ":\n";
    out << ".TP\n\\fB" << roff(formatter.make_option_name(option, false)) << "\\fR"
        << roff(formatter.make_option_opts(option)) << "\n"
        << roff(option->get_description()) << "\n";
  }
}

/// Without the full stop that ends a sentence.
std::string phrase(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::vector<std::string> words_that_begin(const std::string& typed, std::vector<std::string> all) {
  std::erase_if(all, [&](const std::string& word) { return !word.starts_with(typed); });
  return all;
}

/// A lone "=" joins an option to its value, which is empty where nothing follows.
std::vector<std::string> without_equals_signs(std::vector<std::string> words) {
  if (!words.empty() && words.back() == "=") words.emplace_back();
  std::erase(words, "=");
  return words;
}

const CLI::App* command_among(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.size() < 2) return nullptr;
  for (const CLI::App* command : shown_commands(app))
    if (command->get_name() == words.front()) return command;
  return nullptr;
}

const CLI::App* command_of_none(const CLI::App& app) {
  for (const CLI::App* command : shown_commands(app))
    if (command->get_name() == "run") return command;
  return nullptr;
}

std::vector<std::string> long_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : shown_options(app))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The set that a check of CLI11's writes into the option's type: TEXT:{csv,json}.
std::vector<std::string> listed_values(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

std::vector<std::string> values_after(const CLI::App& command, const std::string& option,
                                      const OptionChoices& choices) {
  const CLI::Option* found = option.starts_with("--") ? command.get_option_no_throw(option) : nullptr;
  if (!found) return {};
  const std::vector<std::string> declared = choices(option.substr(2));
  return declared.empty() ? listed_values(*found) : declared;
}

}  // namespace

std::string man_page(const CLI::App& app, const ManPage& page) {
  std::ostringstream out;
  out << ".TH \"" << roff(page.title) << "\" 1 \"\" \"Drawpoint " << page.version << "\" \"User Commands\"\n"
      << ".SH NAME\n"
      << roff(page.title) << " \\- " << roff(phrase(app.get_description())) << "\n"
      << ".SH SYNOPSIS\n.B " << roff(page.synopsis) << "\n[\\fI" << page.command
      << "\\fR] [\\fIOPTION\\fR...]\n"
      << ".SH OPTIONS\n";
  write_options(out, app);
  out << ".SH " << page.commands << "\n";
  for (const CLI::App* command : shown_commands(app)) {
    out << ".SS " << roff(command->get_name()) << "\n" << roff(command->get_description()) << "\n";
    write_options(out, *command);
  }
  out << ".SH \"EXIT STATUS\"\n"
         "0: success; failed runs are data. 1: failure. 2: wrong usage. 130: interrupted.\n";
  if (!app.get_footer().empty()) out << ".SH NOTES\n.nf\n" << roff(app.get_footer()) << "\n.fi\n";
  return out.str();
}

std::vector<std::string> completions(const CLI::App& app, std::vector<std::string> words,
                                     const OptionChoices& choices) {
  words = without_equals_signs(std::move(words));
  const std::string typed = words.empty() ? "" : words.back();
  const CLI::App* named = command_among(app, words);
  const CLI::App* command = named ? named : command_of_none(app);
  if (typed.starts_with('-')) {
    std::vector<std::string> names = command ? long_names(*command) : std::vector<std::string>{};
    if (!named)
      for (const std::string& name : long_names(app)) names.push_back(name);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return words_that_begin(typed, names);
  }
  if (words.size() >= 2)
    return command ? words_that_begin(typed, values_after(*command, words[words.size() - 2], choices))
                   : std::vector<std::string>{};
  std::vector<std::string> names;
  for (const CLI::App* each : shown_commands(app)) names.push_back(each->get_name());
  return words_that_begin(typed, names);
}

}  // namespace drawpoint::studies
