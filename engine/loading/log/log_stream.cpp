// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/log_stream.hpp>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace drawpoint::engine::loading {
namespace {

template <class T>
std::vector<T> from(const std::vector<T>& all, std::size_t first) {
  return {all.begin() + static_cast<std::ptrdiff_t>(first), all.end()};
}

template <class T>
void add(std::vector<T>& all, std::vector<T>&& more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// From the last one on, so that what is left is always the first so many.
void remove_parts(const std::filesystem::path& path) {
  int last = 1;
  while (std::filesystem::exists(part_path(path, last + 1))) ++last;
  for (; last > 1; --last) std::filesystem::remove(part_path(path, last));
}

}  // namespace

std::filesystem::path part_path(const std::filesystem::path& path, int number) {
  const std::string digits = std::to_string(number);
  std::filesystem::path part = path;
  part += ".part" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
  return part;
}

void append(LoadingLog& log, LoadingLog&& next) {
  const int frames = static_cast<int>(log.scene.frames.size());
  for (SceneKnot& knot : next.scene.knots) knot.frame += frames;
  add(log.signals.values, std::move(next.signals.values));
  add(log.cycles, std::move(next.cycles));
  add(log.scene.frames, std::move(next.scene.frames));
  add(log.scene.knots, std::move(next.scene.knots));
  log.scene.shapes = std::move(next.scene.shapes);
  log.scene.bodies = std::move(next.scene.bodies);
  log.numbers = std::move(next.numbers);
  log.texts = std::move(next.texts);
  log.completed = next.completed;
  log.message = std::move(next.message);
}

void join_parts(const std::filesystem::path& path) {
  if (!std::filesystem::exists(part_path(path, 2))) return;
  try {
    write_log(path, read_log(path));
  } catch (const std::runtime_error&) {  // what is there stays what it is
  }
  remove_parts(path);
}

LogStream::LogStream(std::filesystem::path path) : path_(std::move(path)) {
  if (!path_.empty()) join_parts(path_);
}

void LogStream::keep(const LoadingLog& log) {
  if (path_.empty()) return;
  LoadingLog news{
      .completed = log.completed, .message = log.message, .numbers = log.numbers, .texts = log.texts};
  news.signals = {log.signals.columns, from(log.signals.values, values_)};
  news.cycles = from(log.cycles, cycles_);
  news.scene = {log.scene.shapes, log.scene.bodies, from(log.scene.frames, frames_),
                from(log.scene.knots, knots_)};
  for (SceneKnot& knot : news.scene.knots) knot.frame -= static_cast<int>(frames_);
  ++parts_;
  write_part(parts_ == 1 ? path_ : part_path(path_, parts_), news, true);
  values_ = log.signals.values.size();
  cycles_ = log.cycles.size();
  frames_ = log.scene.frames.size();
  knots_ = log.scene.knots.size();
}

void LogStream::finish(const LoadingLog& log) {
  if (path_.empty()) return;
  write_part(path_, log, false);
  remove_parts(path_);
}

}  // namespace drawpoint::engine::loading
