// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <unistd.h>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/kriging/save.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/saved_text.hpp>
#include <drawpoint/tests/kriging/structures.hpp>
#include <functional>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const MatrixXd X = reference::design(9, 2, 3);

VectorXd response() {
  VectorXd y = reference::values([](const VectorXd& x) { return std::sin(4 * x[0]) + x[1]; }, X);
  doe::RandomStream random(6);
  for (double& value : y) value += 0.05 * random.normal();
  return y;
}

Model with(const std::function<void(FitOptions&)>& change) {
  FitOptions options;
  change(options);
  return fit(X, response(), options);
}

// One of each kind of state.
std::vector<Model> all_kinds() {
  return {with([](FitOptions&) {}),
          with([](FitOptions& o) { o.correlation = Correlation::matern52, o.trend = Trend::linear; }),
          with([](FitOptions& o) { o.correlation = Correlation::power_exponential; }),
          with([](FitOptions& o) { o.correlation = Correlation::matern32, o.trend = Trend::blind; }),
          with([](FitOptions& o) {
            o.noise = Noise::known, o.noise_variance = VectorXd::LinSpaced(9, 0.001, 0.004);
          }),
          append(with([](FitOptions&) {}), reference::design(3, 2, 8), Eigen::Vector3d(0.1, 0.2, 0.4)),
          reinterpolated(with([](FitOptions&) {})),
          fit(X, VectorXd::Constant(9, 2.5)),
          fit(X.topRows(1), VectorXd::Constant(1, 2.5))};
}

std::string refusal(const std::string& text) {
  return support::refusal_of([](const std::string& saved) { from_text(saved); }, text);
}

std::string rewritten(const std::function<void(nlohmann::json&)>& change) {
  return support::with_checksum(to_text(all_kinds()[0]), change);
}

}  // namespace

// Means, variances, gradients and the text itself: the same bits.
TEST(SavedModel, PredictsTheSameBits) {
  const MatrixXd points = reference::design(40, 2, 5);
  for (const Model& model : all_kinds()) {
    const Model back = from_text(to_text(model));
    EXPECT_EQ(back.predict(points).mean, model.predict(points).mean) << model.message();
    EXPECT_EQ(back.predict(points, Target::observation).variance,
              model.predict(points, Target::observation).variance);
    EXPECT_EQ(back.mean(points), model.mean(points));
    EXPECT_EQ(back.gradient(points.row(0)).mean, model.gradient(points.row(0)).mean);
    EXPECT_EQ(back.covariance(points.topRows(3)), model.covariance(points.topRows(3)));
    EXPECT_EQ(back.log_likelihood(), model.log_likelihood());
    EXPECT_EQ(back.message(), model.message());
    EXPECT_EQ(back.status(), model.status());
    EXPECT_EQ(to_text(back), to_text(model));
  }
}

// By count, so that an enumerator that to_string forgets fails here too.
TEST(SavedModel, EveryEnumeratorReadsBack) {
  const auto read_back = [](auto first, int count) {
    using Enum = decltype(first);
    for (int k = 0; k < count; ++k) {
      const auto value = static_cast<Enum>(k);
      EXPECT_EQ(doe::detail::enumerator_of<Enum>(to_string(value)), value) << to_string(value);
    }
    EXPECT_EQ(to_string(static_cast<Enum>(count)), "unknown");
    EXPECT_FALSE(doe::detail::enumerator_of<Enum>("unknown"));
  };
  read_back(Status::converged, 6);
  read_back(Correlation::gaussian, 4);
  read_back(Structure::product, 3);
}

TEST(SavedModel, CanBeAppendedTo) {
  const Model model = all_kinds()[0], back = from_text(to_text(model));
  const MatrixXd more = reference::design(2, 2, 11);
  const VectorXd y = Eigen::Vector2d(0.3, 0.7);
  EXPECT_EQ(append(back, more, y).mean(X), append(model, more, y).mean(X));
}

TEST(SavedModel, GoesThroughAFile) {
  const auto path =
      std::filesystem::temp_directory_path() / ("drawpoint_model_" + std::to_string(::getpid()) + ".json");
  const Model model = all_kinds()[0];
  save(model, path);
  EXPECT_EQ(load(path).mean(X), model.mean(X));
  std::filesystem::remove(path);
  try {
    load(path);
    ADD_FAILURE();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(e.what(),
              "kriging::load: cannot read \"" + path.string() + "\"; check that it exists and is readable");
  }
}

// The law: no byte may differ. One bit of each byte in turn, another bit each time, and every cut.
TEST(SavedModel, IsRefusedWithAnyByteChanged) {
  const std::string text = to_text(all_kinds()[0]);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i * 5 + 3) % 8));
    EXPECT_NE(refusal(changed), "accepted") << "byte " << i << " of " << text.size();
  }
}

TEST(SavedModel, IsRefusedWhenCutOrLengthened) {
  const std::string text = to_text(all_kinds()[0]);
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_NE(refusal(text.substr(0, size)), "accepted") << size << " of " << text.size();
  for (const char* more : {" ", "\n", "0", "{}"}) EXPECT_NE(refusal(text + more), "accepted");
}

