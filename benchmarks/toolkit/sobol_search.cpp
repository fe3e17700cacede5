// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// The numbers of doe/detail/sobol_attempts.hpp, found anew; or how even our two-dimensional projections are
/// beside those of other direction numbers.
///
/// `sobol_search` prints the best attempt of each dimension from 38 on. `sobol_search FILE` reads one
/// dimension per row, the first one's not looked at: polynomial as bits, then 18 numbers m_1, m_2, ..., 0 where
/// there are no more, as SciPy's _sobol_direction_numbers.npz holds them.

#include <algorithm>
#include <bit>
#include <cstdio>
#include <drawpoint/tests/doe/sobol_projections.hpp>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace drawpoint;
using Rows = std::vector<support::GeneratingRows>;

Rows rows_of_ours(int d) {
  Rows rows;
  for (int j = 0; j < d; ++j) rows.push_back(support::generating_rows(doe::detail::sobol_directions(j)));
  return rows;
}

Rows rows_of_file(const std::string& path) {
  Rows rows = rows_of_ours(1);
  std::ifstream in(path);
  std::string first;
  std::getline(in, first);
  for (std::uint32_t polynomial; in >> polynomial;) {
    doe::detail::SobolDimension dimension{static_cast<int>(std::bit_width(polynomial)) - 1, 0, {}};
    dimension.coefficients = (polynomial >> 1) & ((1U << (dimension.degree - 1)) - 1);
    if (dimension.degree > doe::detail::sobol_max_degree) break;
    for (std::size_t k = 0; k < 18; ++k) {
      std::uint32_t m = 0;
      in >> m;
      if (k < dimension.initial.size()) dimension.initial[k] = m;
    }
    rows.push_back(support::generating_rows(doe::detail::directions_of(dimension)));
  }
  return rows;
}

void print_attempts() {
  Rows rows = rows_of_ours(37);
  for (int j = 37; j < doe::detail::sobol_max_dimensions; ++j) {
    const int best = support::best_sobol_attempt(rows, j);
    rows.push_back(support::generating_rows(
        doe::detail::directions_of(doe::detail::sobol_attempt(doe::detail::sobol_dimension(j), j, best))));
    std::printf("%d,%s", best, j % 20 == 16 ? "\n" : " ");
  }
  std::printf("\n");
}

/// Mean and largest t of dimensions 38 to `last`, each with `span` dimensions before it.
void print_t(const Rows& rows, int last, int span, int m) {
  double sum = 0.0;
  int worst = 0, pairs = 0;
  for (int j = 37; j < std::min(last, static_cast<int>(rows.size())); ++j)
    for (int i = std::max(0, j - span); i < j; ++i, ++pairs) {
      const int t = support::t_value(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)], m);
      sum += t;
      worst = std::max(worst, t);
    }
  std::printf("  %5.2f %2d", sum / std::max(pairs, 1), worst);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    print_attempts();
    return 0;
  }
  std::printf("mean and largest t: neighbours, within ten, all to 100, to 360, to 1111\n");
  const Rows ours = rows_of_ours(doe::detail::sobol_max_dimensions), others = rows_of_file(argv[1]);
  for (const int m : {6, 8, 10, 12, 14, 16})
    for (const Rows* rows : {&ours, &others}) {
      std::printf("m = %2d, %s", m, rows == &ours ? "ours " : "other");
      print_t(*rows, 1111, 1, m);
      print_t(*rows, 1111, 10, m);
      for (const int last : {100, 360, 1111}) print_t(*rows, last, 1111, m);
      std::printf("\n");
    }
  return 0;
}
