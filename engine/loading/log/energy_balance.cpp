// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/cycle_samples.hpp>
#include <drawpoint/engine/loading/log/energy_balance.hpp>

namespace drawpoint::engine::loading {

std::vector<std::vector<EnergyBalance>> energy_balances(const LoadingLog& log) {
  const record::Table& s = log.signals;
  const std::size_t lift_force = s.index("lift_force"), lift_speed = s.index("lift_speed"),
                    tilt_force = s.index("tilt_force"), tilt_speed = s.index("tilt_speed"),
                    wheels = s.index("wheel_power"), machine = s.index("machine_energy"),
                    rock = s.index("rock_energy");
  const CycleSamples samples(log);
  std::vector<std::vector<EnergyBalance>> balances(log.cycles.size());
  std::vector<std::size_t> first(log.cycles.size());
  for (std::size_t row = 0; row < samples.rows(); ++row) {
    const auto cycle = samples.cycle(row);
    if (!cycle) continue;
    std::vector<EnergyBalance>& balance = balances[*cycle];
    if (balance.empty()) {
      first[*cycle] = row;
      balance.emplace_back();
      continue;
    }
    const double power = s.at(row, wheels) + s.at(row, lift_force) * s.at(row, lift_speed) +
                         s.at(row, tilt_force) * s.at(row, tilt_speed);
    EnergyBalance now;
    now.work = balance.back().work + power * samples.weight(row) / 1000;
    now.machine = (s.at(row, machine) - s.at(first[*cycle], machine)) / 1000;
    now.rock = (s.at(row, rock) - s.at(first[*cycle], rock)) / 1000;
    now.dissipated = now.work - now.machine - now.rock;
    balance.push_back(now);
  }
  return balances;
}

std::vector<EnergyBalance> energy_balance_by_cycle(const LoadingLog& log) {
  std::vector<EnergyBalance> ends;
  for (const auto& balance : energy_balances(log))
    ends.push_back(balance.empty() ? EnergyBalance{} : balance.back());
  return ends;
}

}  // namespace drawpoint::engine::loading
