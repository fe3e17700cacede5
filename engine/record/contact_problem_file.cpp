// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/record/contact_problem_check.h>
#include <bit>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <stdexcept>

namespace drawpoint::engine::record {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using engine::ContactPair;
using engine::ContactPoint;
using engine::ContactProblem;
using engine::SolverBody;
using engine::SpatialMap;
using engine::SuperBody;
using engine::SuperBodyRow;

const FileKind problem_kind{"drawpoint contact problem", 2, 1};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& fault) {
  throw std::runtime_error("record::read_contact_problem: " + path.string() + ": " + fault +
                           "; record the problem anew");
}

// One way through all fields, for writing and for reading, so that the two cannot part.
class FieldWriter {
 public:
  explicit FieldWriter(Writer& file) : file_(file) {}

  void units(const std::string& group, const std::string& text) { file_.text(group, "units", text); }

  template <class Item, class Get>
  void vectors(const std::string& path, std::vector<Item>& items, std::size_t width, Get get) {
    std::vector<double> values;
    values.reserve(items.size() * width);
    for (Item& item : items) {
      const auto& v = get(item);
      values.insert(values.end(), v.data(), v.data() + v.size());
    }
    file_.array(path, std::span<const double>(values), {items.size(), width});
  }
  template <class Item, class Get>
  void numbers(const std::string& path, std::vector<Item>& items, Get get) {
    std::vector<double> values;
    for (Item& item : items) values.push_back(get(item));
    file_.array(path, std::span<const double>(values));
  }
  template <class Item, class Get>
  void integers(const std::string& path, std::vector<Item>& items, Get get) {
    std::vector<std::int32_t> values;
    for (Item& item : items) values.push_back(std::bit_cast<std::int32_t>(get(item)));
    file_.array(path, std::span<const std::int32_t>(values));
  }

 private:
  Writer& file_;
};

class FieldReader {
 public:
  FieldReader(const Reader& file, const std::filesystem::path& path) : file_(file), path_(path) {}

  void units(const std::string&, const std::string&) {}

  template <class Item, class Get>
  void vectors(const std::string& path, std::vector<Item>& items, std::size_t width, Get get) {
    const Array<double> stored = file_.doubles(stored_path(path));
    if (stored.shape != std::vector<std::size_t>{items.size(), width})
      refuse(path_,
             "/" + path + " is not of " + std::to_string(items.size()) + " rows of " + std::to_string(width));
    for (std::size_t k = 0; k < items.size(); ++k)
      std::copy_n(stored.values.data() + k * width, width, get(items[k]).data());
  }
  template <class Item, class Get>
  void numbers(const std::string& path, std::vector<Item>& items, Get get) {
    const auto values = counted(file_.doubles(path).values, items.size(), path);
    for (std::size_t k = 0; k < items.size(); ++k) get(items[k]) = values[k];
  }
  template <class Item, class Get>
  void integers(const std::string& path, std::vector<Item>& items, Get get) {
    const auto values = counted(file_.integers(path).values, items.size(), path);
    using Integer = std::remove_reference_t<decltype(get(items[0]))>;
    for (std::size_t k = 0; k < items.size(); ++k) get(items[k]) = std::bit_cast<Integer>(values[k]);
  }

 private:
  // What version 1 names otherwise.
  std::string stored_path(const std::string& path) const {
    const bool renamed = file_.version() == 1 && path == "bodies/external_velocity_change";
    return renamed ? "bodies/push" : path;
  }

  template <class T>
  std::vector<T> counted(std::vector<T> values, std::size_t count, const std::string& path) const {
    if (values.size() != count)
      refuse(path_, "/" + path + " has " + std::to_string(values.size()) + " values for " +
                        std::to_string(count) + " rows");
    return values;
  }

  const Reader& file_;
  const std::filesystem::path& path_;
};

