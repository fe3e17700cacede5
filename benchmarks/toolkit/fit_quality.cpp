// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// fit_quality: are fits right, and do they know how wrong they are? See the help text.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/benchmarks/toolkit/cpu_time.hpp>
#include <drawpoint/benchmarks/toolkit/median.hpp>
#include <drawpoint/benchmarks/toolkit/table_options.hpp>
#include <drawpoint/benchmarks/toolkit/unit_box.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <drawpoint/tests/kriging/wide_functions.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace drawpoint;
using namespace drawpoint::kriging;
using benchmarks::median;
using benchmarks::unit_box;

constexpr const char* help =
    R"(Fits the functions of tests/kriging/test_functions.hpp, and those of wide_functions.hpp that are
asked for by name, on several designs and says how far the predictions are off and how often their intervals
hold 500 new observations.

  fit_quality
  fit_quality --functions friedman5,waves5 --designs corners --runs 60
  fit_quality --runs 40 --noise 0.01 --ways default,expect-none
  fit_quality --functions sum10,pairs10 --runs 30,50 --designs latin --ways default,isotropic,additive
  fit_quality --runs 50,100 --write cases     # for the same table of another library

One row per function, design, number of runs and way to fit; medians over the seeds. NRMSE is the error of the
mean against the function without noise, over the range of it (over the noise where the function is 0), `worst`
its largest. Then the per cent of the function's values within the 95 % intervals of the mean (`latent`) and of
new observations, noise included, within the central 50, 80 and 95 % intervals of a run, the noise that was found
over the true one (without noise: over the range), CPU seconds per fit, how many fits did not converge, and how
many took half of the variance of the noise or more for signal.

Ways: `default`; `plug-in`, the same with its parameters taken as known; `likeliest`, plain maximum likelihood
with its parameters taken as known; `expect-none`, the default with nugget_power 0, which expects no noise;
`none`, runs known to be exact; `linear`, the default with a linear trend; `chosen`, the one that
kriging::choose_fit takes of Gaussian and Matern 5/2 with constant and linear trend, as studies do; `isotropic` and
`additive`, the default with these correlations.

Designs: `latin`, a random Latin hypercube; `maximin`, an optimised one; `lattice`, the same from a lattice
where that lies farther apart; `discrepancy`, optimised by centred discrepancy; `corners`, maximin with the 2^d
corners in it, left out where these are more than 8 in 10 runs; `sobol`, scrambled.)";

struct Way {
  std::string name;
  RunFitter fitter;
};

Way fit_with(std::string name, const FitOptions& options) {
  return {std::move(name),
          [options](const Eigen::MatrixXd& X, const Eigen::VectorXd& y) { return fit(X, y, options); }};
}

/// As a study fits a response without a range.
TransformedModel chosen_fit(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  std::vector<WayToFit> all;
  for (const FitOptions& options : usual_kinds())
    all.push_back(way_with_noise("", Scale::linear, {}, options, NoiseSource::estimated));
  return choose_fit(X, y, {}, all).model;
}

std::vector<Way> ways() {
  FitOptions plug_in, likeliest, expect_none, none, linear, isotropic, additive;
  plug_in.parameter_uncertainty = likeliest.parameter_uncertainty = false;
  likeliest.estimation = Estimation::maximum_likelihood;
  expect_none.nugget_power = 0;
  none.noise = Noise::none;
  linear.trend = Trend::linear;
  isotropic.structure = Structure::isotropic;
  additive.structure = Structure::additive;
  return {fit_with("default", {}),          fit_with("plug-in", plug_in),
          fit_with("likeliest", likeliest), fit_with("expect-none", expect_none),
          fit_with("none", none),           fit_with("linear", linear),
          {"chosen", chosen_fit},           fit_with("isotropic", isotropic),
          fit_with("additive", additive)};
}

/// All that can be asked for by name.
std::vector<reference::TestFunction> functions() {
  std::vector<reference::TestFunction> all = reference::test_functions();
  for (const reference::TestFunction& f : reference::wide_functions()) all.push_back(f);
  return all;
}

