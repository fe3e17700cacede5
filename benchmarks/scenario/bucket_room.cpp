// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <memory>
#include <random>
#include <vector>

#include "command.hpp"
#include "each_seed.hpp"
#include "estimate.hpp"
#include "interrupt.hpp"

/// What the loader's bucket holds when rock falls into it from above. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
namespace granular = engine::granular;
namespace machine = engine::machine;
using namespace drawpoint::engine::loading;
using Eigen::Vector3d;

namespace {

constexpr const char* about =
    "Tilts the loader's bucket back as it is carried, lets rock fall into it until no more stays, and weighs "
    "what it holds,\n"
    "beside what its struck and its heaped volume hold at the porosity that fills are counted with. A bucket "
    "that holds\n"
    "about that is no smaller for these rocks than its volumes say: what a loading cycle lacks is then how "
    "it "
    "loads.\n\n"
    "  bucket_room                            tilted by 44 degrees, three seeds\n"
    "  bucket_room --sizes well_broken --tilt 35 --seeds 2 --jobs 2";

struct Settings {
  std::string sizes = "mine";
  double tilt = 44;  // [deg]
  int seeds = 3, jobs = 1;
  bool json = false;
};

// The machine on a floor, with its bucket up and tilted back.
class Filling {
 public:
  Filling(const Settings& s, int seed)
      : scenario_(lh621_in_a_drift()),
        lhd_(sandvik_lh621(scenario_.machine)),
        machine_(lhd_.spec),
        world_(scenario_.world, material_table(scenario_.materials)),
        driver_(lhd_, machine_),
        library_(scenario_.pile.density, static_cast<int>(SurfaceKind::rock)),
        sampler_(static_cast<std::uint64_t>(seed), scenario_.pile.density, granular::sizes_named(s.sizes)),
        random_(static_cast<std::uint64_t>(seed)) {
    world_.add_static(std::make_shared<const engine::Shape>(engine::HalfSpace{Vector3d::UnitZ(), 0}),
                      Eigen::Isometry3d::Identity(), static_cast<int>(SurfaceKind::terrain));
    driver_.place(0, 0);
    add_machine(world_, lhd_, machine_);
    tilt_back(s.tilt * M_PI / 180);
  }

  // Rock comes two at a time, twice a second; what falls past the bucket is taken away. Full once it holds no more
  // than before 5 t were let go.
  double fill() {
    double held = 0, let_go = 0;
    for (double before = -1; held > before || let_go < 5e3;) {
      before = held;
      for (double batch = 0; batch < 5e3;) {
        for (const double side : {-1.0, 1.0}) batch += let_fall(side);
        stand(0.5);
        take_away_fallen();
      }
      let_go += 5e3;
      held = std::max(held, in_bucket());
    }
    stand(3);
    return in_bucket();
  }

 private:
  void stand(double seconds) {
    for (const double end = world_.time() + seconds; world_.time() < end;) {
      end_if_interrupted();
      world_.step();
    }
  }

  void tilt_back(double angle) {
    stand(1);
    const double start = world_.time();
    for (double t = 0; t < 12; t = world_.time() - start) {
      const double boom = t < 3 ? 0.15 : 0;
      const double turn = std::clamp(3 * (angle - driver_.read().tip.phi), -0.4, 0.4);
      driver_.command({0, boom, turn - boom});
      stand(world_.options().step);
    }
    driver_.command({});
    stand(1);
  }

  // As the machine's spec has it to the world.
  Eigen::Isometry3d bucket() const {
    const Vector3d centre = lhd_.spec.bodies[static_cast<std::size_t>(lhd_.bucket)].centre;
    return machine_.pose(lhd_.bucket) * Eigen::Translation3d(-centre);
  }

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }  // the same with any library

