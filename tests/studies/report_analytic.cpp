// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/studies/model/fits/surface.h>
#include <drawpoint/studies/model/fits/surface_error.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/say/page/panels.h>
#include <drawpoint/studies/say/page/report_summary.h>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/tests/studies/report_cases.hpp>

#include <Eigen/Cholesky>

using namespace drawpoint;
using namespace drawpoint::studies;
using namespace drawpoint::studies::report_cases;

namespace {

/// What say/page/web/kriging.js computes.
double correlation_of_page(const kriging::CorrelationFunction& f, Eigen::Index k, double h) {
  const double theta = f.theta[k];
  if (f.family == kriging::Correlation::gaussian) return std::exp(-theta * h * h);
  if (f.family == kriging::Correlation::power_exponential)
    return std::exp(-theta * std::pow(h, f.exponent[k]));
  const bool once = f.family == kriging::Correlation::matern32;
  const double u = std::sqrt((once ? 6.0 : 10.0) * theta) * h;
  return (1.0 + u + (once ? 0.0 : u * u / 3.0)) * std::exp(-u);
}

double distance_of_page(const detail::Surface& s, Eigen::Index k, double a, double b) {
  const std::vector<int>& levels = s.correlation.levels;
  if (!levels.empty() && levels[static_cast<std::size_t>(k)] > 0) return std::round(a) == b ? 0.0 : 2.0;
  return std::abs(a - b);
}

double formula_of_page(const detail::Surface& s, const Eigen::VectorXd& x) {
  const Eigen::VectorXd at = (x - s.centre).cwiseProduct(s.factor);
  double mean = s.constant;
  for (std::size_t t = 0; t < s.terms.size(); ++t)
    mean += s.coefficients[static_cast<Eigen::Index>(t)] * s.terms[t].at(at);
  for (Eigen::Index i = 0; i < s.X.rows(); ++i) {
    double c = 1.0;
    for (Eigen::Index k = 0; k < x.size(); ++k)
      c *= correlation_of_page(s.correlation, k, distance_of_page(s, k, at[k], s.X(i, k)));
    mean += s.weights[i] * c;
  }
  if (s.transform.scale == kriging::Scale::linear) return mean;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < s.noise.size(); ++k)
    sum += s.noise_weights[k] * kriging::back_transformed(s.transform, mean + s.noise[k]);
  return sum;
}

double product_of_page(const detail::Surface& s, const Eigen::VectorXd& a, const Eigen::VectorXd& run) {
  double c = 1.0;
  for (Eigen::Index k = 0; k < a.size(); ++k)
    c *= correlation_of_page(s.correlation, k, distance_of_page(s, k, a[k], run[k]));
  return c;
}

/// ∂ln c/∂ln θ of say/page/web/kriging_error.js.
double slope_of_page(const kriging::CorrelationFunction& f, Eigen::Index k, double h) {
  const double theta = f.theta[k];
  if (f.family == kriging::Correlation::gaussian) return -theta * h * h;
  if (f.family == kriging::Correlation::power_exponential) return -theta * std::pow(h, f.exponent[k]);
  const bool once = f.family == kriging::Correlation::matern32;
  const double u = std::sqrt((once ? 6.0 : 10.0) * theta) * h;
  return once ? -u * u / (2 * (1 + u)) : -u * u * (1 + u) / (6 * (1 + u + u * u / 3));
}

