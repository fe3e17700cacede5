// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <hdf5.h>

#include <drawpoint/engine/record/hdf5_support.h>
#include <drawpoint/engine/record/trailer.h>
#include <algorithm>
#include <drawpoint/engine/record/file.hpp>
#include <functional>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace drawpoint::engine::record {
namespace {

using detail::Element;
using detail::Handle;
using detail::Library;

constexpr const char* write_anew = "; delete it and let it be written anew";

// A stored attribute or array, before its meaning.
struct Raw {
  Element element = Element::real64;
  std::size_t length = 0;  // bytes of one element
  std::vector<std::size_t> shape;
  std::vector<std::byte> bytes;
};

std::optional<Element> element_of(hid_t type) {
  const std::size_t size = H5Tget_size(type);
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return size == 8 ? Element::real64 : Element::real32;
    case H5T_INTEGER:
      return size == 8 ? Element::int64 : Element::int32;
    case H5T_STRING:
      return H5Tis_variable_str(type) > 0 ? std::nullopt : std::optional(Element::text);
    default:
      return std::nullopt;
  }
}

// For reading what is stored: the library converts numbers, and no text into other characters.
Handle memory_type(hid_t stored, Element element) {
  const auto characters = element == Element::text && H5Tget_cset(stored) == H5T_CSET_ASCII
                              ? detail::Characters::ascii
                              : detail::Characters::utf8;
  return detail::element_type(element, H5Tget_size(stored), characters);
}

std::vector<std::size_t> shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extents(static_cast<std::size_t>(std::max(rank, 0)));
  if (!extents.empty()) H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return {extents.begin(), extents.end()};
}

std::size_t count_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::vector<std::string> names_of(hid_t group) {
  H5G_info_t info{};
  std::vector<std::string> names;
  if (H5Gget_info(group, &info) < 0) return names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    const auto size = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
    std::string name(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
    H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size() + 1, H5P_DEFAULT);
    names.push_back(name);
  }
  return names;
}

std::vector<std::string> attribute_names_of(hid_t object) {
  H5O_info_t info{};
  std::vector<std::string> names;
  if (H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS) < 0) return names;
  for (hsize_t k = 0; k < info.num_attrs; ++k) {
    const auto size = H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
    std::string name(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
    H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size() + 1, H5P_DEFAULT);
    names.push_back(name);
  }
  return names;
}

template <class T>
std::vector<T> values_of(const Raw& raw) {
  std::vector<T> values(raw.bytes.size() / sizeof(T));
  std::copy(raw.bytes.begin(), raw.bytes.end(), std::as_writable_bytes(std::span(values)).begin());
  return values;
}

std::string text_of(std::span<const std::byte> bytes) {
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

}  // namespace

struct Reader::State {
  std::filesystem::path path;
  Handle file;
  int version = 0;

  ~State() {
    const Library library;
    file.reset();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("record::Reader: \"" + path.string() + "\" " + what);
  }

  void open(Form form) {
    const std::string fault = form == Form::checked ? detail::trailer_fault(path) : std::string();
    if (!fault.empty()) fail(fault);
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access.get(), false, true);  // a finished file never changes
    file = {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
    if (!file.good()) fail("cannot be opened by HDF5" + std::string(write_anew));
  }

  Handle object(const std::string& at) const {
    Handle found(H5Oopen(file.get(), at.empty() ? "/" : at.c_str(), H5P_DEFAULT), H5Oclose);
    if (!found.good()) fail("has no \"/" + at + "\"; it was written by another program or version");
    return found;
  }