  double let_fall(double side) {
    const granular::RockDraw draw = sampler_.next();
    const engine::RockBody body = library_.body({draw.shape, draw.length});
    const Eigen::Vector4d turn(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
    const Vector3d mouth = bucket() * Vector3d(2.9, 0, 0.9);
    Eigen::Isometry3d pose(Eigen::Quaterniond(turn.normalized()));
    pose.translation() = mouth + Vector3d(1.2 * (uniform() - 0.5), side * (0.1 + 1.1 * uniform()), 3);
    world_.add_rock(body, pose, Vector3d(0, 0, -2));
    return body.mass;
  }

  template <class Act>
  void for_each_rock(const Act& act) {
    const Eigen::Isometry3d to_machine = bucket().inverse();
    for (std::size_t k = 0; k < world_.rocks().size(); ++k)
      if (const engine::Rock& rock = world_.rocks()[k]; rock.present)
        act(static_cast<int>(k), rock, in_heaped_bucket(lhd_, to_machine * rock.pose.translation()));
  }

  void take_away_fallen() {
    const double low = machine_.point(lhd_.bucket, lhd_.K).z() - 1.5;
    for_each_rock([&](int k, const engine::Rock& rock, bool inside) {
      if (!inside && rock.pose.translation().z() < std::max(0.5, low)) world_.remove_rock(k);
    });
  }

  double in_bucket() {
    double mass = 0;
    for_each_rock([&](int, const engine::Rock& rock, bool inside) { mass += inside ? rock.body.mass : 0; });
    return mass;
  }

  Scenario scenario_;
  Lhd lhd_;
  machine::Machine machine_;
  engine::World world_;
  LhdDriver driver_;
  granular::RockLibrary library_;
  granular::RockSampler sampler_;
  std::mt19937_64 random_;
};

nlohmann::json run(const Settings& s) {
  std::vector<double> held(static_cast<std::size_t>(s.seeds));
  each_seed(s.seeds, s.jobs, [&](int seed) {
    const double mass = 1e-3 * Filling(s, seed).fill();
    std::fprintf(stderr, "seed %d: %.1f t\n", seed, mass);
    held[static_cast<std::size_t>(seed - 1)] = mass;
  });
  const Estimate mean = estimate(held);
  const double loose = 1e-3 * Scenario{}.pile.density * (1 - loose_ore_porosity);
  return {{"sizes", s.sizes},
          {"tilt_deg", s.tilt},
          {"held_t", held},
          {"mean_t", mean.mean},
          {"half_width_t", s.seeds > 1 ? nlohmann::json(mean.half_width) : nlohmann::json()},
          {"struck_t", loose * struck_volume({})},
          {"heaped_t", loose * heaped_volume({})}};
}

void print(const nlohmann::json& j) {
  const auto number = [&](const char* key) { return j.at(key).get<double>(); };
  std::printf("bucket tilted back by %g degrees, rocks %s: holds %.1f t", number("tilt_deg"),
              j.at("sizes").get<std::string>().c_str(), number("mean_t"));
  if (!j.at("half_width_t").is_null()) std::printf(" ± %.1f (95 %%)", number("half_width_t"));
  std::printf("\nits struck volume %.1f t, its heaped volume %.1f t of rock with a porosity of %.2f\n",
              number("struck_t"), number("heaped_t"), loose_ore_porosity);
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "bucket_room");
  app.add_option("--sizes", s.sizes, "of the rocks, as in the loading case")
      ->check(one_of(granular::size_names))
      ->capture_default_str();
  app.add_option("--tilt", s.tilt, "of the bucket's floor, edge up [deg]")
      ->check(between(20, 44, "deg", "44 is as it is carried"))
      ->capture_default_str();
  app.add_option("--seeds", s.seeds, "fillings, each with its own rocks")
      ->check(between(1, 1000, "", "3 show the scatter"))
      ->capture_default_str();
  app.add_option("--jobs", s.jobs, "fillings at a time")
      ->check(between(1, 256, "", "no more than there are cores"))
      ->capture_default_str();
  add_json_flag(app, s.json);
  return run_command(app, argc, argv, [&] {
    watch_for_interrupt();
    return show(run(s), s.json, print);
  });
}