/// What say/page/web/kriging_error.js computes: of z.
double variance_of_page(const detail::Surface& s, const detail::SurfaceError& e, const Eigen::VectorXd& x) {
  const Eigen::Index n = s.X.rows(), d = x.size();
  const Eigen::VectorXd at = (x - s.centre).cwiseProduct(s.factor);
  Eigen::MatrixXd R(n, n);
  Eigen::VectorXd r(n), f(static_cast<Eigen::Index>(s.terms.size()));
  for (Eigen::Index i = 0; i < n; ++i) {
    r[i] = product_of_page(s, at, s.X.row(i));
    for (Eigen::Index j = 0; j < n; ++j)
      R(i, j) = i == j ? 1.0 + e.noise[i] : product_of_page(s, s.X.row(i), s.X.row(j));
  }
  for (Eigen::Index t = 0; t < f.size(); ++t) f[t] = s.terms[static_cast<std::size_t>(t)].at(at);
  const Eigen::VectorXd explained = R.llt().matrixL().solve(r);
  const Eigen::VectorXd missing =
      Eigen::VectorXd(e.T.transpose().triangularView<Eigen::Lower>().solve(f)) - e.B.transpose() * r;
  Eigen::VectorXd W = Eigen::VectorXd::Zero(e.theta_spread.cols());
  for (Eigen::Index i = 0; W.size() > 0 && i < n; ++i) {
    for (Eigen::Index k = 0; k < d; ++k) {
      const double h = distance_of_page(s, k, at[k], s.X(i, k));
      const double slope = s.weights[i] * r[i] * slope_of_page(s.correlation, k, h);
      W += slope * e.theta_spread.row(k).transpose();
      if (e.exponent_spread.rows() > 0 && h > 0)
        W += slope * std::log(h) * e.exponent_spread.row(k).transpose();
    }
    W += r[i] * e.alpha_effects.row(i).transpose();
  }
  if (W.size() > 0) W += e.beta_effects.transpose() * f;
  return e.process_variance * std::max(1.0 - explained.squaredNorm() + missing.squaredNorm(), 0.0) +
         W.squaredNorm();
}

/// R has n eigenvalues of which the least is the nugget or more; the two ways to solve with it differ by n
/// rounding errors over that.
void expect_same_error(const ReportInput& in, const kriging::TransformedModel& model) {
  const auto found = detail::surface(model);
  const auto error = detail::surface_error(model);
  ASSERT_TRUE(found && error);
  const Eigen::MatrixXd points = doe::uniform_random(in.problem, 30, {.seed = 98});
  const Eigen::VectorXd wanted = model.model().predict(points).variance;
  const double n = static_cast<double>(found->X.rows()), least = error->noise.minCoeff();
  const double budget = 10 * n * n * 2.2e-16 / least;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    EXPECT_NEAR(variance_of_page(*found, *error, points.row(i).transpose()), wanted[i],
                budget * error->process_variance + 1e-9 * wanted[i]);
}

void expect_same_mean(const ReportInput& in, const kriging::TransformedModel& model) {
  const auto found = detail::surface(model);
  ASSERT_TRUE(found);
  const detail::Surface& s = *found;
  const Eigen::MatrixXd points = doe::uniform_random(in.problem, 100, {.seed = 99});
  const Eigen::VectorXd wanted = model.mean(points);
  // The same sums in another order: each correlation is good to some d rounding errors, 1e-15, and the last
  // addition to that of the largest partial sum.
  const double size = std::abs(s.constant) + s.weights.cwiseAbs().sum() + s.coefficients.cwiseAbs().sum();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    EXPECT_NEAR(formula_of_page(s, points.row(i).transpose()), wanted[i], 1e-13 * size);
  expect_same_error(in, model);
}

}  // namespace

TEST(ReportSurface, TheBrowserSeesTheModelsMean) {
  ReportInput in = input(3, 1, 30, 0);
  expect_same_mean(in, in.models[0]);  // scaled by the data's range
  kriging::FitOptions options;
  options.lower = Eigen::VectorXd::Constant(3, 0.0);
  options.upper = Eigen::VectorXd::Constant(3, 2.0);
  expect_same_mean(in, kriging::fit(in.training.X(), in.training.y("y0"), options));  // by the problem's box
}

TEST(ReportSurface, TheBrowserKnowsCategories) {
  ReportInput in = input(2, 1, 1, 0);
  in.problem.variables.push_back(doe::categorical_variable("tool", {"bucket", "blade", "ripper"}));
  const Eigen::MatrixXd X = doe::uniform_random(in.problem, 24, {.seed = 4});
  const Eigen::VectorXd y = X.col(0).array().sin() + (X.col(2).array() == 1.0).select(2.0, X.col(1)).array();
  for (const auto family : {kriging::Correlation::gaussian, kriging::Correlation::matern52}) {
    kriging::FitOptions options;
    options.levels = doe::level_counts(in.problem);
    options.correlation = family;
    options.trend = kriging::Trend::linear;
    expect_same_mean(in, kriging::fit(X, y, options));
  }
}

TEST(ReportSurface, ReplicatesOfNoisyRunsAreFine) {
  ReportInput in = input(2, 1, 15, 0);
  doe::RandomStream random(5);
  const auto once = in.training.rows;
  in.training.rows.insert(in.training.rows.end(), once.begin(), once.end());
  for (doe::Evaluation& e : in.training.rows)
    e.outcome = doe::Outcome(e.outcome.values()[0] + 0.1 * random.normal());
  expect_same_mean(in, kriging::fit(in.training.X(), in.training.y("y0")));
}

