// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace drawpoint;

// As numpy.savetxt and pandas.DataFrame.to_csv write it: a line of names, then rows of numbers.
Eigen::MatrixXd read(const std::string& path) {
  std::ifstream file(path);
  std::string line, word;
  std::vector<double> numbers;
  Eigen::Index rows = 0;
  std::getline(file, line);  // names
  for (; std::getline(file, line); ++rows)
    for (std::istringstream words(line); std::getline(words, word, ',');) numbers.push_back(std::stod(word));
  if (rows == 0 || numbers.size() % rows != 0)
    throw std::runtime_error(path +
                             ": not a table of numbers below a line of names; write it without an index");
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<Table>(numbers.data(), rows, static_cast<Eigen::Index>(numbers.size()) / rows);
}

// coming_from_python RUNS POINTS PREDICTIONS: runs have the inputs and, in the last column, the response.
int main(int argc, char** argv) try {
  if (argc != 4) return std::fputs("usage: coming_from_python RUNS POINTS PREDICTIONS\n", stderr), 2;
  const Eigen::MatrixXd runs = read(argv[1]), points = read(argv[2]);
  const kriging::Model model = kriging::fit(runs.leftCols(runs.cols() - 1), runs.rightCols(1));
  if (model.status() != kriging::Status::converged) throw std::runtime_error(model.message());
  std::printf("%lld runs, error by leaving out %.2f %% of the range\n", static_cast<long long>(runs.rows()),
              100.0 * kriging::leave_one_out(model).nrmse);

  const kriging::Prediction p = model.predict(points);
  std::ofstream out(argv[3]);
  out.precision(17);
  out << "mean,deviation\n";
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    out << p.mean[i] << ',' << std::sqrt(p.variance[i]) << '\n';
  return out.flush() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
