// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Searches by name, as parameters of tests.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/pareto/search.hpp>
#include <functional>
#include <memory>
#include <ostream>
#include <string>

namespace drawpoint::pareto::test {

using Maker = std::function<std::unique_ptr<Search>(const doe::Problem&, const SearchOptions&)>;

struct Named {
  std::string name;
  Maker make;
};

inline void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

template <class SearchType, class Options>
Named named(const std::string& name, Options options) {
  return {name, [options](const doe::Problem& problem, const SearchOptions& search) mutable {
            options.search = search;
            return std::make_unique<SearchType>(problem, options);
          }};
}

}  // namespace drawpoint::pareto::test
