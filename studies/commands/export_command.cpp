// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/options/output_file.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/say/export.h>
#include <drawpoint/studies/say/findings.h>
#include <drawpoint/studies/say/whole_study.h>
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

namespace {

/// Problem, runs and front in one file.
void export_study(const Identity& identity, const std::vector<Run>& runs, const ExportSettings& wanted) {
  if (wanted.file.empty())
    throw UsageError(
        "--format hdf5: such a file does not go to standard output; name one with --file, such as --file "
        "study.h5");
  if (!wanted.what.empty())
    throw UsageError("--what: an HDF5 file holds the runs and the front; leave it out");
  const std::string no_front = write_whole_study(wanted.file, identity, runs);
  std::fprintf(stderr, "the study with %zu runs in %s\n", runs.size(), wanted.file.c_str());
  if (!no_front.empty()) std::fprintf(stderr, "without a front: %s\n", no_front.c_str());
}

ExportTable table_of(const Study& study, const Store& store, const Folder& folder, const std::string& what) {
  if (what == "findings") return findings_table(study, store, folder);
  if (what == "front") return front_table(store.identity(), store.runs());
  return runs_table(store.identity(), store.runs());
}

}  // namespace

int export_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  if (settings.exported.what == "findings" && !study.presentation.findings)
    throw UsageError("--what findings: this study has none to hold its runs against; give runs or front");
  const Store store = open_store(study, folder);
  ExportSettings wanted = settings.exported;
  wanted.file = output_file(folder, wanted.file);
  if (wanted.format == "hdf5") {
    export_study(store.identity(), store.runs(), wanted);
    return 0;
  }
  write_table(study, table_of(study, store, folder, wanted.what), wanted);
  return 0;
}

}  // namespace drawpoint::studies
