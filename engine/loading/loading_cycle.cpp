// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/load_booking.h>
#include <drawpoint/engine/loading/run_description.h>
#include <drawpoint/engine/loading/scene_recorder.h>
#include <drawpoint/engine/loading/signals.h>
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/log/log_stream.hpp>
#include <drawpoint/engine/loading/pile_shape.hpp>
#include <drawpoint/engine/loading/strategy/left_out.hpp>
#include <exception>
#include <iterator>

namespace drawpoint::engine::loading {
namespace {

constexpr double room_under_roof =
    0.3;  // over the heaped bucket: rocks stand out of it, tyres run over rocks [m]
constexpr int trouble_interval = 50;  // steps between checks of the whole state
constexpr int parts_of_broken_step = 10;
constexpr double most_escaped = 0.01;  // of the pile's mass; more than that is no stray rock
constexpr double weighing_time = 1.0;  // that the machine stands before its load is weighed [s]
constexpr double room_behind_A = 4.0;  // in which a rock in the way moves the start back [m]
constexpr double before_toe = 0.1;     // tip to toe where the approach is left out [m]
constexpr int clearance_interval = 5;  // steps between looks whether the bucket is clear
// Between cycles, where whole ones are not simulated: the pile stands, and single rocks that still roll down it come to
// rest in the second or more that the approach, which is left out, takes.
constexpr granular::RestOptions short_rest{.mean_energy = 2e-3, .fastest = 2.0, .hold = 0.1};
constexpr double blocked_raise = 1.0;   // it has let no rock go for so long: what is missing comes later [s]
constexpr int cycles_per_lost_one = 5;  // a run that loses more cycles than one in five has failed

class LoadingRun {
 public:
  LoadingRun(const Scenario& scenario, const SettledPile& pile, const SimulationHooks& hooks)
      : scenario_(scenario),
        hooks_(hooks),
        stream_(scenario.log_file),
        site_(scenario, pile),
        signals_(site_.lhd(), scenario.log_all_joints, log_.signals),
        scene_(site_, scenario, log_.scene) {
    site_.world().before_solve(hooks.before_solve);
    describe(scenario_, site_, log_);
    log_.texts["pile_provenance"] = pile.provenance.empty() ? "given by the caller" : pile.provenance;
  }

  LoadingLog run() {
    bool goes_on = true;
    for (int cycle = 1; goes_on && cycle <= scenario_.cycles; ++cycle) {
      goes_on = attempt(cycle);
      if (!goes_on || cycle == scenario_.cycles || ends_after(cycle)) break;
      keep(cycle);
      goes_on = replenish(cycle);
    }
    log_.completed = goes_on;
    sum_up();
    stream_.finish(log_);
    return std::move(log_);
  }

 private:
  bool ends_after(int cycle);
  bool attempt(int cycle);
  void keep(int cycle);
  void sum_up();
  bool run_cycle(CycleRecord& record);
  bool give_up(const CycleRecord& record, const std::string& message);
  bool replenish(int cycle);
  std::string time() const { return "t = " + std::to_string(site_.world().time()) + " s"; }
  void call(const std::function<void()>& hook);
  Plan plan(CycleRecord& record) const;
  Approached place_machine(const Plan& plan, CycleRecord& record);
  bool execute(CycleRecord& record, const Approached& approached);
  double carried_away(const Executor& executor) const;
  bool leaves_off(const Executor& executor);
  void leave_out_way_back(const Executor& executor, const MachineReading& reading, CycleRecord& record);
  bool weigh(CycleRecord& record);
  bool step(const std::function<void(const engine::StepReport&)>& record = {});
  engine::StepReport advance();
  bool look_for_trouble();
  bool refill();
  bool wait_for_rest();
  bool fail(const std::string& message) {
    log_.message = message;
    return false;
  }
  ColumnModel columns(bool with_bucket) const;
  PlannerOptions planner_options() const;
  void look_at_pile();

