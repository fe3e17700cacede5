// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/doe/detail/students_t.hpp>

#include <cmath>

using namespace drawpoint;

namespace {

struct Quantile {
  double level, degrees_of_freedom, t;
};

// mpmath 1.2.1 with 30 digits, 2026-11-26: the t at which 1 - I(ν/(ν + t²); ν/2, 1/2) reaches the level, by
// bisection.
constexpr Quantile quantiles[] = {
    {0.5, 1, 1.0},
    {0.5, 1.5, 0.8725946625416},
    {0.5, 2, 0.8164965809277},
    {0.5, 2.7, 0.7759862837453},
    {0.5, 5, 0.7266868438004},
    {0.5, 9, 0.7027221467513},
    {0.5, 39, 0.6808325565646},
    {0.5, 1000, 0.674735164607},
    {0.95, 1, 12.70620473617},
    {0.95, 1.5, 6.016663104428},
    {0.95, 2, 4.302652729749},
    {0.95, 2.7, 3.392148383174},
    {0.95, 5, 2.570581835636},
    {0.95, 9, 2.262157162798},
    {0.95, 39, 2.022690920037},
    {0.95, 1000, 1.962339080826},
    {0.99, 1, 63.65674116287},
    {0.99, 1.5, 17.82031051446},
    {0.99, 2, 9.924843200918},
    {0.99, 2.7, 6.533128433408},
    {0.99, 5, 4.032142983555},
    {0.99, 9, 3.249835541592},
    {0.99, 39, 2.707913183518},
    {0.99, 1000, 2.580754698066},
};

// Half a unit of the thirteenth digit is 5e-13 of t. Simpson's error is h⁴/180 times the change of the third
// derivative of cos^p, p = ν - 1. Near π/2, δ away from it, that is p(p-1)(p-2) δ^(p-3); dividing by δ^p
// gives the error of θ, by δ that of t relatively. Largest here for p = 0.5: 1.8e-10 at level 0.95 (h =
// 0.0034, δ = 0.20), 1.9e-8 at 0.99 (h = 0.0038, δ = 0.069).
TEST(StudentsT, QuantilesAreThoseOfAnotherProgram) {
  for (const auto& [level, degrees_of_freedom, t] : quantiles)
    EXPECT_NEAR(doe::detail::students_t_within(level, degrees_of_freedom) / t, 1.0,
                level <= 0.95 ? 1e-9 : 3e-8)
        << level << " with " << degrees_of_freedom;
}

// ν = 1 is Cauchy's distribution, t = tan(π level/2); ν = 2 has t = level √2/√(1 - level²). Both integrands
// are what Simpson's rule holds to 1e-12, and rounding is 400 terms of 1e-16.
TEST(StudentsT, KnownInClosedForm) {
  for (const double level : {0.1, 0.5, 0.95}) {
    EXPECT_NEAR(doe::detail::students_t_within(level, 1.0) / std::tan(std::acos(0.0) * level), 1.0, 1e-11);
    EXPECT_NEAR(doe::detail::students_t_within(level, 2.0) / (level * std::sqrt(2.0 / (1.0 - level * level))),
                1.0, 1e-11);
  }
}

// On both sides of 1e4 degrees of freedom, where the method changes, t differs by its slope in 1/nu alone,
// (z^3 + z)/4 times 2e-8/1e4; and far beyond it is the normal quantile, to (z^3 + z)/(4 nu).
TEST(StudentsT, NearsTheNormalQuantile) {
  const double z = 1.959963984540054;
  EXPECT_NEAR(doe::detail::students_t_within(0.95, 1e4 * (1 - 1e-8)),
              doe::detail::students_t_within(0.95, 1e4 * (1 + 1e-8)), 2e-9);
  for (const double freedom : {1e5, 5e5, 1e6, 1e9})
    EXPECT_NEAR(doe::detail::students_t_within(0.95, freedom), z + (z * z * z + z) / (4 * freedom), 1e-9)
        << freedom;
}

TEST(StudentsT, WhatItCannotTellIsRefused) {
  EXPECT_THROW(doe::detail::students_t_within(0.95, 0.5), std::invalid_argument);
  EXPECT_THROW(doe::detail::students_t_within(1.0, 5.0), std::invalid_argument);
  EXPECT_THROW(doe::detail::students_t_within(std::nan(""), 5.0), std::invalid_argument);
}

}  // namespace