TEST(ReportSurface, EveryCorrelationAndTrendIsDrawn) {
  const ReportInput in = input(3, 1, 30, 0);
  kriging::FitOptions options;
  for (const auto correlation : {kriging::Correlation::gaussian, kriging::Correlation::power_exponential,
                                 kriging::Correlation::matern32, kriging::Correlation::matern52})
    for (const auto trend : {kriging::Trend::constant, kriging::Trend::linear, kriging::Trend::quadratic}) {
      options.correlation = correlation;
      options.trend = trend;
      expect_same_mean(in, kriging::fit(in.training.X(), in.training.y("y0"), options));
    }
}

// What round-off does to z, 1e-13 of its largest partial sum, the scales pass on with their slope: below 10
// here.
TEST(ReportSurface, TheBrowserSeesTheMeanOnEveryScale) {
  const ReportInput in = input(3, 1, 30, 0);
  Eigen::VectorXd y = in.training.y("y0");
  y = ((y.array() - y.minCoeff()) / (y.maxCoeff() - y.minCoeff())).matrix();
  for (const auto scale : {kriging::Scale::square_root, kriging::Scale::logarithm, kriging::Scale::logit}) {
    kriging::FitOptions options;
    options.nugget_lower = 0.05;  // so that there is noise to take the mean over
    expect_same_mean(in, kriging::fit_transformed(in.training.X(), y, scale, {0.0, 1.0}, options));
  }
}

TEST(ReportSurface, AConstantResponseIsDrawnAsSuch) {
  const ReportInput in = input(2, 1, 10, 0);
  const kriging::Model model = kriging::fit(in.training.X(), Eigen::VectorXd::Constant(10, 3.0));
  const auto s = detail::surface(model);
  ASSERT_TRUE(s);
  EXPECT_EQ(formula_of_page(*s, Eigen::Vector2d(0.3, 1.7)), 3.0);
}

TEST(ReportSurface, ATrendOfTheUsersOwnIsNot) {
  const ReportInput in = input(2, 1, 15, 0);
  kriging::FitOptions options;
  options.trend = kriging::Trend::user;
  options.basis.values = [](const Eigen::VectorXd& x) { return Eigen::VectorXd(Eigen::Vector2d(1.0, x[0])); };
  EXPECT_FALSE(detail::surface(kriging::fit(in.training.X(), in.training.y("y0"), options)));
}

// f = x0 + 2 x1 on a square: the variances of the terms are 1:4, so the total indices are 0.2 and 0.8.
// Jansen's terms (a - b)^2/2 have a relative standard deviation of sqrt(7/5) for uniform a, b, so 512 of them
// give 1.2/sqrt(512) = 5 %; the variance in the denominator, of 1024 values, adds 3 %. Four sigma of 6 % is
// 24 %; the sum of both indices is as uncertain.
TEST(ReportInfluence, LinearFunction) {
  ReportInput in = input(2, 1, 20, 0);
  const Eigen::MatrixXd X = in.training.X();
  const Eigen::VectorXd total =
      detail::influence({kriging::fit(X, X.col(0) + 2.0 * X.col(1))}, in.problem).front();
  EXPECT_NEAR(total[0], 0.2, 0.24 * 0.2);
  EXPECT_NEAR(total[1], 0.8, 0.24 * 0.8);
}

TEST(ReportInfluence, ConstantFunctionHasNone) {
  const ReportInput in = input(2, 1, 20, 0);
  const kriging::Model constant = kriging::fit(in.training.X(), Eigen::VectorXd::Constant(20, 3.0));
  EXPECT_EQ(detail::influence({constant}, in.problem).front(), Eigen::VectorXd::Zero(2));
}

TEST(ReportText, AVariableIsSaidAsWhatItIs) {
  const doe::Problem mill{.variables = {{"speed", "1", 0.0, 1.0},
                                        doe::integer_variable("balls", "t", 10, 40),
                                        doe::categorical_variable("lining", {"hard_steel", "rubber"})},
                          .responses = {{"ground", "t/h", doe::Goal::maximize}}};
  EXPECT_EQ(detail::point_text(mill, Eigen::Vector3d(0.75, 32.0, 0.0)),
            "speed = 0.750, balls = 32 t, lining = hard steel");
  EXPECT_EQ(detail::setting(mill.variables[0], 3e-6), "0");
  EXPECT_EQ(detail::setting({"leak", "m", 1e-6, 1.0}, 3e-6), "3.00e-06");
}

