// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/export.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/output_file.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/store/folder.h>
#include <drawpoint/doe/detail/atomic_file.hpp>

#include <cstdio>
#include <string>

namespace drawpoint::studies {

void write_table(const Study& study, const ExportTable& table, const ExportSettings& settings) {
  const std::string text = settings.format == "json" ? as_json(study.name, table) : as_csv(table);
  if (settings.file.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  doe::write_file(settings.file, text);
  std::fprintf(stderr, "%zu rows in %s\n", table.rows.size(), settings.file.c_str());
}

int export_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const Store store = open_store(study, folder);
  const ExportSettings& wanted = settings.exported;
  if (!wanted.file.empty()) check_output_file(folder, wanted.file);
  write_table(study,
              wanted.what == "front" ? front_table(store.identity(), store.runs())
                                     : runs_table(store.identity(), store.runs()),
              wanted);
  return 0;
}

}  // namespace drawpoint::studies
