// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/record/table.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// Files of named numbers, texts and tables (HDF5), written whole or not at all and verified when read.
///
/// A file has a format name and a version, groups by "/"-paths, attributes (text, real, integer) on groups,
/// and data: arrays of double, float or int32 with a shape, single numbers and texts, tables, and lists of
/// text. Data is gzip-compressed (level 1) in chunks. After the end that HDF5 knows stand 24 bytes: a mark,
/// the length and the 64-bit FNV-1a checksum of all before; a reader checks them before anything else,
/// seconds per gigabyte. Other programs (h5dump, h5py, MATLAB, Octave) ignore them and read the file as it
/// is. A plain file is for, or of, other programs: arrays contiguous and uncompressed, nothing after the
/// end, so that its damage is not seen.
///
/// A Writer builds the file in memory; commit() writes it beside the target, syncs it and renames it over the
/// target, so a full disk, a read-only folder or a killed process leave the old file. Safe to use from
/// several threads, one object per thread. Errors of the disk and of the file are std::runtime_error, wrong
/// use is std::invalid_argument.
namespace drawpoint::engine::record {

struct FileKind {
  std::string format;    ///< e.g. "drawpoint loading log"
  int version = 1;       ///< what a writer writes
  int oldest = version;  ///< a reader takes the versions from this one on
};

enum class Form { checked, plain };

/// An array as it was stored; empty shape: one value.
template <class T>
struct Array {
  std::vector<T> values;  ///< row-major
  std::vector<std::size_t> shape;
};

class Writer {
 public:
  Writer(std::filesystem::path target, const FileKind& kind, Form form = Form::checked);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Attributes of a group, made if it is not there; "/" is the root.
  void text(const std::string& group, const std::string& name, const std::string& value);
  void number(const std::string& group, const std::string& name, double value);
  void integer(const std::string& group, const std::string& name, std::int64_t value);

  /// Data at a path; a path is written once. The shape's product is the number of values; no shape: one
  /// dimension.
  void array(const std::string& path, std::span<const double> values, std::vector<std::size_t> shape = {});
  void array(const std::string& path, std::span<const float> values, std::vector<std::size_t> shape = {});
  void array(const std::string& path, std::span<const std::int32_t> values,
             std::vector<std::size_t> shape = {});
  void texts(const std::string& path, const std::vector<std::string>& values);
  void scalar(const std::string& path, double value);
  void scalar(const std::string& path, const std::string& value);
  void table(const std::string& path, const Table& table);
  void group(const std::string& path);
  /// Attributes "unit", "description" and, where there is one, "frame" of data that is written: the axes that
  /// its numbers are in.
  void describe(const std::string& path, const std::string& unit, const std::string& description,
                const std::string& frame = {});

  /// Writes the target; afterwards the writer is spent. Without it nothing appears on the disk. `check` reads
  /// the written file before that becomes the target; what it throws leaves the target as it was.
  void commit(const std::function<void(const std::filesystem::path&)>& check = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class Reader {
 public:
  /// Throws std::runtime_error if the file is missing, truncated, damaged, of another format or another
  /// version. A plain one is read without a look at its checksum, which it need not have.
  Reader(std::filesystem::path path, const FileKind& kind, Form form = Form::checked);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const std::filesystem::path& path() const;
  int version() const;  ///< of its format

  std::string text(const std::string& group, const std::string& name) const;
  double number(const std::string& group, const std::string& name) const;
  std::int64_t integer(const std::string& group, const std::string& name) const;
  std::vector<std::string> attributes(const std::string& group) const;  ///< names, sorted
  std::vector<std::string> children(const std::string& group) const;    ///< groups and data, sorted
  bool has(const std::string& path) const;

  Array<double> doubles(const std::string& path) const;
  Array<float> floats(const std::string& path) const;
  Array<std::int32_t> integers(const std::string& path) const;
  std::vector<std::string> texts(const std::string& path) const;
  Table table(const std::string& path) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace drawpoint::engine::record
