// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <unistd.h>
#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/kriging/save.hpp>
#include <drawpoint/kriging/save_fidelities.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/saved_text.hpp>
#include <functional>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const MatrixXd X = reference::design(12, 2, 3), runs = reference::design(7, 2, 4);

double rough(const VectorXd& x) { return std::sin(4 * x[0]) + x[1]; }
double fine(const VectorXd& x) { return 2 * rough(x) + x[0] * x[1]; }

FidelityModel with(const std::function<void(FitOptions&)>& change, const FidelityOptions& options = {}) {
  std::vector<FidelityLevel> levels{{"rough", X, reference::values(rough, X)},
                                    {"fine", runs, reference::values(fine, runs)}};
  for (FidelityLevel& level : levels) {
    change(level.options);
    if (level.options.noise != Noise::nugget)
      level.options.noise_variance = VectorXd::LinSpaced(level.y.size(), 0.001, 0.004);
  }
  return fit_fidelities(levels, options);
}

std::vector<FidelityModel> all_kinds() {
  return {with([](FitOptions&) {}),
          with([](FitOptions& o) { o.correlation = Correlation::power_exponential; }),
          with([](FitOptions& o) { o.trend = Trend::linear; }, {.compare = false}),
          with([](FitOptions& o) { o.noise = Noise::known; }, {.rho = Trend::linear}),
          with([](FitOptions& o) { o.parameter_uncertainty = false; })};
}

std::string refusal(const std::string& text) {
  return support::refusal_of([](const std::string& saved) { fidelities_from_text(saved); }, text);
}

std::string rewritten(const std::function<void(nlohmann::json&)>& change) {
  return support::with_checksum(to_text(all_kinds()[0]), change);
}

}  // namespace

TEST(SavedFidelities, PredictTheSameBits) {
  const MatrixXd points = reference::design(40, 2, 5);
  for (const FidelityModel& model : all_kinds()) {
    const FidelityModel back = fidelities_from_text(to_text(model));
    EXPECT_EQ(back.predict(points).mean, model.predict(points).mean) << model.message();
    EXPECT_EQ(back.predict(points, Target::observation).variance,
              model.predict(points, Target::observation).variance);
    EXPECT_EQ(back.gradient(points.row(0)).variance, model.gradient(points.row(0)).variance);
    EXPECT_EQ(back.message(), model.message());
    EXPECT_EQ(back.report().levels[1].rho, model.report().levels[1].rho);
    EXPECT_EQ(leave_one_out(back).predicted, leave_one_out(model).predicted);
    EXPECT_EQ(to_text(back), to_text(model));
  }
}

TEST(SavedFidelities, GoThroughAFile) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("drawpoint_fidelities_" + std::to_string(::getpid()) + ".json");
  const FidelityModel model = all_kinds()[0];
  save(model, path);
  EXPECT_EQ(load_fidelities(path).mean(X), model.mean(X));
  EXPECT_THROW(load(path), std::runtime_error) << "it is no model of one level";
  std::filesystem::remove(path);
  EXPECT_THROW(load_fidelities(path), std::runtime_error);
}

// The law: no byte may differ. One bit of each byte in turn, another bit each time.
TEST(SavedFidelities, AreRefusedWithAnyByteChanged) {
  const std::string text = to_text(all_kinds()[0]);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i * 5 + 3) % 8));
    EXPECT_NE(refusal(changed), "accepted") << "byte " << i << " of " << text.size();
  }
}

TEST(SavedFidelities, FaultsAreNamedWithTheirPlace) {
  const std::string end = "; the file is damaged or of another kind: save the model again";
  EXPECT_EQ(refusal(to_text(fit(X, reference::values(rough, X)))),
            "kriging::load: the text: format: it is not \"drawpoint co-kriging model\"" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["levels"][1]["correlation"]["theta"][1] = "inf"; })),
            "kriging::load: the text: model/levels[1]/correlation/theta[1]: it is not finite" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["levels"] = nlohmann::json::array(); })),
            "kriging::load: the text: model/levels: it is no list of levels" + end);
  EXPECT_EQ(
      refusal(rewritten([](auto& f) { f["model"]["levels"][0]["rho"] = f["model"]["levels"][1]["rho"]; })),
      "kriging::load: the text: model/levels[0]: it has rho, but no level below" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["levels"][1]["process_variance"] = -1.0; })),
            "kriging::load: the text: model/levels[1]/process_variance: it is not positive" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"].erase("nothing"); })), "accepted")
      << "the rewriting is sound";
}

TEST(SavedFidelities, FunctionsOfTheUserAreRefused) {
  FidelityLevel cheap{"rough", X, reference::values(rough, X)};
  cheap.options.trend = Trend::user;
  cheap.options.basis.values = [](const VectorXd& x) -> VectorXd { return Eigen::Vector2d(1.0, x[0]); };
  const FidelityModel model =
      fit_fidelities({cheap, {"fine", runs, reference::values(fine, runs)}}, {.compare = false});
  EXPECT_THROW(to_text(model), std::invalid_argument);
}

TEST(SavedFidelities, KeepCategories) {
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, 4};
  const categories::Runs cheap = categories::runs(categories::scrambled, 24, 3),
                         few = categories::runs(categories::idle, 12, 4);
  const FidelityModel model = fit_fidelities(
      {{"rough", cheap.X, cheap.y, options}, {"fine", few.X, few.y, options}}, {.compare = false});
  const FidelityModel again = fidelities_from_text(to_text(model));
  const MatrixXd Z = categories::points(10, 4, 2);
  EXPECT_EQ(model.predict(Z).variance, again.predict(Z).variance);
  EXPECT_EQ(nlohmann::json::parse(to_text(model))["version"], 2);
  EXPECT_NE(refusal(support::with_checksum(to_text(model), [](auto& file) { file["version"] = 1; })),
            "accepted");
}
