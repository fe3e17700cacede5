// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <unistd.h>
#include <drawpoint/kriging/fit_nearest.hpp>
#include <drawpoint/kriging/save_nearest.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/saved_text.hpp>
#include <functional>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

NearestModel nearest_with(const std::function<void(FitOptions&)>& change) {
  const MatrixXd X = categories::points(200, 4, 3);
  VectorXd y(200);
  for (Eigen::Index i = 0; i < 200; ++i)
    y[i] = categories::scrambled(X(i, 0), X(i, 1), static_cast<int>(X(i, 2)));
  FitOptions options;
  options.threads = 2;
  change(options);
  if (options.noise != Noise::nugget) options.noise_variance = VectorXd::LinSpaced(200, 0.001, 0.004);
  return fit_nearest(X, y, options, {.neighbours = 40, .neighbourhood = 40});
}

std::vector<NearestModel> nearest_kinds() {
  return {nearest_with([](FitOptions&) {}),
          nearest_with([](FitOptions& o) {
            o.levels = {0, 0, 4};
          }),
          nearest_with([](FitOptions& o) { o.structure = Structure::isotropic; }),
          nearest_with([](FitOptions& o) { o.trend = Trend::quadratic; }),
          nearest_with([](FitOptions& o) { o.noise = Noise::known; }),
          fit_nearest(categories::points(5, 4, 3), VectorXd::Constant(5, 2.0))};
}

std::string nearest_fault(const std::function<void(nlohmann::json&)>& change) {
  static const std::string saved_text = to_text(nearest_with([](FitOptions&) {}));
  const std::string text = support::with_checksum(saved_text, change);
  return support::refusal_of([](const std::string& saved) { nearest_from_text(saved); }, text);
}

}  // namespace

TEST(SavedNearest, PredictTheSameBits) {
  const MatrixXd points = categories::points(40, 4, 5);
  for (const NearestModel& model : nearest_kinds()) {
    const NearestModel back = nearest_from_text(to_text(model));
    EXPECT_EQ(back.predict(points).mean, model.predict(points).mean) << model.message();
    EXPECT_EQ(back.predict(points, Target::observation).variance,
              model.predict(points, Target::observation).variance);
    EXPECT_EQ(back.mean_gradient(points.row(0)), model.mean_gradient(points.row(0)));
    EXPECT_EQ(back.error().mean, model.error().mean);
    EXPECT_EQ(to_text(back), to_text(model));
  }
}

TEST(SavedNearest, GoThroughAFile) {
  const auto path =
      std::filesystem::temp_directory_path() / ("drawpoint_nearest_" + std::to_string(::getpid()) + ".json");
  const NearestModel model = nearest_with([](FitOptions&) {});
  save(model, path);
  const MatrixXd points = categories::points(7, 4, 5);
  EXPECT_EQ(load_nearest(path).mean(points), model.mean(points));
  EXPECT_THROW(load(path), std::runtime_error) << "it is no model of all runs";
  std::filesystem::remove(path);
  EXPECT_THROW(load_nearest(path), std::runtime_error);
}

TEST(SavedNearest, RefuseWhatIsNoModel) {
  EXPECT_EQ(
      nearest_fault([](auto& j) { j["model"]["neighbourhood"] = 7; }),
      "kriging::load: the text: model/neighbourhood: it is below 8; the file is damaged or of another kind: "
      "save the model again");
  EXPECT_NE(nearest_fault([](auto& j) { j["model"]["runs"]["X"]["rows"] = 3; }).find("model/runs/X"),
            std::string::npos);
  EXPECT_NE(nearest_fault([](auto& j) { j["model"]["solution"].erase("T"); }).find("\"T\" is missing"),
            std::string::npos);
}

TEST(SavedNearest, ATrendOfTheUserIsRefused) {
  const NearestModel model = nearest_with([](FitOptions& o) {
    o.trend = Trend::user;
    o.basis.values = [](const VectorXd& x) { return VectorXd(Eigen::Vector2d(1.0, x[0])); };
  });
  EXPECT_THROW(to_text(model), std::invalid_argument);
}
