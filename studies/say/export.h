// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A study's results as flat tables for other programs. A categorical variable has the name of its level.

#include <drawpoint/studies/run/store/store.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies {

enum class ColumnType { number, whole, text };

struct ExportColumn {
  std::string name, unit;  ///< unit "": not a quantity
  ColumnType type = ColumnType::number;
  std::string description = {};  ///< for people; not in CSV and JSON
};

struct ExportTable {
  std::vector<ExportColumn> columns;
  /// Numbers, or null where there is none; whole numbers; text.
  std::vector<std::vector<nlohmann::json>> rows;
};

/// All runs in order of id: run, kind, point, replicate, seed (text, 64 bits), status, reason, seconds, then
/// the variables, the responses, and of each response what was predicted and the ends of its 95 % interval.
ExportTable runs_table(const Identity& identity, const std::vector<Run>& runs);

/// Runs to be made elsewhere: run, kind, point, replicate, seed, then the variables.
ExportTable asked_table(const Identity& identity, const std::vector<Run>& runs);

/// The predicted front of the present models: the variables, the responses, of each response the ends of the
/// 95 % interval of one run and the standard error of what is predicted, noise left out, the probability of
/// being non-dominated (front_uncertainty.h), and that a run succeeds. `missing` takes why there is no point,
/// where there is none. Throws std::runtime_error if the runs do not allow models.
ExportTable front_table(const Identity& identity, const std::vector<Run>& runs,
                        std::string* missing = nullptr);

/// What the present models expect at the points X (n x d, natural units), with the columns of front_table but for being
/// non-dominated. Throws std::runtime_error if the runs do not allow models.
ExportTable predictions_table(const Identity& identity, const std::vector<Run>& runs,
                              const Eigen::MatrixXd& X);

/// The problem: a row per variable or response.
ExportTable variables_table(const doe::Problem& problem);
ExportTable responses_table(const doe::Problem& problem);

/// RFC 4180, the first line being "name [unit]"; every double reads back as the same bits.
std::string as_csv(const ExportTable& table);

/// {"study", "columns": [{"name", "unit"}], "rows": [[..]..]}
std::string as_json(const std::string& study, const ExportTable& table);

}  // namespace drawpoint::studies
