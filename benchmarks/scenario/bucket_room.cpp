// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/tests/support/yard.hpp>
#include <vector>

#include "command.hpp"
#include "each_seed.hpp"
#include "estimate.hpp"
#include "interrupt.hpp"

/// What the loader's bucket holds when rock falls into it from above. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
namespace granular = engine::granular;
using namespace drawpoint::engine::loading;
using Eigen::Vector3d;

namespace {

const double density = PileOptions{}.density;  // of the rock [kg/m³]

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
      : yard_({}, lh621_in_a_drift().world),
        library_(density, static_cast<int>(SurfaceKind::rock)),
        sampler_(static_cast<std::uint64_t>(seed), density, granular::sizes_named(s.sizes)),
        random_(static_cast<std::uint64_t>(seed)) {
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
      held = std::max(held, mass_in_bucket());
    }
    stand(3);
    return mass_in_bucket();
  }

 private:
  void stand(double seconds) {
    for (const double end = yard_.world.time() + seconds; yard_.world.time() < end;) {
      end_if_interrupted();
      yard_.world.step();
    }
  }

  void tilt_back(double angle) {
    stand(1);
    const double start = yard_.world.time();
    for (double t = 0; t < 12; t = yard_.world.time() - start) {
      const double boom = t < 3 ? 0.15 : 0;
      const double turn = std::clamp(3 * (angle - yard_.driver.read().tip.phi), -0.4, 0.4);
      yard_.driver.command({0, boom, turn - boom});
      stand(yard_.world.options().step);
    }
    yard_.driver.command({});
    stand(1);
  }

  double let_fall(double side) {
    const granular::RockDraw draw = sampler_.next();
    const engine::RockBody body = library_.body({draw.shape, draw.length});
    const Vector3d mouth = yard_.machine.point(yard_.lhd.bucket, Vector3d(2.9, 0, 0.9));
    Eigen::Isometry3d pose(random_.rotation());
    const double along = 1.2 * (random_.uniform() - 0.5), across = side * (0.1 + 1.1 * random_.uniform());
    pose.translation() = mouth + Vector3d(along, across, 3);
    yard_.world.add_rock(body, pose, Vector3d(0, 0, -2));
    return body.mass;
  }

  bool in_bucket(const engine::Rock& rock) const {
    return in_heaped_bucket(yard_.lhd, yard_.driver.in_bucket_frame(rock.pose.translation()));
  }

  void take_away_fallen() {
    const double edge = yard_.machine.point(yard_.lhd.bucket, yard_.lhd.K).z(),
                 low = std::max(0.5, edge - 1.5);
    for (std::size_t k = 0; k < yard_.world.rocks().size(); ++k)
      if (const engine::Rock& rock = yard_.world.rocks()[k];
          rock.present && !in_bucket(rock) && rock.pose.translation().z() < low)
        yard_.world.remove_rock(static_cast<int>(k));
  }

  double mass_in_bucket() const {
    double mass = 0;
    for (const engine::Rock& rock : yard_.world.rocks())
      if (rock.present && in_bucket(rock)) mass += rock.body.mass;
    return mass;
  }

  support::Yard yard_;
  granular::RockLibrary library_;
  granular::RockSampler sampler_;
  engine::CounterRandom random_;
};

nlohmann::json run(const Settings& s) {
  std::vector<double> held(static_cast<std::size_t>(s.seeds));
  each_seed(s.seeds, s.jobs, [&](int seed) {
    const double mass = 1e-3 * Filling(s, seed).fill();
    std::fprintf(stderr, "seed %d: %.1f t\n", seed, mass);
    held[static_cast<std::size_t>(seed - 1)] = mass;
  });
  const Estimate mean = estimate(held);
  const double loose = 1e-3 * density * (1 - loose_ore_porosity);
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
