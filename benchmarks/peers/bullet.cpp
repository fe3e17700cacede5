// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "peer.hpp"

/// Bullet 3.24, Debian's single-precision build: sequential impulses, dynamic AABB trees.
///
/// Set: hulls with a margin of 5 mm in place of 40 mm, which serves GJK alone, as contact points come from
/// clipping the true faces (initializePolyhedralFeatures); deactivation off; the number of iterations.
/// Bullet's defaults: warm starting at 0.85, one friction direction per contact, split impulses, at most four
/// points a manifold. Each half-space is a cube 20 m wide, clipped like the rocks. Friction combines as a
/// product, so each body has its root.
///
/// Tried and left out, 500 rocks: separating axes for GJK (m_enableSatConvex) take about ten times as long;
/// two friction directions treble the overlap and drift by 4 to 5 mm/s, as one direction does; rolling
/// friction costs more and drifts the same; no clipping holds rocks a margin apart.
namespace drawpoint::benchmarks {
namespace {

constexpr btScalar margin = 0.005f;
constexpr double slab = 10;  // half extent of the cube that stands for a half-space [m]

btVector3 bullet_vector(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btTransform bullet_pose(const Eigen::Isometry3d& X) {
  const Eigen::Quaternionf q(Eigen::Quaterniond(X.linear()).cast<float>());
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), bullet_vector(X.translation()));
}

Eigen::Vector3d eigen_vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Isometry3d eigen_pose(const btTransform& X) {
  const btQuaternion q = X.getRotation();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
  pose.translation() = eigen_vector(X.getOrigin());
  return pose;
}

std::shared_ptr<btCollisionShape> hull(const engine::ConvexPolyhedron& shape) {
  auto result = std::make_shared<btConvexHullShape>();
  for (const Eigen::Vector3d& p : shape.vertices()) result->addPoint(bullet_vector(p), false);
  result->recalcLocalAabb();
  result->setMargin(margin);
  result->initializePolyhedralFeatures();
  return result;
}

/// Where a cube has the wall as its upper face.
Eigen::Isometry3d slab_pose(const support::PileWall& wall) {
  Eigen::Isometry3d X(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), wall.normal));
  X.translation() = (wall.offset - slab) * wall.normal;
  return X;
}

class Bullet : public Peer {
 public:
  Bullet(const support::RockPile& pile, const PeerOptions& options)
      : step_(static_cast<btScalar>(options.step)),
        friction_(static_cast<btScalar>(std::sqrt(pile.material.friction))) {
    world_.setGravity({0, 0, static_cast<btScalar>(-support::RockPile::gravity)});
    world_.getSolverInfo().m_numIterations = options.iterations;
    std::vector<std::shared_ptr<btCollisionShape>> hulls;
    for (const auto& kind : pile.hulls) hulls.push_back(hull(kind.hull));
    for (const auto& rock : pile.rocks) {
      const auto& kind = pile.hulls[rock.hull];
      rocks_.push_back(add(hulls[rock.hull], rock.start, {kind.mass, kind.inertia}));
    }
    for (const auto& wall : pile.walls) add(hull(engine::box({slab, slab, slab})), slab_pose(wall), {});
    blade_ = add(hull(engine::box(pile.blade.half)),
                 Eigen::Isometry3d(Eigen::Translation3d(pile.blade.start)), {});
    blade_->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  }

  ~Bullet() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  std::string version() const override {
    const int version = btGetVersion();
    return std::to_string(version / 100) + "." + std::to_string(version % 100);
  }

  void drive_blade(double speed) override { blade_step_ = step_ * static_cast<btScalar>(speed); }

  void step() override {
    btTransform X = blade_->getWorldTransform();
    X.getOrigin() += btVector3(blade_step_, 0, 0);
    blade_->getMotionState()->setWorldTransform(X);  // its velocity is that of this motion
    world_.stepSimulation(step_, 0);
  }

  double blade_position() const override { return blade_->getWorldTransform().getOrigin().x(); }

  support::RockState rock(int i) const override {
    const btRigidBody& body = *rocks_[i];
    return {eigen_pose(body.getCenterOfMassTransform()), eigen_vector(body.getLinearVelocity()),
            eigen_vector(body.getAngularVelocity())};
  }

  int contacts() const override {
    int points = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
      points += dispatcher_.getManifoldByIndexInternal(i)->getNumContacts();
    return points;
  }

 private:
  struct Inertia {
    double mass = 0;  ///< 0: not moved by contacts
    Eigen::Vector3d moments = Eigen::Vector3d::Zero();
  };

  btRigidBody* add(const std::shared_ptr<btCollisionShape>& shape, const Eigen::Isometry3d& pose,
                   const Inertia& inertia) {
    shapes_.push_back(shape);
    states_.push_back(std::make_unique<btDefaultMotionState>(bullet_pose(pose)));
    btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(inertia.mass), states_.back().get(),
                                                  shape.get(), bullet_vector(inertia.moments));
    info.m_friction = friction_;
    info.m_restitution = 0;
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
    return bodies_.back().get();
  }

  btScalar step_, friction_, blade_step_ = 0;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broad_phase_, &solver_, &configuration_};
  std::vector<std::shared_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btDefaultMotionState>> states_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<btRigidBody*> rocks_;
  btRigidBody* blade_ = nullptr;
};

}  // namespace

std::string engine_name() { return "bullet"; }

std::unique_ptr<Peer> make_peer(const support::RockPile& pile, const PeerOptions& options) {
  return std::make_unique<Bullet>(pile, options);
}

}  // namespace drawpoint::benchmarks
