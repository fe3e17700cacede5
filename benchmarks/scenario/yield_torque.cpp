// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <drawpoint/engine/loading/yield_test.hpp>
#include <vector>

#include "command.hpp"
#include "setting.hpp"

/// The yield torque of the bucket's hinge by the crash of engine/loading/yield_test.hpp. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using namespace drawpoint::engine::loading;

namespace {

constexpr const char* about =
    "Drives the loader's bucket into a rock that nothing moves and prints the largest torque in hinge G: the "
    "yield\n"
    "torque above which joint_damage counts, for the step, stiffness and filter given. Lindmark (2016) "
    "found\n"
    "145 kN m with settings of its own; where the rock stood there is not known.\n\n"
    "  yield_torque                           rock before the middle, half-way to and near the corner\n"
    "  yield_torque --setting 5x16x5          another step and more iterations\n"
    "  yield_torque --arm hinges              with motors in the hinges, as in Lindmark (2016)\n"
    "  yield_torque --offsets 0 --lowpass 0   the raw peak";

struct Settings {
  std::string speeds = "lindmark2016", arm = "cylinders", materials = "calibrated", setting;
  std::vector<double> offsets = {0, 0.8, 1.5};
  double rock = YieldTestOptions{}.rock_size, lowpass = YieldTestOptions{}.lowpass_hz;
  bool json = false;
};

nlohmann::json run(const Settings& s) {
  Scenario scenario = with_speeds(lh621_in_a_drift(), s.speeds);
  scenario.machine.arm_drive = arm_drive_named(s.arm);
  scenario.materials = materials_named(s.materials);
  if (!s.setting.empty()) scenario.world = with(scenario.world, setting_of(s.setting));
  nlohmann::json out{{"rock_m", s.rock},
                     {"lowpass_hz", s.lowpass},
                     {"speeds", s.speeds},
                     {"arm", s.arm},
                     {"materials", s.materials},
                     {"solved", in_words(described(scenario.world))},
                     {"rows", nlohmann::json::array()}};
  for (const double offset : s.offsets) {
    const YieldTest test =
        yield_test(scenario, {.rock_size = s.rock, .offset = offset, .lowpass_hz = s.lowpass});
    out["rows"].push_back({{"offset_m", offset},
                           {"touch_speed_m_s", test.touch_speed},
                           {"peak_n_m", test.peak},
                           {"peak_twisting_n_m", test.peak_twisting},
                           {"unfiltered_peak_n_m", test.unfiltered_peak}});
  }
  return out;
}

void print(const nlohmann::json& j) {
  const auto text = [&](const char* key) { return j.at(key).get<std::string>(); };
  std::printf("rock of %g m, low-pass %g Hz, %s speeds, arm moved by %s, %s materials; solved with %s\n",
              j.at("rock_m").get<double>(), j.at("lowpass_hz").get<double>(), text("speeds").c_str(),
              text("arm").c_str(), text("materials").c_str(), text("solved").c_str());
  std::printf("offset m  touches at m/s  torque kN m  twisting kN m  without low-pass kN m\n");
  for (const nlohmann::json& row : j.at("rows")) {
    const auto number = [&](const char* key) { return row.at(key).get<double>(); };
    std::printf("%8.2f %15.2f %12.0f %14.0f %22.0f\n", number("offset_m"), number("touch_speed_m_s"),
                number("peak_n_m") / 1e3, number("peak_twisting_n_m") / 1e3,
                number("unfiltered_peak_n_m") / 1e3);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "yield_torque");
  app.add_option("--offsets", s.offsets, "of the rock from the middle of the edge [m], with commas between")
      ->delimiter(',')
      ->check(between(-1.6, 1.6, "m", "the bucket is 3.2 m wide"));
  app.add_option("--rock", s.rock, "longest dimension of the rock [m]")
      ->check(between(0.3, 3, "m", "1 is usual"))
      ->capture_default_str();
  app.add_option("--lowpass", s.lowpass, "corner of the filter [Hz]; 0: none")
      ->check(between(0, 1e4, "Hz", "20 is what joint_damage takes"))
      ->capture_default_str();
  app.add_option("--speeds", s.speeds, "preset of the actuators' speeds")
      ->check(one_of(speed_names))
      ->capture_default_str();
  app.add_option("--arm", s.arm, "what moves it: cylinders, or motors in its hinges as in Lindmark (2016)")
      ->check(one_of(arm_drive_names))
      ->capture_default_str();
  app.add_option("--materials", s.materials, "contact coefficients; the rock meets the bucket's steel")
      ->check(one_of(material_names))
      ->capture_default_str();
  app.add_option("--setting", s.setting,
                 "step and work, as 10x16x5 or 10x16x1+20000~0.02 (default: the scene's)")
      ->check(taken_by(setting_of));
  add_json_flag(app, s.json);
  return run_command(app, argc, argv, [&] { return show(run(s), s.json, print); });
}
