// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/record/contact_problem_check.h>
#include <drawpoint/engine/record/contact_problem_fields.h>
#include <bit>
#include <drawpoint/engine/base/hash.hpp>
#include <drawpoint/engine/record/contact_problem_file.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <stdexcept>
#include <type_traits>

namespace drawpoint::engine::record {
namespace {

using detail::Field;
using detail::Shape;
using Eigen::Index;
using engine::ContactProblem;
using engine::SuperBody;
using engine::SuperBodyRow;

const FileKind problem_kind{"drawpoint contact problem", 3, 1};

// What a reader needs to solve the problem, in the names of the arrays.
constexpr const char* law =
    "At a point with frame (n, t1, t2): u = velocity of b minus that of a, p = impulse on b, h = step / "
    "S in each of S substeps. 0 <= p_n, u_n - min(bias - Sigma p_n, 1 m/s) >= 0, one of them 0. |p_t| <= "
    "friction p_n; u_t = -s p_t with s >= 0, and s = 0 inside the cone. Y = 1 / (1 + 4 tau / h), tau = "
    "max(damping_time, 2 step), Sigma = 4 Y / (h^2 stiffness). With u_n- before the substep: bias = "
    "-gap / h if gap > 0; else Y (u_n- - 4 gap / h), without u_n- where it is below -0.05 m/s. Per pair, "
    "P = sum of its p_n, the moment m on b and the relative angular velocity: "
    "|m_t| <= rolling_arm P and |m_n| <= spinning_arm P, with friction's rule. Machine row: J w = "
    "target with lower <= p <= upper, complementary at the limits; stop: J w >= -gap / h, past the end "
    "-gap / recovery.";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& fault) {
  throw std::runtime_error("record::read_contact_problem: " + path.string() + ": " + fault +
                           "; record the problem anew");
}

std::string shape_text(const Shape& shape) {
  std::string text;
  for (const std::size_t extent : shape) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text;
}

// Item by item, row by row.
template <class Item, class Get>
std::vector<double> flat(std::vector<Item>& items, Get get) {
  std::vector<double> values;
  for (Item& item : items) {
    const auto& m = get(item);
    for (Index i = 0; i < m.rows(); ++i)
      for (Index j = 0; j < m.cols(); ++j) values.push_back(m(i, j));
  }
  return values;
}

Shape with_count(std::size_t items, const Shape& shape) {
  Shape all{items};
  all.insert(all.end(), shape.begin(), shape.end());
  return all;
}

class FieldWriter {
 public:
  explicit FieldWriter(Writer& file) : file_(file) {}

  template <class Item, class Get>
  void arrays(const Field& field, std::vector<Item>& items, const Shape& shape, Get get) {
    write(field, flat(items, get), with_count(items.size(), shape));
  }
  template <class Item, class Get>
  void reals(const Field& field, std::vector<Item>& items, Get get) {
    std::vector<double> values;
    for (Item& item : items) values.push_back(get(item));
    write(field, values, {items.size()});
  }
  template <class Item, class Get>
  void integers(const Field& field, std::vector<Item>& items, Get get) {
    std::vector<std::int32_t> values;
    for (Item& item : items) values.push_back(std::bit_cast<std::int32_t>(get(item)));
    write(field, values, {items.size()});
  }

 private:
  template <class T>
  void write(const Field& field, const std::vector<T>& values, const Shape& shape) {
    file_.array(field.path, std::span<const T>(values), shape);
    file_.describe(field.path, field.unit, field.description);
  }

  Writer& file_;
};

class FieldReader {
 public:
  FieldReader(const Reader& file, const std::filesystem::path& path) : file_(file), path_(path) {}

  template <class Item, class Get>
  void arrays(const Field& field, std::vector<Item>& items, Shape shape, Get get) {
    // Up to version 2 matrices are stored column by column, in one dimension.
    const bool by_columns = file_.version() < 3 && shape.size() == 2;
    if (by_columns) shape = {shape[0] * shape[1]};
    const Array<double> stored = file_.doubles(stored_path(field.path));
    require_shape(field, stored.shape, with_count(items.size(), shape));
    const double* value = stored.values.data();
    for (Item& item : items) {
      auto& m = get(item);
      for (Index k = 0; k < m.size(); ++k)
        (by_columns ? m(k % m.rows(), k / m.rows()) : m(k / m.cols(), k % m.cols())) = *value++;
    }
  }
  template <class Item, class Get>
  void reals(const Field& field, std::vector<Item>& items, Get get) {
    const Array<double> stored = file_.doubles(field.path);
    require_shape(field, stored.shape, {items.size()});
    for (std::size_t k = 0; k < items.size(); ++k) get(items[k]) = stored.values[k];
  }
  template <class Item, class Get>
  void integers(const Field& field, std::vector<Item>& items, Get get) {
    const Array<std::int32_t> stored = file_.integers(field.path);
    require_shape(field, stored.shape, {items.size()});
    using Integer = std::remove_reference_t<decltype(get(items[0]))>;
    for (std::size_t k = 0; k < items.size(); ++k) get(items[k]) = std::bit_cast<Integer>(stored.values[k]);
  }

