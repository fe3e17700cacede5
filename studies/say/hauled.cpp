// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/hauls.h>
#include <drawpoint/studies/say/hauled.h>

#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

constexpr double same_rate = 1e-6;  // of the response: the sum may be taken in another order

/// Throws where the cycles are not those of the run.
WorkOfRun work_of(const Run& run, const CycleWork& cycles, const doe::Problem& problem) {
  const double stored = run.y[doe::response_index(problem, cycles.rate)];
  if (cycles.loads.empty() || cycles.loads.size() != cycles.seconds.size())
    throw std::invalid_argument("it has " + std::to_string(cycles.loads.size()) + " loads and " +
                                std::to_string(cycles.seconds.size()) + " times of cycles");
  WorkOfRun work{run.id, run.x, cycles.loads, cycles.seconds};
  const double rate = work.rate(cycles.haul);
  if (!(std::abs(rate - stored) <= same_rate * std::abs(stored)))
    throw std::invalid_argument("its cycles give " + cycles.rate + " " + doe::detail::number_text(rate) +
                                ", stored is " + doe::detail::number_text(stored));
  return work;
}

}  // namespace

void add_hauls(ReportInput& input, const Study& study, const std::vector<const Run*>& logged,
               const OptionValues& options, const Folder& folder) {
  if (!study.logs.cycles || logged.empty()) return;
  std::vector<WorkOfRun> work;
  CycleWork last;
  std::string why;
  int lost = 0;
  for (const Run* run : logged) {
    try {
      last = study.logs.cycles(folder.log(run->id), options);
      work.push_back(work_of(*run, last, study.problem));
    } catch (const std::exception& e) {
      if (lost++ == 0) why = "run " + std::to_string(run->id) + ": " + e.what();
    }
  }
  if (lost > 0)
    input.warnings.push_back("What other hauls would change is said without " + std::to_string(lost) +
                             " of " + std::to_string(logged.size()) + " runs, the first being " + why + ".");
  if (work.empty()) return;
  input.hauls = choice_of_haul(input, last.rate, last.haul, work);
}

}  // namespace drawpoint::studies
