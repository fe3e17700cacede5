// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Between fork and exec: how a child becomes another program, and how its parent learns that it could not.
///
/// The error travels in a page that both share until the program takes the child over: an exit code would look
/// like the program's own.

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>

#include <drawpoint/doe/detail/stranger_file.hpp>

namespace drawpoint::doe::detail {

inline constexpr int reply_channel = 3;

/// What was being done when a child could not go on, and errno.
struct StartTrouble {
  enum Step { none, input, output, reply, program };
  Step step = none;
  int error = 0;
};

struct UnmapTrouble {
  void operator()(StartTrouble* trouble) const { munmap(trouble, sizeof *trouble); }
};
using SharedTrouble = std::unique_ptr<StartTrouble, UnmapTrouble>;

/// In memory that children share. Nothing where the system has none.
inline SharedTrouble shared_trouble() {
  void* page = mmap(nullptr, sizeof(StartTrouble), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return SharedTrouble(page == MAP_FAILED ? nullptr : new (page) StartTrouble());
}

struct ChildFiles {
  const char* input;
  const char* output;  // "": where the parent prints
  bool errors_apart;
  int reply;
};

[[noreturn]] inline void give_up(StartTrouble* trouble, StartTrouble::Step step) {
  *trouble = {step, errno};
  _exit(127);
}

/// Without waiting for a reader, where a pipe lies there.
inline void print_to(const ChildFiles& files, StartTrouble* trouble) {
  if (files.output[0] == '\0') return;
  const int file = ::open(files.output, O_WRONLY | O_CREAT | O_TRUNC | O_NONBLOCK | O_NOCTTY, 0666);
  if (file < 0 || fcntl(file, F_SETFL, 0) != 0 || dup2(file, STDOUT_FILENO) < 0)
    give_up(trouble, StartTrouble::output);
  if (!files.errors_apart && dup2(file, STDERR_FILENO) < 0) give_up(trouble, StartTrouble::output);
}

/// Only calls that are safe after fork. 127 is the shell's code for a program that it cannot start.
[[noreturn]] inline void become(char** arguments, char** environment, const ChildFiles& files, pid_t parent,
                                StartTrouble* trouble) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // the parent died before the line above took effect
  setpgid(0, 0);
  const int input = ::open(files.input, O_RDONLY | O_NONBLOCK | O_NOCTTY);
  if (input < 0 || fcntl(input, F_SETFL, 0) != 0 || dup2(input, STDIN_FILENO) < 0)
    give_up(trouble, StartTrouble::input);
  print_to(files, trouble);
  if (files.reply == reply_channel) {
    fcntl(files.reply, F_SETFD, 0);
  } else if (dup2(files.reply, reply_channel) < 0) {
    give_up(trouble, StartTrouble::reply);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  execvpe(arguments[0], arguments, environment);
  give_up(trouble, StartTrouble::program);
}

/// The file that a name stands for, as in the PATH; empty where there is none.
inline std::filesystem::path program_file(const std::string& name) {
  std::error_code ignored;
  if (name.find('/') != std::string::npos)
    return std::filesystem::exists(name, ignored) ? std::filesystem::path(name) : std::filesystem::path();
  const char* variable = std::getenv("PATH");
  std::string folders = variable == nullptr ? "" : variable;
  for (std::size_t from = 0; from <= folders.size();) {
    const std::size_t to = std::min(folders.find(':', from), folders.size());
    const std::string folder = folders.substr(from, to - from);
    const std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / name;
    if (std::filesystem::exists(file, ignored)) return file;
    from = to + 1;
  }
  return {};
}

/// The first line of a script without its "#!"; empty for any other file.
inline std::string interpreter_line(const std::filesystem::path& program) {
  StrangerFile file(program, Links::follow);
  const std::string head = file.fault().empty() ? file.text(0, 256) : "";
  return head.starts_with("#!") ? head.substr(2, head.find('\n') - 2) : "";
}

/// What is wrong with the interpreter that a script names; empty: nothing, or it is no script.
inline std::string interpreter_complaint(const std::filesystem::path& program) {
  const std::string line = interpreter_line(program);
  if (line.ends_with('\r'))
    return "the line that names its interpreter ends in a carriage return, as Windows writes lines; end them "
           "with line feeds alone";
  const std::size_t from = line.find_first_not_of(" \t");
  if (from == std::string::npos) return "";
  const std::string interpreter = line.substr(from, line.find_first_of(" \t", from) - from);
  if (::access(interpreter.c_str(), X_OK) == 0) return "";
  return "its interpreter " + interpreter + " cannot be started: " + std::strerror(errno);
}

/// In the system's words, with what can be found out about the file.
inline std::string why_not_started(const std::string& program, const StartTrouble& trouble) {
  const std::string system = std::strerror(trouble.error);
  if (trouble.step == StartTrouble::output) return system + " (the file for what it prints)";
  if (trouble.step != StartTrouble::program) return system + " (its standard input or reply channel)";
  const std::filesystem::path file = program_file(program);
  if (file.empty())
    return system + (program.find('/') == std::string::npos ? " (it is not in the PATH)" : "");
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) return system + " (it is a directory)";
  if (trouble.error == EACCES && ::access(file.c_str(), X_OK) != 0)
    return system + " (it may not be run; allow it with chmod +x)";
  const std::string complaint = interpreter_complaint(file);
  return system + (complaint.empty() ? "" : " (" + complaint + ")");
}

}  // namespace drawpoint::doe::detail
