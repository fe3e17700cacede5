// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/marks.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {

std::string to_text(const std::vector<Mark>& marks) {
  nlohmann::json all = nlohmann::json::array();
  for (const Mark& mark : marks)
    all.push_back({mark.name, std::vector<double>(mark.x.begin(), mark.x.end())});
  return all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<Mark> marks_from(const std::string& text) {
  std::vector<Mark> marks;
  for (const auto& entry : nlohmann::json::parse(text)) {
    const auto x = entry.at(1).get<std::vector<double>>();
    marks.push_back({entry.at(0).get<std::string>(),
                     Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()))});
  }
  return marks;
}

std::string mark_text(const Mark& mark) { return mark.name + "=" + typed_values(mark.x); }

std::vector<Mark>::iterator mark_named(std::vector<Mark>& marks, const std::string& name) {
  return std::find_if(marks.begin(), marks.end(), [&](const Mark& mark) { return mark.name == name; });
}

std::vector<Mark> with_marks(std::vector<Mark> marks, const std::vector<Mark>& more) {
  for (const Mark& mark : more) {
    const auto same = mark_named(marks, mark.name);
    if (same == marks.end())
      marks.push_back(mark);
    else
      *same = mark;
  }
  return marks;
}

}  // namespace drawpoint::studies
