// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It cannot be called with a point.
// times: 3

#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>

using namespace drawpoint;

// Each call has a function of its own, for the compiler complains once a type.
void search(const doe::Problem& problem) {
  pareto::nsga3([](double a, double b) { return a + b; }, problem);
  pareto::sms_emoa([](double a, double b) { return a + b; }, problem);
  pareto::moead([](double a, double b) { return a + b; }, problem);
}
