// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The folder in which job arrays and their caller meet: one folder per array, which is there from just before
/// its submission until all its ends have been dealt with. What the files are: task_files.hpp.

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/hash.hpp>
#include <drawpoint/doe/detail/task_files.hpp>

namespace drawpoint::doe::detail {

struct TaskPlace {
  std::string array;
  int index = 0;
  auto operator<=>(const TaskPlace&) const = default;
};

class TaskFolder {
 public:
  /// Made where it is not there.
  explicit TaskFolder(const std::filesystem::path& path) : path_(std::filesystem::absolute(path)) {
    std::filesystem::create_directories(path_);
  }

  /// Names of the arrays that have a folder and are known to be submitted.
  const std::set<std::string>& arrays() const { return arrays_; }

  /// Tasks that somebody else has left here, by their scripts; their arrays are known from now on. Folders of
  /// arrays that were not submitted are removed.
  std::map<std::string, TaskPlace> take_over() {
    std::map<std::string, TaskPlace> tasks;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      const std::string array = entry.path().filename();
      if (!array.starts_with(own_prefix) || !entry.is_directory()) continue;
      if (entry.path().extension() == unfinished) {
        std::filesystem::remove_all(entry.path());
        continue;
      }
      arrays_.insert(array);
      for (const auto& file : std::filesystem::directory_iterator(entry.path())) {
        const std::optional<int> number = task_number(file.path());
        if (file.path().extension() != ".sh" || !number) continue;
        const TaskPlace place{array, *number};
        const auto [found, is_new] = tasks.emplace(text_of(file.path()), place);
        if (!is_new && std::filesystem::exists(reply(place))) found->second = place;
      }
    }
    return tasks;
  }

  /// A new array with these scripts as its tasks 0, 1, ...; its name is unique among all that were ever here,
  /// and on the cluster. Throws std::runtime_error when the disk does not take it.
  std::string write(const std::vector<std::string>& scripts) {
    const std::string array = new_name();
    const std::filesystem::path draft = folder(array).string() + unfinished;
    std::filesystem::create_directories(draft);
    for (std::size_t k = 0; k < scripts.size(); ++k)
      put_text(draft / (std::to_string(k) + ".sh"), scripts[k]);
    put_text(draft / "task.sh", script_of_array(folder(array)));
    std::filesystem::rename(draft, folder(array));
    return array;
  }

  /// What Slurm runs for each task of the array.
  std::filesystem::path script_of_all(const std::string& array) const { return folder(array) / "task.sh"; }

  void add(const std::string& array) { arrays_.insert(array); }

  void remove(const std::string& array) {
    std::error_code ignored;
    std::filesystem::remove_all(folder(array), ignored);
    arrays_.erase(array);
  }

  /// The script first: without it nobody takes the reply over.
  void remove(const TaskPlace& place) const {
    remove_script(place);
    std::error_code ignored;
    std::filesystem::remove(reply(place), ignored);
  }

  /// So that nobody takes it for a task of theirs.
  void remove_script(const TaskPlace& place) const {
    std::error_code ignored;
    std::filesystem::remove(folder(place.array) / (std::to_string(place.index) + ".sh"), ignored);
  }

  /// Texts of the replies that are there, or on their way.
  std::map<TaskPlace, std::string> replies_of(const std::set<TaskPlace>& wanted) const {
    std::map<TaskPlace, std::string> texts;
    for (const std::string& array : arrays_) {
      for (const auto& file : std::filesystem::directory_iterator(folder(array))) {
        const std::optional<int> number = task_number(file.path());
        if (file.path().extension() != ".reply" || !number) continue;
        const TaskPlace place{array, *number};
        if (wanted.contains(place)) texts[place] = text_of(file.path());
      }
    }
    return texts;
  }

 private:
  static constexpr const char* own_prefix = "drawpoint-";
  static constexpr const char* unfinished = ".unfinished";

  std::filesystem::path folder(const std::string& array) const { return path_ / array; }
  std::filesystem::path reply(const TaskPlace& place) const {
    return folder(place.array) / (std::to_string(place.index) + ".reply");
  }

  std::string new_name() {
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    const std::string all = path_.string() + " " + std::to_string(getpid()) + " " + std::to_string(now);
    return own_prefix + checksum(all).substr(0, 8) + "-" + std::to_string(++serial_);
  }

  std::filesystem::path path_;
  std::set<std::string> arrays_;
  int serial_ = 0;
};

}  // namespace drawpoint::doe::detail