  Scenario scenario_;
  SimulationHooks hooks_;
  LogStream stream_;
  Site site_;
  LoadingLog log_;
  SignalRecorder signals_;            // into log_
  SceneRecorder scene_;               // into log_
  double cleared_ = 0, escaped_ = 0;  // mass [kg]
  long steps_ = 0, repeated_ = 0;
  int clear_looks_ = 0;          // one after another in which the bucket was clear
  int lost_ = 0, left_out_ = 0;  // cycles
  bool caller_failed_ = false;
  std::size_t most_points_ = 0;
  double largest_overlap_ = 0, largest_loop_error_ = 0;  // over the cycles [m]
};

void LoadingRun::sum_up() {
  log_.numbers["lost_cycles"] = lost_;
  log_.numbers["left_out_cycles"] = left_out_;
  log_.numbers["cleared_mass"] = cleared_;
  log_.numbers["escaped_mass"] = escaped_;
  log_.numbers["emitted_mass"] = site_.emitted_mass();
  log_.numbers["present_mass"] = site_.present_mass();
  log_.numbers["largest_overlap"] = largest_overlap_;
  log_.numbers["largest_loop_error"] = largest_loop_error_;
  log_.numbers["repeated_steps"] = static_cast<double>(repeated_);
  log_.numbers["most_contact_points"] = static_cast<double>(most_points_);
  log_.numbers["most_iterations_per_substep"] = engine::most_iterations(scenario_.world.solver, most_points_);
  scene_.complete();
}

// Whether the mean production is known as well as wanted.
bool LoadingRun::ends_after(int cycle) {
  if (scenario_.precision == 0 || std::ssize(log_.cycles) < least_cycles_to_end) return false;
  if (cycles_per_lost_one * lost_ > cycle || relative_production_error(log_) > scenario_.precision)
    return false;
  left_out_ = scenario_.cycles - cycle;
  return true;
}

// A run that is killed leaves the cycles that it had done.
void LoadingRun::keep(int cycle) {
  if (scenario_.log_file.empty()) return;
  sum_up();
  log_.message = "not finished: written after cycle " + std::to_string(cycle) + " of " +
                 std::to_string(scenario_.cycles);
  stream_.keep(log_);
  log_.message.clear();
}

ColumnModel LoadingRun::columns(bool with_bucket) const {
  return columns_of(site_.rocks(with_bucket), scenario_, site_.lhd());
}

PlannerOptions LoadingRun::planner_options() const {
  PlannerOptions options;
  options.bucket_volume = site_.lhd().bucket_volume;
  options.bucket_width = site_.lhd().bucket_width;
  options.standoff = scenario_.standoff;
  options.roof = scenario_.drift.height - room_under_roof;
  for (const Eigen::Vector2d& point : heaped_profile(site_.lhd()))
    options.outline.emplace_back(point.x() - site_.lhd().G.x(), point.y() - site_.lhd().G.z());
  options.tyre_reach = site_.lhd().tyre_radius;
  options.x_limit = scenario_.drift.length - scenario_.drift.wall_roughness;
  options.curl = scenario_.curl;
  options.lift = scenario_.lift;
  options.arm = site_.driver().arm();
  return options;
}

Plan LoadingRun::plan(CycleRecord& record) const {
  const ColumnModel model = columns(true);
  const PlannerOptions options = planner_options();
  const Plan plan = plan_trajectory(scenario_.strategy, model, options);
  record.columns_x = static_cast<int>(model.heights.rows());
  record.columns_y = static_cast<int>(model.heights.cols());
  record.column_heights.assign(model.heights.data(), model.heights.data() + model.heights.size());
  if (!plan.feasible) return plan;
  record.contour_z = contour(model, model.rows[plan.row]);
  for (std::size_t i = 0; i < record.contour_z.size(); ++i)
    record.contour_x.push_back(model.grid.x(static_cast<double>(i)));
  for (const TipPose& tip : planned_path(plan, options.arm)) {
    record.planned_x.push_back(tip.x);
    record.planned_z.push_back(tip.z);
  }
  return plan;
}

// A step that breaks down, which leaves the world as it was, is done again in parts.
engine::StepReport LoadingRun::advance() {
  engine::World& world = site_.world();
  try {
    return world.step();
  } catch (const engine::SolutionBroken&) {
    ++repeated_;
  }
  engine::StepReport report;
  for (int part = 0; part < parts_of_broken_step; ++part)
    report = world.step(world.options().step / parts_of_broken_step);
  return report;
}

bool LoadingRun::look_for_trouble() {
  escaped_ += site_.remove_escaped();
  if (escaped_ > most_escaped * site_.initial_mass())
    return fail(std::to_string(escaped_) +
                " kg of rock left the drift by t = " + std::to_string(site_.world().time()) +
                " s: the contact solution broke down; use a smaller step or more iterations");
  const std::string trouble = site_.trouble();
  return trouble.empty() || fail(trouble);
}

// What the caller throws ends the run, and not a cycle alone.
void LoadingRun::call(const std::function<void()>& hook) {
  caller_failed_ = true;
  hook();
  caller_failed_ = false;
}

// One step of the world; `record` sees its report before the state is checked.
bool LoadingRun::step(const std::function<void(const engine::StepReport&)>& record) {
  const engine::StepReport report = advance();
  if (hooks_.on_step) call([&] { hooks_.on_step(report); });
  most_points_ = std::max(most_points_, static_cast<std::size_t>(report.points));
  if (record) record(report);
  return ++steps_ % trouble_interval != 0 || look_for_trouble();
}

bool LoadingRun::refill() {
  const double blocked = scenario_.whole_cycle ? granular::blocked_after : blocked_raise;
  double last_birth = site_.world().time();
  while (site_.missing_mass() > 0 && site_.world().time() - last_birth < blocked) {
    if (site_.refill()) last_birth = site_.world().time();
    if (!step()) return false;
  }
  return true;
}

bool LoadingRun::wait_for_rest() {
  granular::RestWatch watch(scenario_.whole_cycle ? scenario_.pile.rest : short_rest);
  do {
    if (!step()) return false;
  } while (!watch.at_rest(site_.world()));
  return true;
}

// At A, or at the toe with the speed that the machine has there.
Approached LoadingRun::place_machine(const Plan& plan, CycleRecord& record) {
  const double A = plan.corners[0].x, toe = plan.toe - before_toe, farthest_back = A - room_behind_A;
  const double x = site_.free_tip_x(scenario_.whole_cycle ? A : std::max(A, toe), plan.y, farthest_back);
  const double distance = scenario_.whole_cycle ? 0 : std::max(x - A, 0.0);
  const LeftOut way = approach(distance, scenario_.executor.speeds);
  const std::vector<int> rocks = site_.place_machine(x, plan.y, way.speed);
  record.left_out_time += way.time;
  record.left_out_energy += 0.5 * site_.driver().moving_mass() * way.speed * way.speed;
  cleared_ += site_.mass_of(rocks);
  return {distance, way.speed};
}

// Whether the rest of the way back is not simulated: in two looks in a row the bucket was clear.
bool LoadingRun::leaves_off(const Executor& executor) {
  if (scenario_.whole_cycle || executor.stage() != Stage::back_out) return false;
  if (steps_ % clearance_interval != 0) return false;
  clear_looks_ = site_.bucket_is_clear() ? clear_looks_ + 1 : 0;
  return clear_looks_ >= 2;
}

void LoadingRun::leave_out_way_back(const Executor& executor, const MachineReading& reading,
                                    CycleRecord& record) {
  const double whole = -executor.goal().x, done = executor.progress() * whole,
               speed = std::max(-reading.actual.drive, 0.0);
  if (!(whole > 0)) return;
  const LeftOut way = way_back(whole, done, speed, executor.stage_time(), scenario_.executor);
  const double mass = site_.driver().moving_mass() + site_.mass_in_bucket();
  record.left_out_time += way.time;
  record.left_out_energy += 0.5 * mass * (way.speed * way.speed - speed * speed);
}

// What the bucket holds comes down the raise as soon as the machine backs out.
double LoadingRun::carried_away(const Executor& executor) const {
  return !scenario_.whole_cycle && executor.stage() == Stage::back_out ? site_.mass_in_bucket() : 0;
}

bool LoadingRun::execute(CycleRecord& record, const Approached& approached) {
  Executor executor(record.plan, site_.driver().arm(), scenario_.executor, approached);
  double next_frame = site_.world().time();
  clear_looks_ = 0;
  while (!executor.finished()) {
    const MachineReading reading = site_.driver().read();
    const Observation now{site_.world().time(), reading.tip, reading.actual};
    const ActuatorRates set = executor.step(now);
    if (site_.world().time() >= next_frame) {
      scene_.frame(site_, record.number, std::string(name(executor.stage())));
      next_frame += scenario_.frame_interval;
    }
    if (leaves_off(executor)) {
      leave_out_way_back(executor, reading, record);
      executor.end_backing_out(now);
    }
    if (executor.finished()) break;
    site_.driver().command(set, executor.drive_share());
    const auto log_signals = [&](const engine::StepReport& report) {
      signals_.append(site_, record.number, executor, set, report);
      largest_overlap_ = std::max(largest_overlap_, report.max_overlap);
      largest_loop_error_ = std::max(largest_loop_error_, site_.machine().loop_error());
    };
    site_.refill(carried_away(executor));
    if (hooks_.look_ahead) call([&] { hooks_.look_ahead(site_.world()); });
    if (!step(log_signals)) return false;
  }
  site_.driver().command({});
  record.stages = executor.results();
  return true;
}

// As it lies before the machine comes.
void LoadingRun::look_at_pile() {
  const ColumnModel model = columns(true);
  if (model.rows.empty()) return;
  const SurfaceAngles surface = surface_angles(model);
  log_.numbers["pile_angle_deg"] = surface.mean * 180 / M_PI;
  log_.numbers["pile_crest"] = surface.crest;
}

// Once it stands, so that what falls off it, or hopped in it, lies still; or as it was when its bucket was clear.
bool LoadingRun::weigh(CycleRecord& record) {
  for (double t = 0; scenario_.whole_cycle && t < weighing_time; t += site_.world().options().step)
    if (!step()) return false;
  scene_.frame(site_, record.number, "end of cycle");
  cleared_ += book_load(site_, columns(false), record);
  return true;
}

// Whether the run goes on. A diverged state makes the parts below refuse their input.
bool LoadingRun::attempt(int cycle) {
  CycleRecord record;
  record.number = cycle;
  try {
    return run_cycle(record);
  } catch (const std::exception& error) {
    return give_up(record,
                   "cycle " + std::to_string(cycle) + " broke down at " + time() + ": " + error.what());
  }
}

// The cycle is lost, not the run: the machine is put back, and what it carried is taken away.
bool LoadingRun::give_up(const CycleRecord& record, const std::string& message) {
  ++lost_;
  log_.texts["lost_cycle_" + std::to_string(record.number)] = message;
  if (caller_failed_ || !record.plan.feasible || cycles_per_lost_one * lost_ > scenario_.cycles)
    return fail(message);
  try {
    const Site::Load load = site_.load(rocks_in_front(site_, columns(false)));
    cleared_ += site_.remove(load.in_bucket) + site_.remove(load.elsewhere);
    CycleRecord lost;
    place_machine(record.plan, lost);
    return true;
  } catch (const std::exception& error) {
    return fail(message + "; the machine could not be put back: " + error.what());
  }
}

// Rock comes down the raise until the drift holds its first mass again, and comes to rest.
bool LoadingRun::replenish(int cycle) {
  try {
    return refill() && wait_for_rest();
  } catch (const std::exception& error) {
    return fail("after cycle " + std::to_string(cycle) + " the pile broke down at " + time() + ": " +
                error.what());
  }
}

bool LoadingRun::run_cycle(CycleRecord& record) {
  if (record.number == 1) look_at_pile();
  record.plan = plan(record);
  if (!record.plan.feasible)
    return fail("cycle " + std::to_string(record.number) + ": " + record.plan.message);
  const Approached approached = place_machine(record.plan, record);
  record.t_start = site_.world().time();
  if (!execute(record, approached)) return false;
  record.t_end = site_.world().time();
  if (!weigh(record)) return false;
  log_.cycles.push_back(record);
  if (hooks_.on_cycle) call([&] { hooks_.on_cycle(record); });
  return true;
}

}  // namespace

LoadingLog simulate(const Scenario& scenario, const SimulationHooks& hooks) {
  check(scenario);
  try {
    return simulate(scenario, prepared_pile(scenario), hooks);
  } catch (const engine::SolutionBroken& error) {
    LoadingLog log;
    log.message = std::string("the pile broke down while it was poured: ") + error.what();
    if (!scenario.log_file.empty()) write_log(scenario.log_file, log);
    return log;
  }
}

LoadingLog simulate(const Scenario& scenario, const SettledPile& pile, const SimulationHooks& hooks) {
  check(scenario);
  return LoadingRun(scenario, pile, hooks).run();
}

}  // namespace drawpoint::engine::loading