Eigen::MatrixXd design(const std::string& kind, int variables, int runs, doe::Seed seed) {
  if (kind == "latin") return reference::design(runs, variables, seed);
  const doe::Problem problem = unit_box(variables);
  if (kind == "sobol") return doe::scrambled_sobol(problem, runs, {.seed = seed});
  doe::OptimizedLatinOptions options{.seed = seed, .corners = kind == "corners"};
  if (kind == "lattice") options.start = doe::LatinStart::best;
  if (kind == "discrepancy") options.criterion = doe::LatinCriterion::centred_discrepancy;
  return doe::optimized_latin_hypercube(problem, runs, options);
}

bool too_many_corners(const std::string& kind, int variables, int runs) {
  return kind == "corners" && 10 * (1LL << variables) > 8LL * runs;
}

/// Runs to fit and new points, with and without noise.
struct Case {
  Eigen::MatrixXd X, Z;
  Eigen::VectorXd y, truth, observed;
  double noise = 0;
};

Eigen::VectorXd values(const reference::TestFunction& f, const Eigen::MatrixXd& X, doe::Seed draw) {
  return reference::values([&](const Eigen::VectorXd& x) { return f.value(x, draw); }, X);
}

Eigen::VectorXd with_noise(const Eigen::VectorXd& y, double deviation, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::VectorXd noisy = y;
  for (double& value : noisy) value += deviation * random.normal();
  return noisy;
}

double deviation(const Eigen::VectorXd& y) { return std::sqrt((y.array() - y.mean()).square().mean()); }

/// `share`: noise of functions without any, over their deviation.
Case make_case(const reference::TestFunction& f, const std::string& kind, int runs, doe::Seed seed,
               double share) {
  Case c{design(kind, f.variables, runs, seed), reference::design(500, f.variables, 1000 + seed), {}, {}, {}};
  c.truth = values(f, c.Z, seed);
  c.noise = f.noise > 0 ? f.noise : share * deviation(c.truth);
  c.y = with_noise(values(f, c.X, seed), c.noise, 2000 + seed);
  c.observed = with_noise(c.truth, c.noise, 3000 + seed);
  return c;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What the seeds gave.
struct Row {
  std::vector<double> nrmse, noise, seconds, latent, coverage[3];
  int unsettled = 0, misled = 0;  ///< misled: by noise, half of which or more they follow
};

/// Per cent of the function's values within the 95 % intervals of the mean.
double latent_coverage(const Model& model, const Case& c) {
  const Prediction p = model.predict(c.Z);
  const auto held = ((p.mean - c.truth).array().abs() <= 1.96 * p.variance.array().sqrt()).count();
  return 100.0 * static_cast<double>(held) / static_cast<double>(c.truth.size());
}

void add(Row& row, const Case& c, const Way& way) {
  const double start = benchmarks::cpu_seconds();
  const TransformedModel model = way.fitter(c.X, c.y);
  row.seconds.push_back(benchmarks::cpu_seconds() - start);
  if (model.status() != Status::converged) ++row.unsettled;
  const Validation v = validate(model, c.Z, c.observed);
  const double range = c.truth.maxCoeff() - c.truth.minCoeff(), unit = range > 0 ? range : c.noise;
  row.nrmse.push_back(std::sqrt((v.predicted - c.truth).squaredNorm() / static_cast<double>(c.truth.size())) /
                      unit);
  row.noise.push_back(std::sqrt(model.noise_variance()) / (c.noise > 0 ? c.noise : unit));
  if (model.noise_variance() < 0.5 * c.noise * c.noise) ++row.misled;
  row.latent.push_back(latent_coverage(model.model(), c));
  const double levels[] = {0.5, 0.8, 0.95};
  for (int k = 0; k < 3; ++k) row.coverage[k].push_back(100.0 * score(v, ErrorFunction::coverage, levels[k]));
}

void print(const std::string& place, const std::string& way, const Row& row) {
  std::printf("%s %-11s %9.5f %9.5f  %6.1f %5.1f %5.1f %5.1f  %7.4f %7.3f %4d %6d\n", place.c_str(),
              way.c_str(), median(row.nrmse), *std::max_element(row.nrmse.begin(), row.nrmse.end()),
              median(row.latent), median(row.coverage[0]), median(row.coverage[1]), median(row.coverage[2]),
              median(row.noise), median(row.seconds), row.unsettled, row.misled);
  std::fflush(stdout);
}

void write_table(const std::filesystem::path& path, const Eigen::MatrixXd& X,
                 const std::vector<Eigen::VectorXd>& columns) {
  std::ofstream file(path);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    std::string line;
    for (const double value : X.row(i)) line += doe::detail::number_text(value) + ",";
    for (const Eigen::VectorXd& column : columns) line += doe::detail::number_text(column[i]) + ",";
    line.back() = '\n';
    file << line;
  }
  if (!file.flush())
    throw std::runtime_error("fit_quality: cannot write " + path.string() + "; choose another --write");
}

