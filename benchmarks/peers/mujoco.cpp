// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <mujoco/mujoco.h>

#include <array>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "peer.hpp"

/// MuJoCo 2.2.2, Debian's build: soft contacts, one convex optimisation per step.
///
/// Set: the conjugate-gradient solver (the default, Newton, gives the same pile but takes some thirty times
/// as long at 500 rocks), sparse Jacobians, the elliptic friction cone, the number of iterations, room for
/// the contacts. MuJoCo's defaults: solref 0.02 s (two steps of 10 ms, the stiffest that it allows at this
/// step), solimp 0.9 to 0.95, tolerance 1e-8, one contact point per pair of hulls. The blade is a slider of
/// 1e9 kg whose velocity is set before every step; 1e6 N s change it by 1e-3 m/s. Walls are planes. No
/// rolling resistance. This version counts bytes in 32 bits: about 500 rocks is all that it can hold.
namespace drawpoint::benchmarks {
namespace {

constexpr int contacts_per_rock = 6;  // a settled pile has three
constexpr double blade_mass = 1e9;    // [kg]

/// MuJoCo reads its models as XML.
class ModelText {
 public:
  ModelText(const support::RockPile& pile, const PeerOptions& options) {
    out_.precision(17);
    out_ << "<mujoco>\n";
    write_options(pile, options);
    out_ << "<asset>\n";
    for (std::size_t i = 0; i < pile.hulls.size(); ++i) write_mesh(i, pile.hulls[i].hull);
    out_ << "</asset>\n<worldbody>\n";
    for (const auto& wall : pile.walls) write_wall(wall);
    for (const auto& rock : pile.rocks) write_rock(rock, pile.hulls[rock.hull]);
    write_blade(pile.blade);
    out_ << "</worldbody>\n</mujoco>\n";
  }

  std::string str() const { return out_.str(); }

 private:
  void write_options(const support::RockPile& pile, const PeerOptions& options) {
    const auto contacts = contacts_per_rock * pile.rocks.size() + 100;
    out_ << "<size nconmax='" << contacts << "' njmax='" << 3 * contacts << "'/>\n<option timestep='"
         << options.step << "' gravity='0 0 " << -support::RockPile::gravity << "' iterations='"
         << options.iterations
         << "' solver='CG' cone='elliptic' jacobian='sparse'/>\n<default><geom friction='"
         << pile.material.friction << " 0 0' condim='3'/></default>\n";
  }

  void write(const Eigen::Vector3d& v) { out_ << v.x() << ' ' << v.y() << ' ' << v.z() << ' '; }

  void write_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& q) {
    out_ << " pos='";
    write(position);
    out_ << "' quat='" << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << "' ";
  }

  void write_mesh(std::size_t index, const engine::ConvexPolyhedron& shape) {
    out_ << "<mesh name='hull" << index << "' vertex='";
    for (const Eigen::Vector3d& p : shape.vertices()) write(p);
    out_ << "'/>\n";
  }

  void write_wall(const support::PileWall& wall) {
    out_ << "<geom type='plane' size='0 0 1'";
    write_pose(wall.offset * wall.normal,
               Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), wall.normal));
    out_ << "/>\n";
  }

  void write_rock(const support::PileRock& rock, const support::PileHull& kind) {
    out_ << "<body";
    write_pose(rock.start.translation(), Eigen::Quaterniond(rock.start.linear()));
    out_ << "><freejoint/><inertial pos='0 0 0' mass='" << kind.mass << "' diaginertia='";
    write(kind.inertia);
    out_ << "'/><geom type='mesh' conaffinity='3' mesh='hull" << rock.hull << "'/></body>\n";
  }

  void write_blade(const support::PileBlade& blade) {
    out_ << "<body";
    write_pose(blade.start, Eigen::Quaterniond::Identity());
    out_ << "><joint type='slide' axis='1 0 0'/><geom type='box' contype='2' conaffinity='2' mass='"
         << blade_mass << "' size='";
    write(blade.half);
    out_ << "'/></body>\n";
  }

  std::ostringstream out_;
};

struct Free {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

std::unique_ptr<mjModel, Free> load(const std::string& text) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "pile.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  std::array<char, 1000> error{};
  std::unique_ptr<mjModel, Free> model(
      mj_loadXML("pile.xml", files.get(), error.data(), static_cast<int>(error.size())));
  mj_deleteVFS(files.get());
  if (!model)
    throw std::runtime_error(std::string("MuJoCo refuses the scene: ") + error.data() +
                             "; it holds about 500 rocks at most");
  return model;
}

/// Mean of the rocks' diagonal mass matrix. MuJoCo scales its solver's tolerance by this mean; with the blade
/// in it, the solver would stop far too soon.
double mean_inertia(const support::RockPile& pile) {
  double sum = 0;
  for (const auto& rock : pile.rocks)
    sum += 3 * pile.hulls[rock.hull].mass + pile.hulls[rock.hull].inertia.sum();
  return sum / (6 * static_cast<double>(pile.rocks.size()));
}

class Mujoco : public Peer {
 public:
  Mujoco(const support::RockPile& pile, const PeerOptions& options)
      : model_(load(ModelText(pile, options).str())),
        data_(mj_makeData(model_.get())),
        blade_start_(pile.blade.start.x()) {
    model_->stat.meaninertia = mean_inertia(pile);
    if (!data_) throw std::runtime_error("MuJoCo has no memory for the scene; use fewer rocks");
  }

  std::string version() const override { return mj_versionString(); }

  void drive_blade(double speed) override { speed_ = speed; }

  void step() override {
    data_->qvel[model_->nv - 1]  // the last joint is the blade's
        = speed_;
    mj_step(model_.get(), data_.get());
    for (const auto warning :
         {mjWARN_CONTACTFULL, mjWARN_CNSTRFULL, mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
      if (data_->warning[warning].number > 0)
        throw std::runtime_error(std::string("MuJoCo: ") +
                                 mju_warningText(warning, data_->warning[warning].lastinfo));
  }

  double blade_position() const override { return blade_start_ + data_->qpos[model_->nq - 1]; }

  support::RockState rock(int i) const override {
    // A free joint has seven coordinates and six velocities: position and quaternion; velocity in the world
    // and angular velocity in the body. Rocks come before the blade.
    const mjtNum *q = data_->qpos + 7 * i, *v = data_->qvel + 6 * i;
    support::RockState state;
    state.pose.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix();
    state.pose.translation() = Eigen::Vector3d(q[0], q[1], q[2]);
    state.velocity = Eigen::Vector3d(v[0], v[1], v[2]);
    state.angular_velocity = state.pose.linear() * Eigen::Vector3d(v[3], v[4], v[5]);
    return state;
  }

  int contacts() const override { return data_->ncon; }

 private:
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
  double blade_start_, speed_ = 0;
};

}  // namespace

std::string engine_name() { return "mujoco"; }

std::unique_ptr<Peer> make_peer(const support::RockPile& pile, const PeerOptions& options) {
  return std::make_unique<Mujoco>(pile, options);
}

}  // namespace drawpoint::benchmarks
