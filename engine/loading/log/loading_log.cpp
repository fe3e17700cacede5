// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/log_parts.h>
#include <drawpoint/engine/loading/log/log_stream.hpp>
#include <stdexcept>
#include <utility>

namespace drawpoint::engine::loading {
namespace {

// Version 5 added the descriptions of signals, the masses of bodies and the mass in the bucket; from version
// 6 on single numbers and texts are data, with units, where they were attributes; from version 7 on bodies
// have poses where they move, and not in every frame; version 8 added what of a cycle was left out,
// version 9 left out what rock lay before the pile.
const record::FileKind kind{"drawpoint loading log", 9, 4};

}  // namespace

std::string numbered(const std::string& group, std::size_t k) {
  std::string digits = std::to_string(k);
  return group + "/" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

void contradiction(const std::string& what) {
  throw std::invalid_argument("loading::write_log: " + what + "; make the log agree with itself");
}

void require_fit(const record::Reader& file, bool fits, const std::string& data,
                 const std::string& expected) {
  if (!fits)
    throw std::runtime_error("loading::read_log: " + file.path().string() + ": /" + data +
                             " does not fit the rest of the log; expected " + expected +
                             "; let the run be written anew");
}

void write_number(record::Writer& file, const std::string& path, double value, const LogNumber* meaning) {
  file.scalar(path, value);
  if (meaning) file.describe(path, meaning->unit, meaning->description);
}

double read_number(const record::Reader& file, const std::string& group, const std::string& name) {
  if (file.version() < 6) return file.number(group, name);
  const auto values = file.doubles(group + "/" + name).values;
  require_fit(file, values.size() == 1, group + "/" + name, "one number");
  return values.front();
}

namespace {

std::vector<std::string> names_in(const record::Reader& file, const std::string& group) {
  return file.version() < 6 ? file.attributes(group) : file.children(group);
}

std::string read_text(const record::Reader& file, const std::string& group, const std::string& name) {
  if (file.version() < 6) return file.text(group, name);
  const auto texts = file.texts(group + "/" + name);
  require_fit(file, texts.size() == 1, group + "/" + name, "one text");
  return texts.front();
}

}  // namespace

void write_part(const std::filesystem::path& path, const LoadingLog& log, bool goes_on) {
  record::Writer file(path, kind);
  file.integer("/", "completed", log.completed);
  file.integer("/", "goes_on", goes_on);
  file.text("/", "message", log.message);
  file.group("numbers");
  file.group("texts");
  file.group("cycles");
  for (const auto& [name, value] : log.numbers)
    write_number(file, "numbers/" + name, value, log_number(name));
  for (const auto& [name, value] : log.texts) file.scalar("texts/" + name, value);
  file.table("signals", log.signals);
  file.describe("signals/values", "signals/units", "a row per step, a column per name in signals/columns");
  for (std::size_t k = 0; k < log.cycles.size(); ++k) write_cycle(file, numbered("cycles", k), log.cycles[k]);
  write_scene(file, log.scene);
  file.commit();
}

void write_log(const std::filesystem::path& path, const LoadingLog& log) { write_part(path, log, false); }

namespace {

LoadingLog read_one(const record::Reader& file, LogContent content) {
  LoadingLog log;
  log.completed = file.integer("/", "completed") != 0;
  log.message = file.text("/", "message");
  for (const std::string& name : names_in(file, "numbers"))
    log.numbers[name] = read_number(file, "numbers", name);
  for (const std::string& name : names_in(file, "texts")) log.texts[name] = read_text(file, "texts", name);
  log.signals = file.table("signals");
  const std::size_t cycles = file.children("cycles").size();
  for (std::size_t k = 0; k < cycles; ++k) log.cycles.push_back(read_cycle(file, numbered("cycles", k)));
  log.scene = read_scene(file, content);
  return log;
}

// A part is of the run beside whose log it stands, and comes next.
void require_next(const LoadingLog& log, const LoadingLog& part, const std::filesystem::path& file) {
  const auto seed = [](const LoadingLog& of) {
    const auto found = of.texts.find("seed");
    return found == of.texts.end() ? std::string() : found->second;
  };
  const bool same = seed(log) == seed(part) && log.signals.columns.size() == part.signals.columns.size();
  const bool later =
      log.cycles.empty() || part.cycles.empty() || log.cycles.back().number < part.cycles.front().number;
  if (!same || !later)
    throw std::runtime_error("loading::read_log: " + file.string() +
                             " does not go on with the log that it stands beside; move it away");
}

}  // namespace

LoadingLog read_log(const std::filesystem::path& path, LogContent content) {
  const record::Reader first(path, kind);
  LoadingLog log = read_one(first, content);
  if (first.version() < 7 || first.integer("/", "goes_on") == 0) return log;
  for (int number = 2; std::filesystem::exists(part_path(path, number)); ++number) {
    LoadingLog next = read_one(record::Reader(part_path(path, number), kind), content);
    require_next(log, next, part_path(path, number));
    append(log, std::move(next));
  }
  return log;
}

}  // namespace drawpoint::engine::loading