TEST(SavedModel, FaultsAreNamedWithTheirPlace) {
  const std::string end = "; the file is damaged or of another kind: save the model again";
  EXPECT_EQ(refusal("{"), "kriging::load: the text: it is no JSON, or not all of it" + end);
  EXPECT_EQ(refusal("[1]"), "kriging::load: the text: \"format\" is missing" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["version"] = 1; })),
            "kriging::load: the text: version: it is 1; allowed is 2, or 3 with categories, or 4 with a "
            "structure, or 5 "
            "with two explanations" +
                end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["correlation"]["theta"][1] = "inf"; })),
            "kriging::load: the text: model/correlation/theta[1]: it is not finite" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["runs"]["X"]["values"].push_back(1.0); })),
            "kriging::load: the text: model/runs/X/values: it has 19 entries; allowed is 18" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["runs"]["X"]["rows"] = 1000000000; })),
            "kriging::load: the text: model/runs/X: it is not 9 x 2" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["factor"][0] = -1.0; })),
            "kriging::load: the text: model/factor: its diagonal is not positive" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"]["correlation"]["family"] = "cubic"; })),
            "kriging::load: the text: model/correlation/family: \"cubic\" is unknown" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) {
              f["model"]["trend"][0] = {5, -1};
            })),
            "kriging::load: the text: model/trend: a term names input 5 of 2" + end);
  EXPECT_EQ(refusal(rewritten([](auto& f) { f["model"].erase("nothing"); })), "accepted")
      << "the rewriting is sound";
  std::string spaced = to_text(all_kinds()[0]);
  spaced.insert(1, " ");
  EXPECT_EQ(refusal(spaced), "kriging::load: the text: it is not as it was written" + end);
}

TEST(SavedModel, FunctionsOfTheUserAreRefused) {
  FitOptions options;
  options.trend = Trend::user;
  options.basis.values = [](const VectorXd& x) -> VectorXd { return Eigen::Vector2d(1.0, x[0]); };
  const Model model = fit(X, response(), options);
  try {
    to_text(model);
    ADD_FAILURE();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(
        e.what(),
        "kriging::save: the trend is a function of the user, which no file can hold; allowed are polynomial "
        "trends; save the runs and fit again");
  }
}

// Isotropic and additive correlations are kept, beside categories and exponents too; their version is one
// that readers of products refuse.
TEST(SavedModel, KeepsStructures) {
  const std::string end = "; the file is damaged or of another kind: save the model again";
  for (const Structure structure : structures::others)
    for (const Correlation family : {Correlation::gaussian, Correlation::power_exponential}) {
      const structures::Reference r = structures::some_runs(structure, family);
      FitOptions options = structures::options_of(r);
      options.may_be_exact = false;  // two explanations have a version of their own
      const Model model = fit(r.X, r.y, options), again = from_text(to_text(model));
      EXPECT_EQ(model.predict(r.X).mean, again.predict(r.X).mean);
      EXPECT_EQ(model.predict(r.X).variance, again.predict(r.X).variance);
      EXPECT_EQ(model.gradient(r.X.row(1)).variance, again.gradient(r.X.row(1)).variance);
      EXPECT_EQ(to_text(again), to_text(model));
      EXPECT_EQ(nlohmann::json::parse(to_text(model))["version"], 4);
      const auto after = [&](const std::function<void(nlohmann::json&)>& change) {
        return refusal(support::with_checksum(to_text(model), change));
      };
      EXPECT_EQ(after([](auto& f) { f["version"] = 3; }),
                "kriging::load: the text: version: it is not that of the model" + end);
      EXPECT_EQ(after([](auto& f) { f["model"]["correlation"]["structure"] = "sum"; }),
                "kriging::load: the text: model/correlation/structure: \"sum\" is unknown" + end);
      if (structure != Structure::additive) continue;
      EXPECT_EQ(after([](auto& f) {
                  f["model"]["correlation"]["weights"] = {0.5, 0.6, -0.1};
                }),
                "kriging::load: the text: model/correlation/weights: they are not shares of 1" + end);
    }
}

// Categories are kept; their version is one higher, which readers that know none refuse.
TEST(SavedModel, KeepsCategories) {
  const categories::Runs runs = categories::runs(categories::scrambled, 16, 5);
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, 4};
  options.may_be_exact = false;
  const Model model = fit(runs.X, runs.y, options), again = from_text(to_text(model));
  const Eigen::MatrixXd Z = categories::points(10, 4, 2);
  EXPECT_EQ(model.predict(Z).mean, again.predict(Z).mean);
  EXPECT_EQ(model.predict(Z).variance, again.predict(Z).variance);
  EXPECT_EQ(to_text(again), to_text(model));
  EXPECT_EQ(nlohmann::json::parse(to_text(model))["version"], 3);
  const auto after = [&](const std::function<void(nlohmann::json&)>& change) {
    return refusal(support::with_checksum(to_text(model), change));
  };
  const std::string end = "; the file is damaged or of another kind: save the model again";
  EXPECT_EQ(after([](auto& f) { f["version"] = 2; }),
            "kriging::load: the text: version: it is not that of the model" + end);
  EXPECT_EQ(after([](auto& f) {
              f["model"]["correlation"]["categories"] = {0, 0, 1};
            }),
            "kriging::load: the text: model/correlation/categories: it does not fit 3 inputs" + end);
  EXPECT_EQ(after([](auto& f) {
              f["model"]["correlation"]["categories"] = {0, 0, 3};
            }),
            "kriging::load: the text: model/runs/X: it holds what is no level of a category" + end);
}