template <class Fields>
void bodies(Fields& f, std::vector<SolverBody>& items) {
  f.units("bodies",
          "velocity m/s; angular_velocity rad/s; external_velocity_change m/s; inverse_mass 1/kg; "
          "inverse_inertia 1/(kg m2)");
  f.vectors(
      "bodies/velocity", items, 3, [](auto& b) -> auto& { return b.velocity; });
  f.vectors(
      "bodies/angular_velocity", items, 3, [](auto& b) -> auto& { return b.angular_velocity; });
  f.vectors(
      "bodies/external_velocity_change", items, 3,
      [](auto& b) -> auto& { return b.external_velocity_change; });
  f.numbers(
      "bodies/inverse_mass", items, [](auto& b) -> auto& { return b.inverse_mass; });
  f.vectors(
      "bodies/inverse_inertia", items, 9, [](auto& b) -> auto& { return b.inverse_inertia; });
}

template <class Fields>
void pairs(Fields& f, std::vector<ContactPair>& items) {
  f.units("pairs", "rolling_arm m; spinning_arm m; start N m s");
  f.integers(
      "pairs/a", items, [](auto& p) -> auto& { return p.a; });
  f.integers(
      "pairs/b", items, [](auto& p) -> auto& { return p.b; });
  f.integers(
      "pairs/collider_a", items, [](auto& p) -> auto& { return p.collider_a; });
  f.integers(
      "pairs/collider_b", items, [](auto& p) -> auto& { return p.collider_b; });
  f.integers(
      "pairs/first", items, [](auto& p) -> auto& { return p.first; });
  f.integers(
      "pairs/count", items, [](auto& p) -> auto& { return p.count; });
  f.numbers(
      "pairs/rolling_arm", items, [](auto& p) -> auto& { return p.rolling_arm; });
  f.numbers(
      "pairs/spinning_arm", items, [](auto& p) -> auto& { return p.spinning_arm; });
  f.vectors(
      "pairs/start", items, 3, [](auto& p) -> auto& { return p.start; });
}

template <class Fields>
void points(Fields& f, std::vector<ContactPoint>& items) {
  f.units("points",
          "position m; arm_a m; arm_b m; normal 1; gap m; stiffness N/m; damping_time s; friction 1; "
          "restitution 1; start N s");
  f.integers(
      "points/feature", items, [](auto& p) -> auto& { return p.feature; });
  f.vectors(
      "points/position", items, 3, [](auto& p) -> auto& { return p.position; });
  f.vectors(
      "points/arm_a", items, 3, [](auto& p) -> auto& { return p.arm_a; });
  f.vectors(
      "points/arm_b", items, 3, [](auto& p) -> auto& { return p.arm_b; });
  f.vectors(
      "points/normal", items, 3, [](auto& p) -> auto& { return p.normal; });
  f.numbers(
      "points/gap", items, [](auto& p) -> auto& { return p.gap; });
  f.numbers(
      "points/stiffness", items, [](auto& p) -> auto& { return p.stiffness; });
  f.numbers(
      "points/damping_time", items, [](auto& p) -> auto& { return p.damping_time; });
  f.numbers(
      "points/friction", items, [](auto& p) -> auto& { return p.friction; });
  f.numbers(
      "points/restitution", items, [](auto& p) -> auto& { return p.restitution; });
  f.vectors(
      "points/start", items, 3, [](auto& p) -> auto& { return p.start; });
}

