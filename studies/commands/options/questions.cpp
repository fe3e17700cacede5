// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/option_tree.h>
#include <drawpoint/studies/commands/options/questions.h>

#include <algorithm>
#include <cstdio>

namespace drawpoint::studies {

bool answered(const CLI::App& app, const std::vector<std::string>& words, std::string program,
              const Study& study) {
  const std::string question = words.empty() ? "" : words.front();
  if (question == "about") {
    std::puts(app.get_description().c_str());
  } else if (question == "man-page") {
    std::replace(program.begin(), program.end(), ' ', '-');
    std::fputs(man_page(app, {program, app.get_name(), DRAWPOINT_VERSION}).c_str(), stdout);
  } else if (question == "complete") {
    const auto choices = [&](const std::string& name) {
      for (const auto& option : study.options)
        if (option.name == name) return option.choices;
      return std::vector<std::string>{};
    };
    for (const auto& word : completions(app, {words.begin() + 1, words.end()}, choices))
      std::puts(word.c_str());
  } else {
    return false;
  }
  return true;
}

}  // namespace drawpoint::studies
