// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The store of a study: one SQLite file (application id 0x44727770, schema version in user_version).
///
///     study(key, value)  name, problem (JSON), seed, replicates, corners, options (JSON), simulator,
///                        created, rows (how many runs there are), checksum; and what a user may change:
///                        sampling (JSON) and, where there are any, marks (JSON)
///     runs               one row per run: id (1, 2, ... without a gap), kind, point, replicate, seed, status,
///                        reason, seconds, started, finished, log, checksum, then one REAL column for each
///                        variable and each response, named as in the problem, and for each response what was
///                        predicted of the run before it was made, and the ends of its 95 % interval
///
///     corrections        where there are any: number, run, what, why, before (JSON), made, checksum
///
/// Seeds are decimal text, because SQLite's integers have a sign. Times are UTC in ISO 8601. columns.h
/// names the columns.
///
/// status is planned, running, done or failed; a row stays "running" when the study is killed, until the
/// next `run`.
///
/// `checksum` is over all else in the row (row_checksum.h), and in the table study over all other entries;
/// `log` is that of the run's log file, empty where it wrote none. What does not fit when it is read is
/// refused: damage, a row that is gone, a value changed by hand.
///
/// Every change is one transaction, on disk when the call returns. A file that is not a sound store of this
/// schema is refused and left as it is. All failures throw std::runtime_error that names the file and says
/// what to do.

#include <drawpoint/studies/run/store/columns.h>
#include <drawpoint/studies/run/store/identity.h>
#include <drawpoint/studies/run/store/sampling.h>
#include <drawpoint/studies/mark.hpp>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace SQLite {
class Database;
}

namespace drawpoint::studies {

/// All but the validation runs are for the models.
enum class Kind {
  training,      ///< of the first design
  adaptive,      ///< chosen by what the runs before it showed
  confirmation,  ///< a point of a predicted front
  imported,      ///< made elsewhere
  validation     ///< independent, for judging the models
};
/// SQLite keeps it in the header of the file of a store.
inline constexpr int store_application_id = 0x44727770;

inline constexpr std::array all_kinds = {Kind::training, Kind::adaptive, Kind::confirmation, Kind::imported,
                                         Kind::validation};
enum class Status { planned, running, done, failed };

std::string name_of(Kind kind);
std::string name_of(Status status);

/// One run. `y` and `seconds` have a meaning when done (or failed), `reason` when failed.
struct Run {
  std::int64_t id = 0;  ///< unique, 1, 2, ...; the run log's name carries it
  Kind kind = Kind::training;
  std::int64_t point = 0;  ///< number of the design point within its kind, from 1; replicates share it
  int replicate = 0;
  doe::Seed seed = 0;
  Eigen::VectorXd x;
  Status status = Status::planned;
  Eigen::VectorXd y;
  /// What the models of the runs before it said of this run: mean of each response and the ends of the
  /// interval that should hold 95 of 100 such runs. NaN (or, of a run that is being planned, empty) where
  /// nothing was predicted.
  Eigen::VectorXd predicted, lower, upper;
  std::string reason;
  double seconds = 0.0;
  std::string started, finished;
  std::string log;  ///< checksum of its log file; empty: it wrote none
  /// No model sees it (left_out.h): it is `failed` here, whatever is stored.
  bool left_out = false;
};

/// What somebody has put right, with what stood there before.
struct Correction {
  std::int64_t number = 0;  ///< 1, 2, ...
  std::int64_t run = 0;
  std::string what;  ///< left_out.h: exclude, include, replace
  std::string why;
  std::string before;  ///< status, reason, values and seconds as JSON
  std::string made;    ///< UTC
};

/// Another program held the file for longer than the store waits: 30 s, of Access::read 2 s.
struct StoreBusy : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `read` never writes, not even to clean up after a process that died while it wrote. It checks what it
/// reads by the checksums, and leaves the rest of the file unchecked, so that one may look often.
enum class Access { change, read };

/// Whether it was made, and gave values or failed.
inline bool has_ended(const Run& run) { return run.status == Status::done || run.status == Status::failed; }

class Store {
 public:
  /// A new, empty store. It appears under `file` complete or not at all. Requires that `file` does not exist.
  static Store create(const std::filesystem::path& file, const Identity& identity);
  static Store open(const std::filesystem::path& file, Access access = Access::change);

  Store(Store&&) noexcept;
  ~Store();

  const Identity& identity() const { return identity_; }
  const Sampling& sampling() const { return sampling_; }
  /// Options that came to the study after the file was made, for identity(); the file stays as it is.
  void complete_options(const OptionValues& options) {
    identity_.options.insert(options.begin(), options.end());
  }
  /// In order of id. Those that are left out have failed, with the reason for that.
  std::vector<Run> runs() const;
  std::vector<Correction> corrections() const;  ///< in order of number
  std::vector<Mark> marks() const;              ///< that the folder's user has named, at this moment

  void set_sampling(const Sampling& sampling);
  void set_marks(const std::vector<Mark>& marks);
  void add(const std::vector<Run>& runs);  ///< planned ones, or ones that have ended elsewhere; all or none
  void mark_running(std::int64_t id);
  void mark_planned(std::int64_t id);
  void save_done(std::int64_t id, const Eigen::VectorXd& y, double seconds, const std::string& log = {});
  void save_failed(std::int64_t id, const std::string& reason, double seconds, const std::string& log = {});
  /// A run that has ended is left out from now on, or taken in again; enters the ledger.
  void exclude(std::int64_t id, const std::string& why, bool take_back = false);
  /// What is stored of a run that has ended becomes this; what stood there enters the ledger. `y` is empty where
  /// it failed.
  void replace(std::int64_t id, const Eigen::VectorXd& y, const std::string& reason, double seconds,
               const std::string& why);
  /// Runs that were in flight when a process died become planned again; with `failed`, so do the failed ones.
  void plan_again(bool failed);

 private:
  Store(std::filesystem::path file, std::unique_ptr<SQLite::Database> database);
  void check_format() const;
  void check_integrity() const;
  void read_identity();
  void seal_rows(const std::string& condition);
  void seal_study();
  void put_setting(const std::string& key, const std::string& value);
  void write_done(std::int64_t id, const Eigen::VectorXd& y, double seconds, const std::string& log);
  void write_failed(std::int64_t id, const std::string& reason, double seconds, const std::string& log);
  std::vector<Correction> read_corrections() const;
  void write_correction(const Run& before, const std::string& what, const std::string& why);
  Run stored_row(std::int64_t id) const;
  template <class F>
  void change(std::int64_t id, const F& f);

  std::filesystem::path file_;
  std::unique_ptr<SQLite::Database> database_;
  Identity identity_;
  Sampling sampling_;
  Columns columns_;
};

}  // namespace drawpoint::studies
