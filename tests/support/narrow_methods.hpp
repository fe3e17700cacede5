// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/collision/contact_finder_options.hpp>
#include <string>

/// Laws of the contact finder that hold whoever finds the axis of two polyhedra. A suite derives from ByNarrowMethod
/// and is instantiated with every_narrow_method and narrow_method_name.
namespace drawpoint::support {

class ByNarrowMethod : public testing::TestWithParam<engine::NarrowMethod> {
 protected:
  /// The defaults with the method, or the given ones.
  static engine::ContactFinderOptions options(engine::ContactFinderOptions given = {}) {
    given.narrow = GetParam();
    return given;
  }
  /// How much more than the least overlap an accepted axis may have [m].
  static double claim_error() {
    return GetParam() == engine::NarrowMethod::separating_axes ? 0 : engine::constants::claim_tolerance;
  }
};

inline const auto every_narrow_method = testing::Values(
    engine::NarrowMethod::separating_axes, engine::NarrowMethod::fcl_libccd, engine::NarrowMethod::fcl_indep);

inline std::string narrow_method_name(const testing::TestParamInfo<engine::NarrowMethod>& info) {
  return std::string(engine::to_string(info.param));
}

}  // namespace drawpoint::support
