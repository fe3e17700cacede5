// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a program is made of: for --version and the report.

#include <drawpoint/studies/study.hpp>

#include <string>

namespace drawpoint::studies {

/// The commit that was built, twelve digits; "unknown" where it was built from an archive. Alone in the
/// source that CMake writes (cmake/DrawpointCommit.cmake).
const char* commit();

/// Version, commit and compiler in one line.
std::string program_version();

/// The same with the libraries, a line each.
std::string version_text(const Study& study);

}  // namespace drawpoint::studies