 private:
  // What version 1 names otherwise.
  std::string stored_path(const std::string& path) const {
    const bool renamed = file_.version() == 1 && path == "bodies/external_velocity_change";
    return renamed ? "bodies/push" : path;
  }
  void require_shape(const Field& field, const Shape& found, const Shape& wanted) const {
    if (found != wanted)
      refuse(path_, std::string("/") + field.path + " is of shape " + shape_text(found) + ", not " +
                        shape_text(wanted));
  }

  const Reader& file_;
  const std::filesystem::path& path_;
};

class FieldHash {
 public:
  template <class Item, class Get>
  void arrays(const Field&, std::vector<Item>& items, const Shape& shape, Get get) {
    sum.add(static_cast<std::uint64_t>(shape.back()));
    for (const double value : flat(items, get)) sum.add(value);
  }
  template <class Item, class Get>
  void reals(const Field&, std::vector<Item>& items, Get get) {
    for (Item& item : items) sum.add(static_cast<double>(get(item)));
  }
  template <class Item, class Get>
  void integers(const Field&, std::vector<Item>& items, Get get) {
    sum.add(static_cast<std::uint64_t>(items.size()));
    for (Item& item : items) sum.add(std::uint64_t{std::bit_cast<std::uint32_t>(get(item))});
  }

  engine::StateHash sum;
};

// An empty machine of the sizes in the file, to be filled.
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
  machine.origins.assign(parts, Eigen::Vector3d::Zero());
  SuperBodyRow row;
  row.jacobian = Eigen::VectorXd::Zero(freedoms);
  machine.rows.assign(rows, row);
  return machine;
}

void write(const std::filesystem::path& path, const ContactProblem& problem, const std::string& note,
           Form form) {
  const std::string fault = detail::problem_fault(problem);
  if (!fault.empty())
    throw std::invalid_argument("record::write_contact_problem: " + fault +
                                "; give a problem as World::before_solve does");
  ContactProblem copy = problem;
  Writer file(path, problem_kind, form);
  file.text("/", "note", note);
  file.text("/", "law", law);
  file.number("/", "step", problem.step);
  FieldWriter fields(file);
  detail::visit_items(fields, copy);
  if (problem.machine) {
    SuperBody machine = *problem.machine;
    detail::visit_machine(fields, machine);
  }
  file.commit();
}

RecordedProblem read(const std::filesystem::path& path, Form form) {
  const Reader file(path, problem_kind, form);
  RecordedProblem read;
  read.note = file.text("/", "note");
  read.problem.step = file.number("/", "step");
  FieldReader fields(file, path);
  read.problem.bodies.resize(file.doubles("bodies/inverse_mass").values.size());
  read.problem.pairs.resize(file.integers("pairs/a").values.size());
  read.problem.points.resize(file.integers("points/feature").values.size());
  detail::visit_items(fields, read.problem);
  if (file.has("machine")) {
    auto machine = std::make_shared<SuperBody>(sized_machine(file, path));
    detail::visit_machine(fields, *machine);
    read.machine = machine;
    read.problem.machine = read.machine.get();
  }
  const std::string fault = detail::problem_fault(read.problem);
  if (!fault.empty()) refuse(path, fault);
  return read;
}

}  // namespace

void write_contact_problem(const std::filesystem::path& path, const ContactProblem& problem,
                           const std::string& note) {
  write(path, problem, note, Form::checked);
}

RecordedProblem read_contact_problem(const std::filesystem::path& path) { return read(path, Form::checked); }

void export_contact_problem(const std::filesystem::path& path, const ContactProblem& problem,
                            const std::string& note) {
  write(path, problem, note, Form::plain);
}

RecordedProblem import_contact_problem(const std::filesystem::path& path) { return read(path, Form::plain); }

std::uint64_t problem_hash(const ContactProblem& problem) {
  ContactProblem copy = problem;
  FieldHash fields;
  fields.sum.add(problem.step);
  detail::visit_items(fields, copy);
  if (problem.machine) {
    SuperBody machine = *problem.machine;
    detail::visit_machine(fields, machine);
  }
  return fields.sum.value();
}

}  // namespace drawpoint::engine::record
