// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <ode/ode.h>

#include <array>
#include <deque>
#include <stdexcept>

#include "peer.hpp"

/// ODE 0.16.2, Debian's double-precision build: QuickStep (successive over-relaxation).
///
/// Set: dCreateConvex solids, at most eight contact points per pair, friction scaled by the normal force
/// (dContactApprox1, a pyramid), auto-disable off, the number of iterations, the seed of its random order.
/// ODE's defaults: ERP 0.2, CFM 1e-10, over-relaxation 1.3, no warm starting, no surface layer. Rocks are
/// found by a hash space; walls (planes) and blade stand in a space of their own. No rolling resistance.
namespace drawpoint::benchmarks {
namespace {

constexpr int most_points = 8;

/// ODE keeps pointers to these arrays.
struct ConvexData {
  explicit ConvexData(const engine::ConvexPolyhedron& shape) {
    for (const Eigen::Vector3d& p : shape.vertices()) points.insert(points.end(), {p.x(), p.y(), p.z()});
    for (std::size_t f = 0; f < shape.faces().size(); ++f) {
      const auto& face = shape.faces()[f];
      const Eigen::Vector3d& n = shape.face_normals()[f];
      planes.insert(planes.end(), {n.x(), n.y(), n.z(), n.dot(shape.vertices()[face[0]])});
      polygons.push_back(static_cast<unsigned>(face.size()));
      for (const int v : face) polygons.push_back(static_cast<unsigned>(v));
    }
  }
  dGeomID geom(dSpaceID space) const {
    return dCreateConvex(space, planes.data(), static_cast<unsigned>(planes.size() / 4), points.data(),
                         static_cast<unsigned>(points.size() / 3), polygons.data());
  }
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};

void attach(dGeomID geom, dBodyID body, const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
  dGeomSetBody(geom, body);
  dGeomSetPosition(geom, X.translation().x(), X.translation().y(), X.translation().z());
  dGeomSetQuaternion(geom, turn);
}

class Ode : public Peer {
 public:
  Ode(const support::RockPile& pile, const PeerOptions& options)
      : step_(options.step), friction_(pile.material.friction) {
    dRandSetSeed(1);
    dWorldSetGravity(world_, 0, 0, -support::RockPile::gravity);
    dWorldSetQuickStepNumIterations(world_, options.iterations);
    dWorldSetAutoDisableFlag(world_, 0);
    for (const auto& kind : pile.hulls) hulls_.emplace_back(kind.hull);
    for (const auto& rock : pile.rocks) add_rock(pile.hulls[rock.hull], hulls_[rock.hull], rock.start);
    for (const auto& wall : pile.walls)
      dCreatePlane(fixed_, wall.normal.x(), wall.normal.y(), wall.normal.z(), wall.offset);
    add_blade(pile.blade);
  }

  ~Ode() override {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(fixed_);
    dSpaceDestroy(moving_);
    dWorldDestroy(world_);
    dCloseODE();
  }

  std::string version() const override { return dODE_VERSION; }

  void drive_blade(double speed) override { dBodySetLinearVel(blade_, speed, 0, 0); }

  void step() override {
    dJointGroupEmpty(joints_);
    contacts_ = 0;
    dSpaceCollide(moving_, this, &Ode::touch);
    dSpaceCollide2(reinterpret_cast<dGeomID>(moving_), reinterpret_cast<dGeomID>(fixed_), this, &Ode::touch);
    if (dWorldQuickStep(world_, step_) == 0)
      throw std::runtime_error("dWorldQuickStep ran out of memory; use fewer rocks");
  }

  double blade_position() const override { return dBodyGetPosition(blade_)[0]; }

  support::RockState rock(int i) const override {
    const dReal *p = dBodyGetPosition(rocks_[i]), *q = dBodyGetQuaternion(rocks_[i]),
                *v = dBodyGetLinearVel(rocks_[i]), *w = dBodyGetAngularVel(rocks_[i]);
    support::RockState state;
    state.pose.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    state.pose.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
    state.velocity = Eigen::Vector3d(v[0], v[1], v[2]);
    state.angular_velocity = Eigen::Vector3d(w[0], w[1], w[2]);
    return state;
  }

  int contacts() const override { return contacts_; }

 private:
  /// Starts the library before the first of its objects and gives this thread its data.
  static dWorldID start() {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    return dWorldCreate();
  }

  static void touch(void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->join(a, b); }

  void join(dGeomID a, dGeomID b) {
    std::array<dContact, most_points> found;
    const int count = dCollide(a, b, most_points, &found[0].geom, sizeof(dContact));
    contacts_ += count;
    for (int k = 0; k < count; ++k) {
      found[k].surface = {};
      found[k].surface.mode = dContactApprox1;
      found[k].surface.mu = friction_;
      dJointAttach(dJointCreateContact(world_, joints_, &found[k]), dGeomGetBody(a), dGeomGetBody(b));
    }
  }

  void add_rock(const support::PileHull& kind, const ConvexData& hull, const Eigen::Isometry3d& pose) {
    dMass mass;
    dMassSetParameters(&mass, kind.mass, 0, 0, 0, kind.inertia.x(), kind.inertia.y(), kind.inertia.z(), 0, 0,
                       0);
    rocks_.push_back(dBodyCreate(world_));
    dBodySetMass(rocks_.back(), &mass);
    attach(hull.geom(moving_), rocks_.back(), pose);
  }

  void add_blade(const support::PileBlade& blade) {
    hulls_.emplace_back(engine::box(blade.half));
    blade_ = dBodyCreate(world_);
    dBodySetKinematic(blade_);
    attach(hulls_.back().geom(fixed_), blade_, Eigen::Isometry3d(Eigen::Translation3d(blade.start)));
  }

  double step_, friction_;
  dWorldID world_ = start();
  dSpaceID moving_ = dHashSpaceCreate(nullptr), fixed_ = dSimpleSpaceCreate(nullptr);
  dJointGroupID joints_ = dJointGroupCreate(0);
  std::deque<ConvexData> hulls_;
  std::vector<dBodyID> rocks_;
  dBodyID blade_ = nullptr;
  int contacts_ = 0;
};

}  // namespace

std::string engine_name() { return "ode"; }

std::unique_ptr<Peer> make_peer(const support::RockPile& pile, const PeerOptions& options) {
  return std::make_unique<Ode>(pile, options);
}

}  // namespace drawpoint::benchmarks
