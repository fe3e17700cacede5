// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/contact_finder_options.hpp>

#include <stdexcept>
#include <string>

namespace drawpoint::engine {

std::string_view to_string(NarrowMethod method) {
  switch (method) {
    case NarrowMethod::fcl_libccd:
      return "fcl_libccd";
    case NarrowMethod::fcl_indep:
      return "fcl_indep";
    default:
      return "separating_axes";
  }
}

NarrowMethod narrow_method_named(std::string_view name) {
  for (const NarrowMethod method :
       {NarrowMethod::separating_axes, NarrowMethod::fcl_libccd, NarrowMethod::fcl_indep})
    if (name == to_string(method)) return method;
  throw std::invalid_argument("engine::narrow_method_named: no method \"" + std::string(name) +
                              "\"; known: separating_axes, fcl_libccd, fcl_indep");
}

}  // namespace drawpoint::engine
