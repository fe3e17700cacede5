// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <fcl/config.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <sys/wait.h>
#include <unistd.h>

#include <drawpoint/engine/collision/fcl_axis.h>
#include <drawpoint/engine/geometry/hull_extremes.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <drawpoint/tests/support/feature_pairs.hpp>
#include <drawpoint/tests/support/rock_pairs.hpp>
#include <functional>

/// FCL's narrow phase on convex polyhedra: the smallest cases known in which it is wrong, and how often and how fast
/// it is on rocks that meet feature on feature. `fcl_failures [PAIRS]`, 100 000 if not said. Each case and each row
/// runs in a process of its own: some end it. Reported in docs/measurements/fcl-narrow-phase.md.
namespace {

using namespace drawpoint;
using namespace drawpoint::engine;
using detail::CollisionHull;
using detail::HullPair;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double tolerance = 1e-6;  // FCL's own default, of the cases [m]

struct Answer {
  bool given = false;
  Vector3d normal = Vector3d::Zero();
  double separation = 0;  // along the normal; minus the depth
};

// One way to ask FCL about two shapes.
using Ask =
    std::function<Answer(const fcl::Convexd&, const Isometry3d&, const fcl::Convexd&, const Isometry3d&)>;

fcl::Convexd fcl_shape(const ConvexPolyhedron& shape) {
  const auto faces = std::make_shared<std::vector<int>>();
  for (const auto& face : shape.faces()) {
    faces->push_back(static_cast<int>(face.size()));
    faces->insert(faces->end(), face.begin(), face.end());
  }
  return {std::make_shared<const std::vector<Vector3d>>(shape.vertices()),
          static_cast<int>(shape.faces().size()), faces};
}

Ask collide_by(fcl::GJKSolverType solver, double tolerated = tolerance) {
  return [=](const fcl::Convexd& a, const Isometry3d& X_WA, const fcl::Convexd& b, const Isometry3d& X_WB) {
    fcl::CollisionRequestd request(1, true);
    request.gjk_solver_type = solver;
    request.gjk_tolerance = tolerated;
    fcl::CollisionResultd result;
    fcl::collide(&a, X_WA, &b, X_WB, request, result);
    if (!result.isCollision()) return Answer{};
    return Answer{true, result.getContact(0).normal, -result.getContact(0).penetration_depth};
  };
}

Ask signed_distance(double tolerated = tolerance) {
  return [=](const fcl::Convexd& a, const Isometry3d& X_WA, const fcl::Convexd& b, const Isometry3d& X_WB) {
    const fcl::DistanceRequestd request(true, true, 0, 0, tolerated, fcl::GST_LIBCCD);
    fcl::DistanceResultd result;
    fcl::distance(&a, X_WA, &b, X_WB, request, result);
    const Vector3d way = result.nearest_points[1] - result.nearest_points[0];
    return Answer{true, (result.min_distance < 0 ? Vector3d(-way) : way).normalized(), result.min_distance};
  };
}

// Runs it in a child, which a failed assertion or an endless loop ends.
void alone(const std::function<void()>& run, unsigned seconds) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(seconds);
    run();
    std::fflush(stdout);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
    std::printf("%s\n",
                WTERMSIG(status) == SIGALRM ? "no answer: endless" : "no answer: the process is aborted");
}

struct Case {
  const char* call;
  Ask ask;
  ConvexPolyhedron a, b;
  Isometry3d X_WA, X_WB;
};

ConvexPolyhedron hull(const std::vector<Vector3d>& points) { return ConvexPolyhedron::hull_of(points); }