  // As h5py stores a str.
  Raw variable_text(hid_t attribute, const std::string& at, const std::string& name) const {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), H5T_VARIABLE);
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    char* text = nullptr;
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.get()) != 1 || H5Aread(attribute, type.get(), &text) < 0)
      fail("is damaged at attribute \"" + name + "\" of \"/" + at + "\"" + write_anew);
    const std::string_view read = text ? text : "";
    Raw raw{Element::text, read.size(), {}, {}};
    raw.bytes.resize(read.size());
    std::copy(read.begin(), read.end(), reinterpret_cast<char*>(raw.bytes.data()));
    H5free_memory(text);
    return raw;
  }

  Raw attribute(hid_t owner, const std::string& at, const std::string& name) const {
    const Handle found(H5Aopen(owner, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!found.good()) fail("has no attribute \"" + name + "\" of \"/" + at + "\"; another program wrote it");
    const Handle stored(H5Aget_type(found.get()), H5Tclose);
    if (H5Tis_variable_str(stored.get()) > 0) return variable_text(found.get(), at, name);
    const auto element = element_of(stored.get());
    if (!element) fail("has an attribute \"" + name + "\" of an unknown type; another program wrote it");
    Raw raw{*element, H5Tget_size(stored.get()), {}, {}};
    const Handle space(H5Aget_space(found.get()), H5Sclose);
    raw.bytes.resize(raw.length * static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
    if (H5Aread(found.get(), memory_type(stored.get(), *element).get(), raw.bytes.data()) < 0)
      fail("is damaged at attribute \"" + name + "\" of \"/" + at + "\"" + write_anew);
    return raw;
  }

  // Type and shape of an array, without its bytes.
  Raw description(hid_t data, const std::string& at) const {
    const Handle stored(H5Dget_type(data), H5Tclose);
    const Handle space(H5Dget_space(data), H5Sclose);
    const auto element = stored.good() && space.good() ? element_of(stored.get()) : std::nullopt;
    if (!element) fail("holds data of an unknown type at \"/" + at + "\"; another program wrote it");
    return {*element, H5Tget_size(stored.get()), shape_of(space.get()), {}};
  }

  // Returns the version.
  int verify(const FileKind& kind) const {
    const Handle root = object("");
    if (H5Aexists(root.get(), detail::format_name) <= 0 || H5Aexists(root.get(), detail::version_name) <= 0)
      fail("is no " + kind.format + ": it names no format; give a file that Drawpoint wrote");
    const std::string format = text_of(attribute(root.get(), "", detail::format_name).bytes);
    if (format != kind.format) fail("is a " + format + ", not a " + kind.format + "; give the right file");
    const auto version = values_of<std::int64_t>(attribute(root.get(), "", detail::version_name));
    const std::string oldest = kind.oldest < kind.version ? std::to_string(kind.oldest) + " to " : "";
    if (version.size() != 1 || version[0] < kind.oldest || version[0] > kind.version)
      fail("has version " + (version.empty() ? "?" : std::to_string(version[0])) + " of its format, not " +
           oldest + std::to_string(kind.version) + "; let it be written anew by this program");
    return static_cast<int>(version[0]);
  }

  Raw array(const std::string& data_path, Element wanted) const {
    const std::string at = detail::plain_path(data_path);
    const Handle data = object(at);
    if (H5Iget_type(data.get()) != H5I_DATASET) fail("has a group, not data, at \"/" + at + "\"");
    Raw raw = description(data.get(), at);
    if (raw.element != wanted)
      fail("holds " + detail::numpy_name(raw.element) + " at \"/" + at + "\", not " +
           detail::numpy_name(wanted) + "; let it be written as that");
    raw.bytes.resize(raw.length * count_of(raw.shape));
    const Handle type = memory_type(Handle(H5Dget_type(data.get()), H5Tclose).get(), wanted);
    if (!raw.bytes.empty() &&
        H5Dread(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.bytes.data()) < 0)
      fail("is damaged at \"/" + at + "\"" + write_anew);
    return raw;
  }

  Raw group_attribute(const std::string& group, const std::string& name, Element wanted) const {
    const std::string at = detail::plain_path(group);
    Raw raw = attribute(object(at).get(), at, name);
    if (raw.element != wanted)
      fail("has an attribute \"" + name + "\" of another type; read it as what it is");
    return raw;
  }
};

Reader::Reader(std::filesystem::path path, const FileKind& kind, Form form)
    : state_(std::make_unique<State>()) {
  const Library library;
  state_->path = std::move(path);
  state_->open(form);
  state_->version = state_->verify(kind);
}

Reader::~Reader() = default;

const std::filesystem::path& Reader::path() const { return state_->path; }

int Reader::version() const { return state_->version; }

std::string Reader::text(const std::string& group, const std::string& name) const {
  const Library library;
  return text_of(state_->group_attribute(group, name, Element::text).bytes);
}

double Reader::number(const std::string& group, const std::string& name) const {
  const Library library;
  return values_of<double>(state_->group_attribute(group, name, Element::real64)).at(0);
}

std::int64_t Reader::integer(const std::string& group, const std::string& name) const {
  const Library library;
  return values_of<std::int64_t>(state_->group_attribute(group, name, Element::int64)).at(0);
}

std::vector<std::string> Reader::attributes(const std::string& group) const {
  const Library library;
  const std::string at = detail::plain_path(group);
  std::vector<std::string> names = attribute_names_of(state_->object(at).get());
  if (at.empty())
    std::erase_if(names, [](const std::string& name) {
      return name == detail::format_name || name == detail::version_name;
    });
  return names;
}

std::vector<std::string> Reader::children(const std::string& group) const {
  const Library library;
  return names_of(state_->object(detail::plain_path(group)).get());
}

bool Reader::has(const std::string& path) const {
  const Library library;
  const std::string at = detail::plain_path(path);
  return at.empty() || Handle(H5Oopen(state_->file.get(), at.c_str(), H5P_DEFAULT), H5Oclose).good();
}

Array<double> Reader::doubles(const std::string& path) const {
  const Library library;
  const Raw raw = state_->array(path, Element::real64);
  return {values_of<double>(raw), raw.shape};
}

Array<float> Reader::floats(const std::string& path) const {
  const Library library;
  const Raw raw = state_->array(path, Element::real32);
  return {values_of<float>(raw), raw.shape};
}

Array<std::int32_t> Reader::integers(const std::string& path) const {
  const Library library;
  const Raw raw = state_->array(path, Element::int32);
  return {values_of<std::int32_t>(raw), raw.shape};
}

std::vector<std::string> Reader::texts(const std::string& path) const {
  const Library library;
  const Raw raw = state_->array(path, Element::text);
  std::vector<std::string> values;
  for (std::size_t at = 0; at + raw.length <= raw.bytes.size(); at += raw.length)
    values.push_back(text_of(std::span(raw.bytes).subspan(at, raw.length)));
  return values;
}

Table Reader::table(const std::string& path) const {
  const Library library;
  const std::vector<std::string> names = texts(path + "/columns"), units = texts(path + "/units");
  Array<double> values = doubles(path + "/values");
  std::vector<std::string> descriptions(names.size());  // files of before have none
  if (has(path + "/descriptions")) descriptions = texts(path + "/descriptions");
  if (names.size() != units.size() || names.size() != descriptions.size() || values.shape.size() != 2 ||
      values.shape[1] != names.size())
    state_->fail("has a table at \"" + path + "\" whose parts do not fit; another program wrote it");
  Table table;
  for (std::size_t k = 0; k < names.size(); ++k)
    table.columns.push_back({names[k], units[k], descriptions[k]});
  table.values = std::move(values.values);
  return table;
}

}  // namespace drawpoint::engine::record
