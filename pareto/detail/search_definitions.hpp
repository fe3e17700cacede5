// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The public face of a search (ask_and_tell.hpp) hands everything on to its process.

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <drawpoint/pareto/ask_and_tell.hpp>
#include <drawpoint/pareto/detail/compiled.hpp>
#include <drawpoint/pareto/detail/search_process.hpp>

namespace drawpoint::pareto {

DRAWPOINT_PARETO_INLINE Search::Search(std::unique_ptr<detail::SearchProcess> process)
    : process_(std::move(process)) {}
DRAWPOINT_PARETO_INLINE Search::Search(const Search& other) : process_(other.process_->copy()) {}
DRAWPOINT_PARETO_INLINE Search::Search(Search&& other) noexcept = default;
DRAWPOINT_PARETO_INLINE Search& Search::operator=(const Search& other) {
  process_ = other.process_->copy();
  return *this;
}
DRAWPOINT_PARETO_INLINE Search& Search::operator=(Search&& other) noexcept = default;
DRAWPOINT_PARETO_INLINE Search::~Search() = default;

DRAWPOINT_PARETO_INLINE const doe::Problem& Search::problem() const { return process_->problem(); }
DRAWPOINT_PARETO_INLINE const SearchOptions& Search::options() const { return process_->options(); }
DRAWPOINT_PARETO_INLINE bool Search::done() const { return process_->done(); }
DRAWPOINT_PARETO_INLINE Eigen::MatrixXd Search::ask() const { return process_->ask(); }
DRAWPOINT_PARETO_INLINE std::vector<doe::Seed> Search::seeds() const { return process_->seeds(); }
DRAWPOINT_PARETO_INLINE void Search::tell(std::vector<doe::Outcome> outcomes) {
  process_->tell(std::move(outcomes));
}
DRAWPOINT_PARETO_INLINE Front Search::front() const { return process_->front(); }
DRAWPOINT_PARETO_INLINE void Search::save(const std::filesystem::path& path) const { process_->save(path); }
DRAWPOINT_PARETO_INLINE void Search::restore(const std::filesystem::path& path) {
  std::unique_ptr<detail::SearchProcess> restored = process_->copy();
  restored->restore(path);
  process_ = std::move(restored);
}

}  // namespace drawpoint::pareto
