// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/tests/house/sources.hpp>
#include <optional>
#include <regex>
#include <string>
#include <vector>

/// Who may include whom, and the check of a source file against it.
///
/// A file belongs to the row with the longest folder that its path starts with. It may include the standard
/// library, the C library and POSIX, the project folders of its row, and the packages of its row; a package of
/// `in_cpp_only` never in a *.hpp, and its names do not appear in other rows at all, so that users of the
/// module never need it. A *.h is an internal header: it may use what a *.cpp of its room may, is not
/// installed, and no *.hpp includes it. Headers of no known package are refused: a new dependency starts as a
/// line here and as a decision note.
namespace drawpoint::house {

struct Row {
  std::string folder;
  std::vector<std::string> modules;      ///< folders of the project, itself included
  std::vector<std::string> packages;     ///< in any file
  std::vector<std::string> in_cpp_only;  ///< in *.cpp and internal headers
};

/// Rooms of the engine, or single headers of them.
inline std::vector<std::string> rooms(const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  for (const std::string& name : names)
    paths.push_back("engine/" + name + (name.ends_with(".hpp") ? "" : "/"));
  return paths;
}

/// The modules, what a study file says, and rooms of the studies.
inline std::vector<std::string> study_rooms(std::vector<std::string> modules,
                                            const std::vector<std::string>& names) {
  for (const char* face : {"study.hpp", "options.hpp", "headline.hpp", "finding.hpp", "external_program.hpp",
                           "mark.hpp", "cycle_work.hpp"})
    modules.push_back(std::string("studies/") + face);
  for (const std::string& name : names) modules.push_back("studies/" + name + "/");
  return modules;
}

inline const std::vector<Row>& dependency_table() {
  static const std::vector<Row> table{
      {"doe/", {"doe/"}, {"Eigen"}, {}},
      {"doe/problem_json.hpp", {"doe/"}, {"nlohmann-json"}, {}},  // no other header includes it
      {"kriging/", {"doe/", "kriging/"}, {"Eigen", "Ipopt"}, {}},
      // included by no other header of the module
      {"kriging/save.hpp", {"doe/", "kriging/"}, {"Eigen", "nlohmann-json"}, {}},
      {"kriging/save_fidelities.hpp", {"doe/", "kriging/"}, {"Eigen", "nlohmann-json"}, {}},
      {"kriging/save_nearest.hpp", {"doe/", "kriging/"}, {"Eigen", "nlohmann-json"}, {}},
      {"kriging/detail/saved_json.hpp", {"doe/", "kriging/"}, {"Eigen", "nlohmann-json"}, {}},
      {"kriging/detail/saved_parts.hpp", {"doe/", "kriging/"}, {"Eigen", "nlohmann-json"}, {}},
      {"pareto/", {"doe/", "pareto/"}, {"Eigen", "Ipopt"}, {}},
      {"python/", {"doe/", "kriging/", "pareto/", "python/"}, {}, {"Eigen", "pybind11"}},
      {"engine/base/", rooms({"base"}), {"Eigen"}, {}},
      {"engine/geometry/", rooms({"base", "geometry"}), {"Eigen"}, {"Highway", "Qhull"}},
      {"engine/collision/", rooms({"base", "geometry", "collision"}), {"Eigen"}, {"FCL"}},
      {"engine/solver/", rooms({"base", "solver"}), {"Eigen"}, {}},
      {"engine/solver/batch/", rooms({"base", "solver"}), {"Eigen"}, {"Highway"}},
      {"engine/world/", rooms({"base", "geometry", "collision", "solver", "world"}), {"Eigen"}, {}},
      {"engine/machine/",
       rooms({"base", "solver", "world/articulated_body.hpp", "machine"}),
       {"Eigen"},
       {"Simbody"}},
      {"engine/granular/",
       rooms({"base", "geometry", "collision", "solver", "world", "granular"}),
       {"Eigen"},
       {}},
      {"engine/record/",
       rooms({"base", "geometry", "collision", "solver", "world", "record"}),
       {"Eigen"},
       {"HDF5"}},
      {"engine/loading/", {"engine/"}, {"Eigen"}, {}},
      {"engine/loading/strategy/",
       {"engine/base/", "engine/geometry/", "engine/loading/strategy/"},
       {"Eigen"},
       {}},
      {"studies/", {"doe/", "kriging/", "pareto/", "engine/", "studies/"}, {"Eigen", "nlohmann-json"}, {}},
      // four rooms, run <- model <- say <- commands, and floors inside them
      {"studies/run/", study_rooms({"doe/"}, {"run"}), {"Eigen", "nlohmann-json"}, {}},
      {"studies/run/store/", study_rooms({"doe/"}, {"run/store"}), {"Eigen", "nlohmann-json"}, {"SQLiteCpp"}},
      {"studies/model/",
       study_rooms({"doe/", "kriging/", "pareto/"}, {"run", "model"}),
       {"Eigen", "nlohmann-json"},
       {}},
      {"studies/model/fits/",
       study_rooms({"doe/", "kriging/", "pareto/"}, {"run", "model/fits"}),
       {"Eigen", "nlohmann-json"},
       {}},
      {"studies/model/fronts/",
       study_rooms({"doe/", "kriging/", "pareto/"}, {"run", "model/fits", "model/fronts"}),
       {"Eigen", "nlohmann-json"},
       {}},
      {"studies/say/",
       study_rooms({"doe/", "kriging/", "pareto/"}, {"run", "model", "say"}),
       {"Eigen", "nlohmann-json"},
       {}},
      // the HDF5 files of engine/record, a library of its own
      {"studies/say/whole_study.cpp",
       study_rooms({"doe/", "engine/record/file.hpp"}, {"run/store", "say"}),
       {"nlohmann-json"},
       {}},
      {"studies/say/versions.cpp",
       study_rooms({"kriging/", "engine/record/hdf5_version.hpp"}, {"run/store", "say"}),
       {"Eigen"},
       {}},
      {"studies/say/page/",
       study_rooms({"doe/", "kriging/", "pareto/"}, {"model", "say/page"}),
       {"Eigen", "nlohmann-json"},
       {}},
      {"studies/say/live/server.cpp",
       study_rooms({}, {"run", "say/live", "say/loopback"}),
       {},
       {"cpp-httplib"}},
      {"studies/say/loopback/", study_rooms({}, {"say/loopback"}), {}, {"cpp-httplib"}},
      {"studies/say/frames/",
       study_rooms({"doe/"}, {"run", "say/page", "say/frames"}),
       {"nlohmann-json"},
       {}},
      {"studies/say/frames/frame_server.cpp",
       study_rooms({}, {"say/frames", "say/loopback"}),
       {},
       {"cpp-httplib"}},
      {"studies/commands/",
       study_rooms({"doe/"}, {"run", "model", "say", "commands"}),
       {"Eigen", "nlohmann-json"},
       {"CLI11"}},
      {"studies/loading/",
       study_rooms({"doe/", "kriging/", "pareto/", "engine/"}, {"loading"}),
       {"Eigen", "nlohmann-json"},
       {}},
      // JSON of strangers is read in one way, and a shared file holds the study.
      {"studies/from_file/",
       study_rooms({"doe/"}, {"run/program", "run/store", "from_file"}),
       {"nlohmann-json"},
       {}},
      {"studies/launcher/",
       {"studies/commands/options/did_you_mean.h", "studies/commands/options/option_tree.h"},
       {},
       {"CLI11"}}};
  return table;
}

/// The package that an included header belongs to; "standard" for the library and POSIX; nothing for an
/// unknown one.
inline std::optional<std::string> package_of(const std::string& header) {
  static const std::vector<std::pair<std::regex, std::string>> packages{
      {std::regex("(Eigen|unsupported/Eigen)/.*"), "Eigen"},
      {std::regex("(coin/)?IpStdCInterface\\.h"), "Ipopt's C interface"},
      {std::regex("coin(-or)?/.*|Ip[A-Z].*\\.hpp|IpoptConfig\\.h"), "Ipopt"},
      {std::regex("[Ss]imbody.*|SimTK.*"), "Simbody"},
      {std::regex("(fcl|ccd|octomap)/.*"), "FCL"},
      {std::regex("(oneapi/)?tbb/.*"), "oneTBB"},
      {std::regex("hwy/.*"), "Highway"},
      {std::regex("libqhull(_r|cpp)?/.*"), "Qhull"},
      {std::regex("hdf5.*|H5.*\\.h"), "HDF5"},
      {std::regex("SQLiteCpp/.*|sqlite3\\.h"), "SQLiteCpp"},
      {std::regex("httplib\\.h"), "cpp-httplib"},
      {std::regex("CLI/.*"), "CLI11"},
      {std::regex("nlohmann/.*"), "nlohmann-json"},
      {std::regex("pybind11/.*"), "pybind11"},
      {std::regex("[a-z_0-9]+"), "standard"},
      {std::regex("(unistd|fcntl|spawn|poll|signal|glob|immintrin|malloc)\\.h|sys/[a-z]+\\.h"), "standard"}};
  for (const auto& [pattern, name] : packages) {
    if (std::regex_match(header, pattern)) return name;
  }
  return std::nullopt;
}

inline bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

inline const Row* row_of(const std::string& path) {
  const Row* best = nullptr;
  for (const Row& row : dependency_table()) {
    if (path.starts_with(row.folder) && (!best || row.folder.size() > best->folder.size())) best = &row;
  }
  return best;
}

/// Whether no user of the row's module ever sees the file.
inline bool internal(const std::string& path) { return path.ends_with(".cpp") || path.ends_with(".h"); }

/// Whether the file may see the internal header: one of its own room, or both are in the rooms that make up
/// contact solving or in those of the studies, which share theirs in the direction of the table, or a study is one
/// of loading.
inline bool same_inside(const std::string& path, const std::string& header) {
  const auto room = [](const std::string& file) { return file.substr(0, file.rfind('/') + 1); };
  const auto contact = [](const std::string& file) {
    for (const char* name : {"base", "geometry", "collision", "solver", "world"})
      if (file.starts_with("engine/" + std::string(name) + "/")) return true;
    return false;
  };
  const auto study_room = [](const std::string& file) {
    return file.starts_with("studies/") && file.find('/', 8) != std::string::npos;
  };
  const bool loading_study = room(path) == "studies/" && header.starts_with("studies/loading/");
  return room(path) == room(header) || (contact(path) && contact(header)) || loading_study ||
         (study_room(path) && study_room(header));
}

/// Why `header` may not be included by the file `path` of `row`; empty when it may.
inline std::string objection(const Row& row, const std::string& path, const std::string& header) {
  static const std::string own = "drawpoint/";
  if (header.starts_with(own)) {
    const std::string target = header.substr(own.size());
    if (target.ends_with(".h") && !(internal(path) && same_inside(path, target)))
      return "an internal header; only *.cpp and *.h of its room include it";
    for (const std::string& module : row.modules) {
      if (target.starts_with(module)) return "";
    }
    return row.folder + " may not include it";
  }
  const std::optional<std::string> package = package_of(header);
  if (!package) return "no known package has it; name it in the dependency table";
  if (*package == "standard" || contains(row.packages, *package)) return "";
  if (!contains(row.in_cpp_only, *package)) return row.folder + " may not use " + *package;
  return internal(path) ? "" : *package + " may not be in a header";
}

/// Names of the engine's packages where their row does not allow them: a forward declaration leaks as an
/// include does.
inline std::vector<std::string> leaked_names(const Row& row, const Source& source) {
  static const std::vector<std::pair<std::regex, std::string>> names{
      {std::regex("\\bSimTK\\b"), "Simbody"},
      {std::regex("\\bfcl::"), "FCL"},
      {std::regex("\\btbb::"), "oneTBB"},
      {std::regex("\\bhwy::|\\bHWY_"), "Highway"},
      {std::regex("\\bhttplib::"), "cpp-httplib"}};
  const std::string code = std::regex_replace(source.text, std::regex("//[^\n]*"), "");
  std::vector<std::string> found;
  for (const auto& [pattern, package] : names) {
    const bool allowed = contains(row.in_cpp_only, package) && internal(source.path);
    if (!allowed && std::regex_search(code, pattern)) found.push_back(source.path + ": names " + package);
  }
  return found;
}

/// Every breach of the table by one file, as "path:line: <header>: reason". Files outside the table have
/// none.
inline std::vector<std::string> breaches(const Source& source) {
  static const std::regex include("\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  const Row* row = row_of(source.path);
  if (!row) return {};
  std::vector<std::string> found = leaked_names(*row, source);
  std::istringstream lines(source.text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (!std::regex_match(line, match, include)) continue;
    const std::string why =
        match[1] == "\"" ? "write it as <drawpoint/...>" : objection(*row, source.path, match[2]);
    if (why.empty()) continue;
    found.push_back(source.path + ":" + std::to_string(number) + ": <" + match[2].str() + ">: " + why);
  }
  return found;
}

}  // namespace drawpoint::house
