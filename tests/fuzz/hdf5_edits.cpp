// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/record/trailer.h>
#include <hdf5.h>
#include <drawpoint/tests/fuzz/hdf5_edits.hpp>
#include <drawpoint/tests/fuzz/own_folder.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace drawpoint::fuzz {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 16> hard_numbers = {0,
                                                 -1,
                                                 1,
                                                 std::numeric_limits<double>::quiet_NaN(),
                                                 infinity,
                                                 -infinity,
                                                 1e300,
                                                 5e-324,
                                                 1e9,
                                                 2147483647.0,
                                                 -2147483648.0,
                                                 0.5,
                                                 4294967296.0,
                                                 1e18,
                                                 3,
                                                 255};

struct Change {
  std::uint8_t object, what, where, number;
  double value() const { return hard_numbers[number % hard_numbers.size()]; }
};

std::vector<std::string> objects_in(hid_t file) {
  std::vector<std::string> names;
  const auto note = [](hid_t, const char* name, const H5O_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->push_back(name);
    return 0;
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, note, &names, H5O_INFO_BASIC);
  return names;
}

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_FLOAT || kind == H5T_INTEGER;
}

/// A dataset with its shape and, where it has some, its numbers.
struct Data {
  Data(hid_t file, const std::string& name) {
    const hid_t data = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    if (data < 0) return;
    const hid_t space = H5Dget_space(data), type = H5Dget_type(data);
    shape.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    numbers = is_number(type);
    if (numbers) {
      values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
      if (!values.empty()) H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      whole = H5Tget_class(type) == H5T_INTEGER;
    }
    there = true;
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(data);
  }

  /// In the place of what is there; its attributes go.
  void replace(hid_t file, const std::string& name) const {
    H5Ldelete(file, name.c_str(), H5P_DEFAULT);
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t data = H5Dcreate2(file, name.c_str(), whole ? H5T_STD_I32LE : H5T_IEEE_F64LE, space,
                                  H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (!values.empty()) H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(data);
    H5Sclose(space);
  }

  bool there = false, numbers = false, whole = false;
  std::vector<hsize_t> shape;
  std::vector<double> values;
};

void write_one(hid_t file, const std::string& name, const Change& change) {
  Data data(file, name);
  if (data.values.empty()) return;
  data.values[change.where % data.values.size()] = change.value();
  const hid_t open = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  H5Dwrite(open, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data());
  H5Dclose(open);
}

/// Another number of rows, another number of dimensions, or whole numbers for real ones.
void reshape(hid_t file, const std::string& name, const Change& change) {
  Data data(file, name);
  if (!data.there) return;
  if (change.what % 8 == 2 && !data.shape.empty()) data.shape[0] = change.where % 9;
  if (change.what % 8 == 3) data.shape.assign(1, change.where % 9);
  if (change.what % 8 == 4) data.whole = !data.whole;
  hsize_t count = 1;
  for (const hsize_t rows : data.shape) count *= rows;
  if (count > 100000) return;
  data.values.resize(static_cast<std::size_t>(count), change.value());
  data.replace(file, name);
}

/// Attribute `where` of the object: gone, another number, or another text.
void change_attribute(hid_t file, const std::string& name, const Change& change) {
  const hid_t object = H5Oopen(file, name.c_str(), H5P_DEFAULT);
  if (object < 0) return;
  H5O_info_t info;
  H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS);
  if (info.num_attrs > 0) {
    const hid_t attribute = H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC,
                                           change.where % info.num_attrs, H5P_DEFAULT, H5P_DEFAULT);
    std::array<char, 200> called = {};
    H5Aget_name(attribute, called.size(), called.data());
    const hid_t type = H5Aget_type(attribute);
    const double value = change.value();
    if (change.what % 8 == 5 && is_number(type)) H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
    const bool goes = change.what % 8 == 6;
    H5Tclose(type);
    H5Aclose(attribute);
    if (goes) H5Adelete(object, called.data());
  }
  H5Oclose(object);
}

void apply(hid_t file, const std::vector<std::string>& names, const Change& change) {
  const std::string& name = names[change.object % names.size()];
  switch (change.what % 8) {
    case 0:
      if (name != ".") H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      return;
    case 1:
    case 7:
      return write_one(file, name, change);
    case 2:
    case 3:
    case 4:
      return reshape(file, name, change);
    default:
      return change_attribute(file, name, change);
  }
}

void seal_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  std::vector<std::byte> image(text.size());
  std::transform(text.begin(), text.end(), image.begin(), [](char c) { return static_cast<std::byte>(c); });
  engine::record::detail::append_trailer(image);
  write(file, {reinterpret_cast<const std::uint8_t*>(image.data()), image.size()});
}

}  // namespace

void write_edited(const std::filesystem::path& sound, const std::filesystem::path& file, Bytes changes,
                  bool checked) {
  constexpr std::size_t most = 32;
  std::filesystem::copy_file(sound, file, std::filesystem::copy_options::overwrite_existing);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t open = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  for (std::size_t at = 0; at + 4 <= changes.size() && at < 4 * most; at += 4) {
    const std::vector<std::string> names = objects_in(open);
    if (names.empty()) break;
    apply(open, names, {changes[at], changes[at + 1], changes[at + 2], changes[at + 3]});
  }
  H5Fclose(open);
  if (checked) seal_file(file);
}

}  // namespace drawpoint::fuzz