// Ideal point (best of each) is (10, 0) with the goals maximize, minimize. Scaled distances: (0, 1) -> 1;
// (0.5, 0.25) -> 0.56; (1, 0) -> 1.
TEST(ReportSummary, BalancedPointIsNearestToTheIdeal) {
  pareto::Front front;
  front.Y = Eigen::MatrixXd{{10.0, 4.0}, {6.0, 1.0}, {2.0, 0.0}};
  EXPECT_EQ(detail::balanced_point(problem(2, 2), front), 1);
  EXPECT_EQ(detail::balanced_point(problem(2, 2), pareto::Front{}), -1);
}

TEST(ReportText, NumbersHaveThreeDigits) {
  EXPECT_EQ(detail::number(412.3), "412");
  EXPECT_EQ(detail::number(-0.07463), "-0.0746");
  EXPECT_EQ(detail::number(12345.6), "12346");
  EXPECT_EQ(detail::number(2.5e7), "2.50e+07");
  EXPECT_EQ(detail::number(0.0), "0");
  EXPECT_EQ(detail::number(std::nan("")), "n/a");
  EXPECT_EQ(detail::number_with_unit(1.5, "1"), "1.50");
  EXPECT_EQ(detail::percent(0.0712), "7.1 %");
}

// Two bodies, two frames; x spans -10..10 m about 0, so one unit is 10/32767 m. x = 10 is 32767 = FF 7F, the
// identity's w too; an absent body is 00 80 and zeros.
TEST(ReportPanels, PosesArePacked) {
  const nlohmann::json here = {10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0},
                       there = {-10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  const nlohmann::json scene = {
      {"type", "scene"},
      {"title", "t"},
      {"caption", "c"},
      {"shapes", {{{"vertices", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {"faces", {{0, 1, 2}}}}}},
      {"bodies", {{{"shape", 0}}, {{"shape", 0}}}},
      {"frames", {{{"t", 0.0}, {"poses", {here, nullptr}}}, {{"t", 1.0}, {"poses", {there, here}}}}}};
  std::vector<std::string> cautions;
  const auto packed = detail::checked_panels(nlohmann::json::array({scene}), cautions);
  ASSERT_TRUE(cautions.empty()) << cautions[0];
  const auto& poses = packed.at(0).at("poses");
  EXPECT_DOUBLE_EQ(poses.at("scale").get<double>(), 10.0 / 32767.0);
  // FF7F 0000 0000 FF7F 0000 0000 0000 | 0180 0000 0000 FF7F 0000 0000 0000 | 0080 0000 x6 | as the first
  EXPECT_EQ(poses.at("data"), "/38AAAAA/38AAAAAAAABgAAAAAD/fwAAAAAAAACAAAAAAAAAAAAAAAAA/38AAAAA/38AAAAAAAA=");
  EXPECT_EQ(poses.at("counts"), nlohmann::json({2, 2}));
  EXPECT_EQ(poses.at("frames"), "AAABAAAAAQA=");
  EXPECT_FALSE(packed.at(0).at("frames").at(0).contains("poses"));
}

nlohmann::json scene_of_tracks() {
  const nlohmann::json shape = {{"vertices", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {"faces", {{0, 1, 2}}}};
  return {{"type", "scene"},
          {"title", "t"},
          {"caption", "c"},
          {"shapes", {shape}},
          {"bodies",
           {{{"shape", 0}, {"track", {{0, 0, 0, 0, 1, 0, 0, 0}, {2, 1, 0, 0, 1, 0, 0, 0}}}},
            {{"shape", 0}, {"with", 0}},
            {{"shape", 0}, {"track", {{1, 0, 0, 0, 1, 0, 0, 0}, {2}}}}}},
          {"frames", {{{"t", 0.0}}, {{"t", 1.0}}, {{"t", 2.0}}}},
          {"signals", {{{"name", "speed"}, {"unit", "m/s"}, {"t", {0, 1}}, {"y", {1, 2}}}}}};
}

TEST(ReportPanels, ABodyMayHavePosesInSomeFramesOrMoveWithAnother) {
  std::vector<std::string> cautions;
  const auto packed = detail::checked_panels(nlohmann::json::array({scene_of_tracks()}), cautions);
  ASSERT_TRUE(cautions.empty()) << cautions[0];
  EXPECT_EQ(packed.at(0).at("poses").at("counts"), nlohmann::json({2, 0, 2}));
  EXPECT_EQ(packed.at(0).at("poses").at("frames"), "AAACAAEAAgA=");  // 0 2 1 2
  EXPECT_EQ(packed.at(0).at("bodies").at(1), nlohmann::json({{"shape", 0}, {"with", 0}}));
  EXPECT_FALSE(packed.at(0).at("bodies").at(0).contains("track"));
}

TEST(ReportPanels, TracksThatDoNotHangTogetherAreRefused) {
  const auto complaint = [](const char* place, const nlohmann::json& value) {
    nlohmann::json scene = scene_of_tracks();
    scene[nlohmann::json::json_pointer(place)] = value;
    std::vector<std::string> cautions;
    EXPECT_TRUE(detail::checked_panels(nlohmann::json::array({scene}), cautions).empty()) << place;
    return cautions.at(0);
  };
  const std::string begin = "Figure 1 of the simulation was left out: ";
  EXPECT_EQ(complaint("/bodies/0/track/1/0", 3), begin + "a body's track names a frame that is not there.");
  EXPECT_EQ(complaint("/bodies/0/track/1/0", 0), begin + "the frames of a body's track do not rise.");
  EXPECT_EQ(complaint("/bodies/0/track/1", {2, 0}),
            begin + "a row of a body's track has neither a frame alone nor a frame and seven numbers.");
  EXPECT_EQ(complaint("/bodies/1/with", 1),
            begin + "a body moves with one that is not there or has no track.");
  EXPECT_EQ(complaint("/bodies/2", {{"shape", 0}}),
            begin + "of some bodies there is a track, of others not.");
  EXPECT_EQ(complaint("/signals/0/y", {1}), begin + "\"t\" and \"y\" differ in length.");
  EXPECT_EQ(complaint("/follow", 3), begin + "the body to follow is not there.");
}

TEST(ReportPanels, ASceneThatDoesNotHangTogetherIsRefused) {
  nlohmann::json scene = {{"type", "scene"},
                          {"title", "t"},
                          {"caption", "c"},
                          {"shapes", nlohmann::json::array()},
                          {"bodies", {{{"shape", 0}}}},
                          {"frames", nlohmann::json::array()}};
  std::vector<std::string> cautions;
  EXPECT_TRUE(detail::checked_panels(nlohmann::json::array({scene}), cautions).empty());
  ASSERT_EQ(cautions.size(), 1u);
  EXPECT_EQ(cautions[0], "Figure 1 of the simulation was left out: a body names a shape that is not there.");
}
// y1 is half of y0 where x1 does not matter, so the limit takes the best of y0: praised is the best that keeps
// it, and where none does, none.
TEST(Summary, PraisesNoRunThatBreaksALimit) {
  ReportInput in = input(2, 2, 12, 4);
  const Eigen::MatrixXd Y = [&] {
    Eigen::MatrixXd all(12, 2);
    all << in.training.y("y0"), in.training.y("y1");
    return all;
  }();
  const auto sentence = [&](double limit) {
    for (doe::Problem* problem : {&in.problem, &in.training.problem, &in.validation.problem}) {
      problem->responses[1].goal = doe::Goal::at_most;
      problem->responses[1].limit = limit;
    }
    in.validation.rows.clear();
    in.front.Y = Y.leftCols(1);
    return detail::summary(in, {Eigen::VectorXd::Ones(2), Eigen::VectorXd::Ones(2)})["sentences"][0]
        .get<std::string>();
  };
  const double median = Y.col(1).mean();
  Eigen::Index best = -1, first = 0;
  for (Eigen::Index i = 0; i < 12; ++i)
    if (Y(i, 1) <= median && (best < 0 || Y(i, 0) > Y(best, 0))) best = i;
  Y.col(0).maxCoeff(&first);
  ASSERT_NE(best, first);
  const std::string run =
      "run " + std::to_string(in.training.rows[static_cast<std::size_t>(best)].run) + ", gave";
  EXPECT_NE(sentence(median).find("single runs within the limits"), std::string::npos) << sentence(median);
  EXPECT_NE(sentence(median).find(run), std::string::npos) << sentence(median);
  EXPECT_NE(sentence(-100.0).find("no run simulated so far keeps all limits"), std::string::npos);
}