void print(const char* name, const ConvexPolyhedron& shape, const Isometry3d& X) {
  std::printf("  %s:", name);
  for (const Vector3d& v : shape.vertices()) {
    const Vector3d p = X * v;
    std::printf(" (%g, %g, %g)", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
  }
  std::printf("\n");
}

void show(const Case& c) {
  std::printf("%s\n", c.call);
  print("A", c.a, c.X_WA), print("B", c.b, c.X_WB);
  const double expected = support::best_separation(c.a.transformed(c.X_WA), c.b.transformed(c.X_WB));
  std::printf("  expected: separation %.6g\n  reported: ", expected);
  alone(
      [&] {
        const Answer answer = c.ask(fcl_shape(c.a), c.X_WA, fcl_shape(c.b), c.X_WB);
        if (!answer.given) std::printf("no collision\n");
        if (answer.given)
          std::printf("separation %.6g along (%.4g, %.4g, %.4g)\n", answer.separation, answer.normal.x(),
                      answer.normal.y(), answer.normal.z());
      },
      5);
}

void show_cases() {
  const ConvexPolyhedron cube = box({1, 1, 1});
  const Isometry3d here = Isometry3d::Identity();
  const auto at = [](double x, double y, double z) { return Isometry3d(Eigen::Translation3d(x, y, z)); };
  const Isometry3d turned(Eigen::AngleAxisd(0.5 * EIGEN_PI, Vector3d::UnitX()));
  const std::vector<Case> cases{
      {"1 fcl::collide, GST_INDEP: the normal is in A's frame, the depth has the other sign (both cubes "
       "turned by "
       "90 deg "
       "about x)",
       collide_by(fcl::GST_INDEP), cube, cube, turned, turned * at(0.25, 0.5, 1.75)},
      {"2 fcl::collide, GST_INDEP: depth of two cubes", collide_by(fcl::GST_INDEP), cube, cube, here,
       at(1, -0.5, 0)},
      {"3 fcl::collide, GST_LIBCCD: depth toward the centres", collide_by(fcl::GST_LIBCCD), cube, cube, here,
       at(-1, 0, -1)},
      {"4 fcl::distance, GST_LIBCCD, signed: two cubes that overlap are called touching", signed_distance(),
       cube, cube, here, at(-1, 0, 1.5)},
      {"5 fcl::distance, GST_LIBCCD, signed: depth of two tetrahedra", signed_distance(),
       hull({{2, 2, 2}, {0, 0, 1}, {0, 1, 0}, {2, 0, 1}}), hull({{0, 2, 1}, {2, 2, 2}, {0, 1, 1}, {1, 1, 1}}),
       here, at(1, -0.5, 0.5)},
      {"6 fcl::distance, GST_LIBCCD, signed: an assertion fails", signed_distance(),
       hull({{2, 2, 1}, {0, 2, 1}, {2, 1, 2}, {0, 1, 0}}), hull({{0, 1, 1}, {2, 0, 2}, {2, 2, 2}, {2, 1, 0}}),
       here, at(0, 1.5, -0.5)}};
  for (const Case& c : cases) show(c);
}

struct RockPairs {
  std::vector<ConvexPolyhedron> shapes;
  std::vector<CollisionHull> hulls;
  struct Pair {
    int a, b;
    Isometry3d X_AB;
    double separation;
  };
  std::vector<Pair> pairs;
};

RockPairs rock_pairs(int count) {
  RockPairs all;
  for (int shape = 0; shape < 6; ++shape)
    for (double size : {0.3, 0.4, 0.6, 0.8}) all.shapes.push_back(support::rock(shape).scaled(size));
  for (const ConvexPolyhedron& shape : all.shapes) all.hulls.emplace_back(shape);
  support::FeaturePairs place(21, 0.01);
  detail::AxisSearch search;
  for (int k = 0; k < count; ++k) {
    const int a = static_cast<int>(place.rng()() % all.shapes.size()),
              b = static_cast<int>(place.rng()() % all.shapes.size());
    const Isometry3d X_AB = place.place(all.shapes[a], Isometry3d::Identity(), all.shapes[b]);
    const double separation = search.find({all.hulls[a], all.hulls[b], X_AB}, {10, 0, {}}).separation;
    all.pairs.push_back({a, b, X_AB, separation});
  }
  return all;
}

// Of the processor, so that other programs do not count.
double nanoseconds_since(std::clock_t start) {
  return 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// FCL alone: overlaps that it misses, and depths that are off by more than 1 µm or 1 mm.
void count(const RockPairs& all, const char* name, const Ask& ask) {
  const Isometry3d here = Isometry3d::Identity();
  std::vector<fcl::Convexd> shapes;
  for (const auto& shape : all.shapes) shapes.push_back(fcl_shape(shape));
  long overlapping = 0, missed = 0, off = 0, far_off = 0;
  const std::clock_t start = std::clock();
  for (const auto& p : all.pairs) {
    const Answer answer = ask(shapes[p.a], here, shapes[p.b], p.X_AB);
    if (p.separation > -1e-6) continue;
    ++overlapping;
    const double error = std::abs(-std::abs(answer.separation) - p.separation);
    if (!answer.given)
      ++missed;
    else
      off += error > 1e-6, far_off += error > 1e-3;
  }
  const double time = nanoseconds_since(start), million = 1e6 / static_cast<double>(overlapping);
  std::printf("%-38s %6.0f ns; per million overlapping: %6.0f missed, %6.0f off by 1 um, %6.0f by 1 mm\n",
              name, time / static_cast<double>(all.pairs.size()), missed * million, off * million,
              far_off * million);
}

// As the engine uses it, manifold included.
void count_checked(const RockPairs& all, NarrowMethod method) {
  detail::FclAxes fcl(method);
  for (std::size_t k = 0; k < all.hulls.size(); ++k) fcl.add(static_cast<int>(k), &all.hulls[k]);
  detail::ConvexContactSearch search;
  long refused = 0;
  const std::clock_t start = std::clock();
  for (const auto& p : all.pairs) {
    detail::ConvexContact contact;
    const HullPair pair{all.hulls[p.a], all.hulls[p.b], p.X_AB};
    if (!fcl.on())
      search.find(pair, {0.011, 1e-4, {}}, contact);
    else if (!detail::find_by_fcl(fcl, p.a, p.b, pair, {0.011, 1e-4, {}}, search, contact))
      ++refused;
  }
  const double time = nanoseconds_since(start);
  const double pairs = static_cast<double>(all.pairs.size());
  std::printf("%-38s %6.0f ns, manifold included; per million pairs: %6.0f refused\n",
              std::string(to_string(method)).c_str(), time / pairs,
              1e6 * static_cast<double>(refused) / pairs);
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc > 1 ? std::atoi(argv[1]) : 100'000;
  if (pairs < 1 || argc > 2) {
    std::fprintf(stderr, "fcl_failures: give the number of pairs, at least 1, or nothing for 100000\n");
    return 2;
  }
  std::printf("FCL %s\n\n", FCL_VERSION);
  show_cases();
  const RockPairs all = rock_pairs(pairs);
  std::printf("\n%d pairs of rocks, tolerance %g m\n", pairs, constants::fcl_tolerance);
  const auto row = [&](const char* name, const Ask& ask) { alone([&] { count(all, name, ask); }, 600); };
  row("fcl::collide, GST_LIBCCD", collide_by(fcl::GST_LIBCCD, constants::fcl_tolerance));
  row("fcl::collide, GST_INDEP", collide_by(fcl::GST_INDEP, constants::fcl_tolerance));
  row("fcl::distance, GST_LIBCCD, signed", signed_distance(constants::fcl_tolerance));
  for (const NarrowMethod method :
       {NarrowMethod::separating_axes, NarrowMethod::fcl_libccd, NarrowMethod::fcl_indep})
    alone([&] { count_checked(all, method); }, 600);
  return 0;
}