const std::vector<std::string> kinds{"latin", "maximin", "lattice", "discrepancy", "corners", "sobol"};

struct Settings {
  std::vector<std::string> ways{"default", "plug-in", "likeliest"}, functions,
      designs{"latin", "maximin", "corners", "sobol"};
  std::vector<int> runs{50, 100, 200};
  int seeds = 11;
  double noise = 0;
  std::string folder;
};

void measure(const Settings& settings, const reference::TestFunction& f, const std::string& kind, int runs) {
  std::vector<Row> rows(ways().size());
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    const Case c = make_case(f, kind, runs, static_cast<doe::Seed>(seed), settings.noise);
    if (!settings.folder.empty()) {
      const std::string stem = settings.folder + "/" + f.name + "-" + kind + "-" + std::to_string(runs) +
                               "-" + std::to_string(seed);
      write_table(stem + "-train.csv", c.X, {c.y});
      write_table(stem + "-test.csv", c.Z, {c.truth, c.observed});
      continue;
    }
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (contains(settings.ways, ways()[k].name)) add(rows[k], c, ways()[k]);
  }
  if (!settings.folder.empty()) return;
  char place[64];
  std::snprintf(place, sizeof place, "%-12s %-8s %4d", f.name.c_str(), kind.c_str(), runs);
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!rows[k].nrmse.empty()) print(place, ways()[k].name, rows[k]);
}

Settings settings_of(int argc, char** argv) {
  Settings settings;
  std::vector<std::string> names, usual;
  for (const reference::TestFunction& f : functions()) names.push_back(f.name);
  for (const reference::TestFunction& f : reference::test_functions()) usual.push_back(f.name);
  CLI::App app(help);
  app.add_option("--functions", settings.functions,
                 "of the list, with commas between (default: those of test_functions.hpp)")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--designs", settings.designs, "with commas between")
      ->delimiter(',')
      ->check(CLI::IsMember(kinds))
      ->capture_default_str();
  app.add_option("--ways", settings.ways, "with commas between")
      ->delimiter(',')
      ->check(CLI::IsMember(
          {"default", "plug-in", "likeliest", "expect-none", "linear", "chosen", "isotropic", "additive"}))
      ->capture_default_str();
  app.add_option("--runs", settings.runs, "of a design")
      ->delimiter(',')
      ->check(CLI::Range(10, 2000))
      ->capture_default_str();
  app.add_option("--seeds", settings.seeds, "designs of each kind")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--noise", settings.noise, "of functions that have none, over their standard deviation")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--write", settings.folder, "write the cases to FOLDER as CSV instead of fitting them");
  benchmarks::parse_or_exit(app, argc, argv);
  if (settings.functions.empty()) settings.functions = usual;
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = settings_of(argc, argv);
  try {
    if (!settings.folder.empty())
      std::filesystem::create_directories(settings.folder);
    else
      std::printf("%-12s %-8s %4s %-11s %9s %9s  %6s %5s %5s %5s  %7s %7s %4s %6s\n", "function", "design",
                  "runs", "way", "NRMSE", "worst", "latent", "50 %", "80 %", "95 %", "noise", "CPU s", "not",
                  "misled");
    for (const reference::TestFunction& f : functions())
      if (contains(settings.functions, f.name))
        for (const std::string& kind : settings.designs)
          for (const int runs : settings.runs)
            if (!too_many_corners(kind, f.variables, runs)) measure(settings, f, kind, runs);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
