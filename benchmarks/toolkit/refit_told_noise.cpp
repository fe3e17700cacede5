// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// refit_told_noise JUDGE_DB STUDY_DB...: what it is worth for stored studies that their runs tell their
/// standard errors. The models of each study as its commands fit them, and as they would without what the runs
/// tell, judged by the validation runs of JUDGE_DB, which was made with the same options: per response and way
/// the noise of a run [unit of the response], the error over the range of the validation runs, and how many of
/// these lie within their 95 % interval.

#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <drawpoint/studies/run/store/store.h>

#include <cstdio>
#include <exception>
#include <string>

namespace {

using namespace drawpoint;
using namespace drawpoint::studies;

Tables read(const std::string& file) {
  const Store store = Store::open(file);
  return tables_of(store.runs(), store.identity().problem);
}

/// The same runs, of which nobody knows the standard errors.
Tables untold(Tables tables) {
  for (doe::Evaluations* runs : {&tables.training, &tables.validation})
    for (doe::Response& response : runs->problem.responses) response.forget_standard_error();
  return tables;
}

void print(const std::string& name, const char* noise, const Tables& tables, const doe::Problem& problem) {
  const Models fitted = fit_models(tables);
  for (std::size_t j = 0; j < fitted.validations.size(); ++j) {
    if (doe::is_standard_error(problem, j)) continue;
    const kriging::Validation& v = fitted.validations[j];
    std::printf(
        "| %s | %s | %s | %s | %.4g | %.3f | %ld of %ld |\n", name.c_str(), problem.responses[j].name.c_str(),
        noise, fitted.ways[j].c_str(), std::sqrt(kriging::modelled_noise(v, 1).variance), v.nrmse,
        static_cast<long>(count_within(v, problem.responses[j])), static_cast<long>(v.observed.size()));
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: refit_told_noise JUDGE_DB STUDY_DB..., each the study.db of a study\n");
    return 2;
  }
  try {
    const Tables judge = read(argv[1]);
    std::printf(
        "| study | response | noise | way | noise of a run | NRMSE | within "
        "|\n|---|---|---|---|---|---|---|\n");
    for (int k = 2; k < argc; ++k) {
      Tables tables = read(argv[k]);
      tables.validation = judge.validation;
      const doe::Problem problem = tables.training.problem;
      print(argv[k], "told", tables, problem);
      print(argv[k], "estimated", untold(tables), problem);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
