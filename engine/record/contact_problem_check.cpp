// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/record/contact_problem_check.h>
#include <cmath>
#include <cstdint>
#include <drawpoint/engine/base/checks.hpp>

namespace drawpoint::engine::record::detail {
namespace {

using engine::ContactPair;
using engine::ContactPoint;
using engine::ContactProblem;
using engine::SolverBody;
using engine::SuperBody;
using engine::SuperBodyRow;
using engine::detail::text;

// Keeps the first fault of a row of a group.
class Finding {
 public:
  void at(const char* group, std::size_t row) { group_ = group, row_ = row; }
  void require(bool good, const char* field, const std::string& value, const char* allowed) {
    if (good || !fault_.empty()) return;
    fault_ =
        group_ + "/" + field + " of row " + std::to_string(row_) + " is " + value + "; allowed: " + allowed;
  }
  template <class Matrix>
  void finite(const Matrix& m, const char* field) {
    require(m.allFinite(), field, "not finite", "finite numbers");
  }
  void finite(double x, const char* field) { require(std::isfinite(x), field, text(x), "finite numbers"); }
  void not_negative(double x, const char* field) {
    require(x >= 0 && std::isfinite(x), field, text(x), "0 or more, finite");
  }
  void positive(double x, const char* field) {
    require(x > 0 && std::isfinite(x), field, text(x), "above 0, finite");
  }
  const std::string& fault() const { return fault_; }

 private:
  std::string group_, fault_;
  std::size_t row_ = 0;
};

void check_body(const SolverBody& body, Finding& find) {
  find.finite(body.velocity, "velocity");
  find.finite(body.angular_velocity, "angular_velocity");
  find.finite(body.external_velocity_change, "external_velocity_change");
  find.not_negative(body.inverse_mass, "inverse_mass");
  find.finite(body.inverse_inertia, "inverse_inertia");
}

void check_pair(const ContactPair& pair, const ContactProblem& problem, std::int64_t& covered,
                Finding& find) {
  const int bodies = static_cast<int>(problem.bodies.size()),
            parts = problem.machine ? static_cast<int>(problem.machine->part_maps.size()) : 0;
  const auto side = [&](int index, const char* field) {
    find.require(index < bodies && index >= -parts, field, std::to_string(index),
                 "a body's index, or -1 - p for part p of the machine");
  };
  side(pair.a, "a");
  side(pair.b, "b");
  find.require(pair.a != pair.b, "b", std::to_string(pair.b), "another side than a");
  find.require(pair.count > 0, "count", std::to_string(pair.count), "1 or more");
  find.require(pair.first == covered, "first", std::to_string(pair.first),
               "the end of the pair before, so that the pairs cover the points in order");
  covered = std::int64_t{pair.first} + pair.count;
  find.require(covered <= static_cast<std::int64_t>(problem.points.size()), "count",
               std::to_string(pair.count), "no more than there are points");
  find.not_negative(pair.rolling_arm, "rolling_arm");
  find.not_negative(pair.spinning_arm, "spinning_arm");
  find.finite(pair.start, "start");
}

void check_point(const ContactPoint& point, Finding& find) {
  find.finite(point.position, "position");
  find.finite(point.arm_a, "arm_a");
  find.finite(point.arm_b, "arm_b");
  find.require(engine::detail::is_unit(point.normal), "normal", "of length " + text(point.normal.norm()),
               "length 1");
  find.finite(point.gap, "gap");
  find.positive(point.stiffness, "stiffness");
  find.not_negative(point.damping_time, "damping_time");
  find.not_negative(point.friction, "friction");
  find.require(point.restitution >= 0 && point.restitution <= 1, "restitution", text(point.restitution),
               "0 to 1");
  find.finite(point.start, "start");
}

// The solver takes both from the first point of a pair.
void check_shared(const ContactPoint& point, const ContactPoint& first, Finding& find) {
  find.require(point.friction == first.friction, "friction", text(point.friction),
               "one per pair, as its first point");
  find.require(point.normal == first.normal, "normal", text(point.normal),
               "one per pair, as its first point");
}

void check_row(const SuperBodyRow& row, Eigen::Index freedoms, Finding& find) {
  find.require(row.jacobian.size() == freedoms && row.jacobian.allFinite(), "jacobian",
               "of another length or not finite", "one finite number a freedom");
  find.finite(row.target, "target");
  find.finite(row.gap, "gap");
  if (row.kind == SuperBodyRow::Kind::stop) find.positive(row.recovery, "recovery");
  find.require(row.lower <= row.upper, "lower", text(row.lower), "at most upper");
  find.finite(row.start, "start");
}

void check_machine(const SuperBody& machine, Finding& find) {
  const Eigen::Index freedoms = machine.velocity.size();
  find.at("machine", 0);
  find.finite(machine.velocity, "velocity");
  find.require(machine.velocity_before.size() == freedoms && machine.velocity_before.allFinite(),
               "velocity_before", "of another length or not finite", "finite, as long as velocity");
  find.require(machine.origins.size() == machine.part_maps.size(), "origins",
               "for " + std::to_string(machine.origins.size()) + " parts", "one per part");
  for (std::size_t k = 0; k < machine.part_maps.size(); ++k) {
    find.at("machine", k);
    find.require(machine.part_maps[k].cols() == freedoms && machine.part_maps[k].allFinite(), "part_maps",
                 "of another width or not finite", "6 finite rows of one number a freedom");
  }
  for (std::size_t k = 0; k < machine.rows.size(); ++k) {
    find.at("machine/rows", k);
    check_row(machine.rows[k], freedoms, find);
  }
}

}  // namespace

std::string problem_fault(const ContactProblem& problem) {
  Finding find;
  find.at("root", 0);
  find.positive(problem.step, "step");
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    find.at("bodies", k);
    check_body(problem.bodies[k], find);
  }
  std::int64_t covered = 0;
  for (std::size_t k = 0; k < problem.pairs.size() && find.fault().empty(); ++k) {
    find.at("pairs", k);
    check_pair(problem.pairs[k], problem, covered, find);
  }
  find.require(covered == static_cast<std::int64_t>(problem.points.size()), "count",
               std::to_string(covered) + " in all", "all points belong to a pair");
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    find.at("points", k);
    check_point(problem.points[k], find);
  }
  for (std::size_t q = 0; q < problem.pairs.size() && find.fault().empty(); ++q) {
    const int first = problem.pairs[q].first;
    for (int k = first; k < first + problem.pairs[q].count; ++k) {
      find.at("points", static_cast<std::size_t>(k));
      check_shared(problem.points[static_cast<std::size_t>(k)],
                   problem.points[static_cast<std::size_t>(first)], find);
    }
  }
  if (problem.machine) check_machine(*problem.machine, find);
  return find.fault();
}

}  // namespace drawpoint::engine::record::detail
