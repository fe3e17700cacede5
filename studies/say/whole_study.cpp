// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/say/export.h>
#include <drawpoint/studies/say/whole_study.h>
#include <drawpoint/engine/record/file.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <span>
#include <stdexcept>
#include <variant>

namespace drawpoint::studies {
namespace {

namespace record = engine::record;

const record::FileKind whole_study_kind{"drawpoint study", 1};

struct Dataset {
  std::string path, unit, description;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::string>, std::string> values;
};

/// The names of one group.
class Links {
 public:
  std::string free(std::string name) {
    std::replace(name.begin(), name.end(), '/', '_');
    while (name == "." || !taken_.insert(name).second) name += "_";
    return name;
  }

 private:
  std::set<std::string> taken_;
};

template <class T>
std::vector<T> column_of(const ExportTable& table, std::size_t k, const T& missing) {
  std::vector<T> values;
  for (const auto& row : table.rows) values.push_back(row[k].is_null() ? missing : row[k].get<T>());
  return values;
}

Dataset dataset_of(const ExportTable& table, std::size_t k, const std::string& path) {
  const ExportColumn& column = table.columns[k];
  Dataset data{path, column.unit, column.description, {}};
  if (column.type == ColumnType::text)
    data.values = column_of<std::string>(table, k, "");
  else if (column.type == ColumnType::whole)
    data.values = column_of<std::int32_t>(table, k, 0);
  else
    data.values = column_of<double>(table, k, std::numeric_limits<double>::quiet_NaN());
  return data;
}

void append(std::vector<Dataset>& contents, const std::string& group, const ExportTable& table) {
  Links links;
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    contents.push_back(dataset_of(table, k, group + "/" + links.free(table.columns[k].name)));
}

/// The front, or why there is none.
std::string append_front(std::vector<Dataset>& contents, const Identity& identity,
                         const std::vector<Run>& runs) {
  try {
    std::string missing;
    append(contents, "front", front_table(identity, runs, &missing));
    if (!missing.empty()) contents.push_back({"study/no_front", "", "why there is no front", missing});
    return missing;
  } catch (const std::runtime_error& e) {
    contents.push_back({"study/no_front", "", "why there is no front", std::string(e.what())});
    return e.what();
  }
}

void append_study(std::vector<Dataset>& contents, const Identity& identity) {
  contents.push_back({"study/name", "", "of the study", identity.study});
  contents.push_back({"study/seed", "", "of the study, 64 bits without sign", std::to_string(identity.seed)});
  contents.push_back({"study/simulator", "", "what made the runs", identity.simulator});
  contents.push_back(
      {"study/version", "", "of Drawpoint, which wrote this file", std::string(DRAWPOINT_VERSION)});
  Links options;
  for (const auto& [name, value] : identity.options)
    contents.push_back({"options/" + options.free(name), "", "option of the study", value});
  append(contents, "variables", variables_table(identity.problem));
  append(contents, "responses", responses_table(identity.problem));
  Links levels;
  for (const doe::Variable& variable : identity.problem.variables)
    if (!variable.levels.empty())
      contents.push_back({"levels/" + levels.free(variable.name), "", "of this variable", variable.levels});
}

struct WriteTo {
  record::Writer& file;
  const std::string& path;
  void operator()(const std::vector<double>& values) const { file.array(path, std::span(values)); }
  void operator()(const std::vector<std::int32_t>& values) const { file.array(path, std::span(values)); }
  void operator()(const std::vector<std::string>& values) const { file.texts(path, values); }
  void operator()(const std::string& value) const { file.scalar(path, value); }
};

/// Whether the file has these values, bit for bit.
struct IsIn {
  const record::Reader& file;
  const std::string& path;
  template <class T>
  static bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
  }
  bool operator()(const std::vector<double>& values) const { return same(file.doubles(path).values, values); }
  bool operator()(const std::vector<std::int32_t>& values) const {
    return same(file.integers(path).values, values);
  }
  bool operator()(const std::vector<std::string>& values) const { return file.texts(path) == values; }
  bool operator()(const std::string& value) const { return file.texts(path) == std::vector{value}; }
};

void verify(const std::filesystem::path& written, const std::filesystem::path& target,
            const std::vector<Dataset>& contents) {
  const record::Reader file(written, whole_study_kind, record::Form::plain);
  for (const Dataset& data : contents)
    if (!std::visit(IsIn{file, data.path}, data.values))
      throw std::runtime_error("studies: " + target.string() + ": what was written of " + data.path +
                               " reads back otherwise; the file is as it was; check the disk, or choose "
                               "another with --file");
}

}  // namespace

std::string write_whole_study(const std::filesystem::path& file, const Identity& identity,
                              const std::vector<Run>& runs) {
  std::vector<Dataset> contents;
  append_study(contents, identity);
  append(contents, "runs", runs_table(identity, runs));
  const std::string no_front = append_front(contents, identity, runs);
  record::Writer writer(file, whole_study_kind, record::Form::plain);
  for (const Dataset& data : contents) {
    std::visit(WriteTo{writer, data.path}, data.values);
    writer.describe(data.path, data.unit, data.description);
  }
  writer.commit([&](const std::filesystem::path& written) { verify(written, file, contents); });
  return no_front;
}

}  // namespace drawpoint::studies
