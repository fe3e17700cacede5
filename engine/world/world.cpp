// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/world/world.hpp>

#include <drawpoint/engine/world/checks.h>
#include <drawpoint/engine/world/motion.h>
#include <drawpoint/engine/world/world_impl.h>
#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

World::Impl::Impl(const WorldOptions& o, const MaterialTable& materials)
    : options((detail::check(o), detail::check(materials), o)),
      pool(std::make_shared<const ThreadPool>(o.threads)),
      scene(options, materials, pool),
      contacts(options, scene, pool),
      solver(options.solver, pool) {}

const std::vector<Manifold>& World::Impl::find_contacts(StepReport& report) {
  const std::vector<Manifold>& manifolds = scene.find_contacts(contacts.problem().step);
  report.broad_s += scene.finder_times().broad;
  report.narrow_s += scene.finder_times().narrow;
  report.computed += scene.finder_times().computed;
  report.refused += scene.finder_times().refused;
  return manifolds;
}

SolverReport World::Impl::solve(const std::vector<Manifold>& manifolds, StepReport& report) {
  contacts.fill(manifolds);
  if (before_solve) before_solve(contacts.problem());
  const auto start = std::chrono::steady_clock::now();
  const SolverReport solved = solver.solve(contacts.problem());
  report.solver_s += seconds_since(start);
  ++report.solves;
  return solved;
}

// The solution as it is before anything has moved.
void World::Impl::check_solution(const SuperBodySolution& solved) const {
  const std::string when = "step " + std::to_string(steps + 1) + " at t = " + std::to_string(time) + " s";
  detail::check_solution({scene.present(), contacts.problem(), *pool}, when);
  if (scene.machine() && !(solved.velocity.allFinite() && solved.mean_velocity.allFinite()))
    detail::fail_solution(when, "the machine's speeds come out not finite");
}

StepReport World::Impl::step(double h) {
  const ThreadPool::Region region(*pool);
  const auto start = std::chrono::steady_clock::now();
  StepReport report;
  contacts.begin_step(h, last_step);
  scene.extra_reach().begin_step();
  contacts.problem().machine = scene.linearise(h);
  report.machine_s = scene.machine() ? seconds_since(start) : 0;
  SolverReport solved;
  do {
    solved = solve(find_contacts(report), report);
    check_solution(solved.machine);
  } while (scene.extra_reach().grow(scene.rocks(), {scene.present(), contacts.problem(), *pool}, h) ||
           scene.reach_of_parts_grows(solved.machine, h));
  if (scene.machine()) {
    const auto advance_start = std::chrono::steady_clock::now();
    scene.machine()->advance(scene.prescribed() ? contacts.felt_by_prescribed() : solved.machine);
    report.machine_s += seconds_since(advance_start);
  }
  contacts.keep_impulses();  // from here on nothing can fail
  report.max_overlap = contacts.deepest_overlap();
  detail::move_rocks(scene.rocks(), {scene.present(), contacts.problem(), *pool}, h);
  ++steps;
  time += h;
  last_step = h;
  report.manifolds = static_cast<int>(contacts.problem().pairs.size());
  report.points = static_cast<int>(contacts.problem().points.size());
  report.iterations = solved.iterations;
  report.last_change = solved.last_change;
  report.complementarity = solved.complementarity;
  report.cone = solved.cone;
  report.rest_s =
      seconds_since(start) - report.broad_s - report.narrow_s - report.machine_s - report.solver_s;
  return report;
}

World::World(const WorldOptions& options, const MaterialTable& materials)
    : impl_(std::make_unique<Impl>(options, materials)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

int World::add_rock(const RockBody& body, const Eigen::Isometry3d& pose, const Vector3d& velocity,
                    const Vector3d& angular_velocity) {
  return impl_->scene.add_rock(body, pose, velocity, angular_velocity);
}

void World::remove_rock(int rock) {
  impl_->scene.present_rock(rock, "remove_rock");
  impl_->scene.remove_rock(rock);
}

void World::set_rock_velocity(int rock, const Vector3d& velocity, const Vector3d& angular_velocity) {
  Rock& r = impl_->scene.present_rock(rock, "set_rock_velocity");
  detail::check_velocity("World::set_rock_velocity", velocity, angular_velocity);
  r.velocity = velocity;
  r.angular_velocity = angular_velocity;
}

int World::add_static(std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& pose, int material) {
  return impl_->scene.add_static(std::move(shape), pose, material);
}

void World::attach(ArticulatedBody* machine) { impl_->scene.attach(machine); }

void World::add_part_shape(int part, std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& X_PS,
                           int material) {
  impl_->scene.add_part_shape(part, std::move(shape), X_PS, material);
}

StepReport World::step() { return impl_->step(impl_->options.step); }

StepReport World::step(double h) {
  detail::check_step("World::step", h);
  return impl_->step(h);
}

const std::vector<Rock>& World::rocks() const { return impl_->scene.rocks(); }
const Rock& World::rock(int rock) const { return impl_->scene.rock(rock, "rock"); }
double World::time() const { return impl_->time; }
const ArticulatedBody* World::machine() const { return impl_->scene.machine(); }
const WorldOptions& World::options() const { return impl_->options; }
const ContactProblem& World::problem() const { return impl_->contacts.problem(); }
void World::set_solver(const SolverOptions& solver) {
  impl_->solver = ContactSolver(solver, impl_->pool);
  impl_->options.solver = solver;
}
void World::before_solve(Observer observer) { impl_->before_solve = std::move(observer); }

double World::kinetic_energy() const {
  double sum = 0;
  for (const Rock& rock : rocks()) {
    if (!rock.present) continue;
    const Vector3d w = rock.pose.linear().transpose() * rock.angular_velocity;
    sum +=
        0.5 * rock.body.mass * rock.velocity.squaredNorm() + 0.5 * w.dot(rock.body.inertia.cwiseProduct(w));
  }
  return sum;
}

double World::fastest_rock() const {
  double fastest = 0;
  for (const Rock& rock : rocks())
    if (rock.present) fastest = std::max(fastest, rock.velocity.norm());
  return fastest;
}

}  // namespace drawpoint::engine
