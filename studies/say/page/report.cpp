// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/say/page/data.h>
#include <drawpoint/studies/say/page/page.h>
#include <drawpoint/studies/say/page/report.h>
#include <drawpoint/doe/detail/atomic_file.hpp>

namespace drawpoint::studies {

void write_report(const std::filesystem::path& path, const ReportInput& input) {
  doe::write_file(path, detail::page(input.study, detail::report_data(input)));
}

}  // namespace drawpoint::studies
