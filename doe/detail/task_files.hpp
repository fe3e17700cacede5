// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The files by which a process and a task of a Slurm job array know of each other.
///
///     FOLDER/NAME/task.sh     what Slurm runs for every task of the array NAME
///     FOLDER/NAME/12.sh       the process that is task 12
///     FOLDER/NAME/12.reply    what it wrote to descriptor 3, then a line: exit code, start and end [s]

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include <drawpoint/doe/processes.hpp>

namespace drawpoint::doe::detail {

inline std::string quoted_for_shell(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

/// The script of one task. Equal processes have equal scripts.
inline std::string script_of(const Process& process) {
  std::string text = "# process " + std::to_string(process.id) + "\nexec ";
  if (process.time_limit > 0.0) {
    char limit[48];
    std::snprintf(limit, sizeof limit, "timeout -k 1 %.17g ", process.time_limit);
    text += limit;
  }
  text += quoted_for_shell(process.executable);
  for (const std::string& word : process.arguments) text += " " + quoted_for_shell(word);
  const std::string output = process.output.empty() ? "/dev/null" : process.output.string();
  return text + " >" + quoted_for_shell(output) + " 2>&1\n";
}

/// The script of the array. The reply appears complete or not at all. A task whose script was taken back before it
/// began has none.
inline std::string script_of_array(const std::filesystem::path& folder) {
  return "#!/bin/sh\n"
         "task=" +
         quoted_for_shell(folder.string()) +
         "/$SLURM_ARRAY_TASK_ID\n"
         "[ -e \"$task.sh\" ] || exit 0\n"
         "draft=$task.reply.$SLURM_JOB_ID\n"
         "export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1\n"
         "began=$(date +%s.%N)\n"
         "sh \"$task.sh\" </dev/null 3>\"$draft\"\n"
         "code=$?\n"
         "printf '\\n%s %s %s\\n' \"$code\" \"$began\" \"$(date +%s.%N)\" >>\"$draft\" && mv \"$draft\" "
         "\"$task.reply\"\n";
}

/// Reads a script or reply, which others write, too; one that is longer than a reply may be gives its last line.
inline std::string text_of(const std::filesystem::path& name) {
  constexpr std::size_t last_line = 256;
  StrangerFile file(name);
  if (!file.fault().empty()) return "";
  if (file.size() <= largest_reply + last_line) return file.text(0, largest_reply + last_line);
  const std::string tail = file.text(file.size() - last_line, last_line);
  const std::size_t line = tail.rfind('\n', tail.size() - 2);
  return line == tail.npos ? "" : tail.substr(line);
}

/// The number of a task by the name of its file; nothing for any other file.
inline std::optional<int> task_number(const std::filesystem::path& file) {
  const std::string stem = file.stem();
  int number = 0;
  const auto end = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (end.ec != std::errc() || end.ptr != stem.data() + stem.size() || number < 0) return std::nullopt;
  return number;
}

/// Throws std::runtime_error when the disk does not take it.
inline void put_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
    throw std::runtime_error("doe::SlurmJobs: cannot write " + file.string() +
                             "; check the folder and the free space");
}

/// How the task's process ended, by the text of its reply file; nothing if that is no such text.
inline std::optional<ProcessEnd> end_in(const std::string& text, const Process& process) {
  const std::size_t line = text.size() < 2 ? text.npos : text.rfind('\n', text.size() - 2);
  if (line == text.npos) return std::nullopt;
  int code = 0;
  double began = 0.0, ended = 0.0;
  if (std::sscanf(text.c_str() + line, "%d %lf %lf", &code, &began, &ended) != 3) return std::nullopt;
  ProcessEnd end{.id = process.id, .reply = text.substr(0, line), .time_limit = process.time_limit};
  end.seconds = ended - began;
  constexpr int ended_by_signal = 128, most_signals = 64;  // the shell adds the first to a signal's number
  const int signal = code - ended_by_signal;
  end.wait_status = signal > 0 && signal <= most_signals ? signal : code << 8;
  constexpr int limit_reached = 124;  // timeout(1); 137 where it had to kill
  end.timed_out = process.time_limit > 0.0 && end.seconds >= process.time_limit &&
                  (code == limit_reached || code == ended_by_signal + SIGKILL);
  return end;
}

}  // namespace drawpoint::doe::detail
