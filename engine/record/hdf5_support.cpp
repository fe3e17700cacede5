// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <hdf5.h>

#include <drawpoint/engine/record/hdf5_support.h>
#include <algorithm>
#include <type_traits>

namespace drawpoint::engine::record::detail {

static_assert(std::is_same_v<Id, hid_t> && std::is_same_v<int, herr_t>,
              "record: handles assume HDF5 1.10 or later, whose identifiers are 64-bit integers");
static_assert(static_cast<int>(Characters::ascii) == H5T_CSET_ASCII &&
              static_cast<int>(Characters::utf8) == H5T_CSET_UTF8);

namespace {

std::recursive_mutex& library_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

Library::Library() : lock_(library_mutex()) {
  H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Library::~Library() { H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_); }

Handle element_type(Element element, std::size_t length, Characters characters) {
  switch (element) {
    case Element::real64:
      return {H5Tcopy(H5T_IEEE_F64LE), H5Tclose};
    case Element::real32:
      return {H5Tcopy(H5T_IEEE_F32LE), H5Tclose};
    case Element::int32:
      return {H5Tcopy(H5T_STD_I32LE), H5Tclose};
    case Element::int64:
      return {H5Tcopy(H5T_STD_I64LE), H5Tclose};
    case Element::text:
      break;
  }
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), element_size(Element::text, length));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), static_cast<H5T_cset_t>(characters));
  return type;
}

std::string numpy_name(Element element) {
  switch (element) {
    case Element::real64:
      return "float64";
    case Element::real32:
      return "float32";
    case Element::int32:
      return "int32";
    case Element::int64:
      return "int64";
    case Element::text:
      break;
  }
  return "text";
}

std::size_t element_size(Element element, std::size_t length) {
  if (element == Element::text) return std::max<std::size_t>(length, 1);
  return element == Element::real64 || element == Element::int64 ? 8 : 4;
}

std::string plain_path(std::string_view path) {
  while (!path.empty() && path.front() == '/') path.remove_prefix(1);
  while (!path.empty() && path.back() == '/') path.remove_suffix(1);
  return std::string(path);
}

std::string joined(std::string_view group, std::string_view name) {
  return group.empty() ? std::string(name) : std::string(group) + "/" + std::string(name);
}

}  // namespace drawpoint::engine::record::detail