template <class Fields>
void machine_fields(Fields& f, SuperBody& machine) {
  const auto freedoms = static_cast<std::size_t>(machine.velocity.size());
  std::vector<Eigen::VectorXd*> velocities{&machine.velocity_before, &machine.velocity};
  f.units("machine",
          "velocities sqrt(kg) m/s, before the step and after outer forces; part_maps 6 x freedoms by "
          "columns (angular; linear); origins m");
  f.vectors(
      "machine/velocities", velocities, freedoms, [](auto* v) -> auto& { return *v; });
  f.vectors(
      "machine/part_maps", machine.part_maps, 6 * freedoms, [](auto& m) -> auto& { return m; });
  f.vectors(
      "machine/origins", machine.origins, 3, [](auto& o) -> auto& { return o; });
  f.units("machine/rows",
          "kind 0 motor, 1 stop; target m/s or rad/s; gap m or rad; recovery s; lower, upper, start N s or N "
          "m s");
  auto& rows = machine.rows;
  f.vectors(
      "machine/rows/jacobian", rows, freedoms, [](auto& r) -> auto& { return r.jacobian; });
  f.integers(
      "machine/rows/kind", rows, [](auto& r) -> auto& { return r.kind; });
  f.numbers(
      "machine/rows/target", rows, [](auto& r) -> auto& { return r.target; });
  f.numbers(
      "machine/rows/gap", rows, [](auto& r) -> auto& { return r.gap; });
  f.numbers(
      "machine/rows/recovery", rows, [](auto& r) -> auto& { return r.recovery; });
  f.numbers(
      "machine/rows/lower", rows, [](auto& r) -> auto& { return r.lower; });
  f.numbers(
      "machine/rows/upper", rows, [](auto& r) -> auto& { return r.upper; });
  f.numbers(
      "machine/rows/start", rows, [](auto& r) -> auto& { return r.start; });
}

// An empty machine of the sizes in the file, for machine_fields to fill.
SuperBody sized_machine(const Reader& file, const std::filesystem::path& path) {
  const auto shape = [&](const char* name) {
    const auto found = file.doubles(name).shape;
    if (found.size() != 2) refuse(path, "/" + std::string(name) + " is not a matrix");
    return found;
  };
  const auto freedoms = static_cast<Index>(shape("machine/velocities")[1]);
  SuperBody machine;
  machine.velocity_before = machine.velocity = Eigen::VectorXd::Zero(freedoms);
  const std::size_t parts = shape("machine/origins")[0], rows = shape("machine/rows/jacobian")[0];
  machine.part_maps.assign(parts, SpatialMap::Zero(6, freedoms));
  machine.origins.assign(parts, Vector3d::Zero());
  SuperBodyRow row;
  row.jacobian = Eigen::VectorXd::Zero(freedoms);
  machine.rows.assign(rows, row);
  return machine;
}

}  // namespace

void write_contact_problem(const std::filesystem::path& path, const ContactProblem& problem,
                           const std::string& note) {
  const std::string fault = detail::problem_fault(problem);
  if (!fault.empty())
    throw std::invalid_argument("record::write_contact_problem: " + fault +
                                "; give a problem as World::before_solve does");
  ContactProblem copy = problem;
  Writer file(path, problem_kind);
  file.text("/", "note", note);
  file.number("/", "step", problem.step);
  FieldWriter fields(file);
  bodies(fields, copy.bodies);
  pairs(fields, copy.pairs);
  points(fields, copy.points);
  if (problem.machine) {
    SuperBody machine = *problem.machine;
    machine_fields(fields, machine);
  }
  file.commit();
}

RecordedProblem read_contact_problem(const std::filesystem::path& path) {
  const Reader file(path, problem_kind);
  RecordedProblem read;
  read.note = file.text("/", "note");
  read.problem.step = file.number("/", "step");
  FieldReader fields(file, path);
  read.problem.bodies.resize(file.doubles("bodies/inverse_mass").values.size());
  read.problem.pairs.resize(file.integers("pairs/a").values.size());
  read.problem.points.resize(file.integers("points/feature").values.size());
  bodies(fields, read.problem.bodies);
  pairs(fields, read.problem.pairs);
  points(fields, read.problem.points);
  if (file.has("machine")) {
    auto machine = std::make_shared<SuperBody>(sized_machine(file, path));
    machine_fields(fields, *machine);
    read.machine = machine;
    read.problem.machine = read.machine.get();
  }
  const std::string fault = detail::problem_fault(read.problem);
  if (!fault.empty()) refuse(path, fault);
  return read;
}

}  // namespace drawpoint::engine::record
