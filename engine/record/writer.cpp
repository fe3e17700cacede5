// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <hdf5.h>

#include <drawpoint/engine/record/hdf5_support.h>
#include <drawpoint/engine/record/trailer.h>
#include <algorithm>
#include <drawpoint/engine/base/atomic_file.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace drawpoint::engine::record {
namespace {

using detail::Element;
using detail::Handle;
using detail::Library;

using Bytes = std::span<const std::byte>;

void require_good(bool good, const std::string& what) {
  if (!good) throw std::runtime_error("record::Writer: HDF5 cannot " + what + "; check the free memory");
}

// Equal contents shall be equal files, so no times are stored.
Handle creation(hid_t kind) {
  Handle list(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(list.get(), false);
  return list;
}

Handle memory_file(const std::string& name) {
  constexpr std::size_t growth = 4u << 20;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), growth, false);
  // From 1.8 on the format checks its own metadata; from 1.10 on it also marks files that are being written.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  return {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation(H5P_FILE_CREATE).get(), access.get()), H5Fclose};
}

// One dimension where no shape is given.
std::vector<std::size_t> shape_or_count(std::vector<std::size_t> shape, std::size_t count) {
  return shape.empty() ? std::vector{count} : std::move(shape);
}

// Whole trailing dimensions first, up to about 32 768 numbers a chunk.
std::vector<hsize_t> chunk_of(const std::vector<std::size_t>& shape) {
  std::size_t room = 32768;
  std::vector<hsize_t> chunk(shape.size());
  for (std::size_t k = shape.size(); k-- > 0;) {
    const std::size_t extent = std::clamp<std::size_t>(shape[k], 1, room);
    chunk[k] = extent;
    room = std::max<std::size_t>(room / extent, 1);
  }
  return chunk;
}

Handle array_creation(const std::vector<std::size_t>& shape, std::size_t count, Form form) {
  Handle list = creation(H5P_DATASET_CREATE);
  if (count == 0 || shape.empty() || form == Form::plain) return list;
  const std::vector<hsize_t> chunk = chunk_of(shape);
  H5Pset_chunk(list.get(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(list.get());
  H5Pset_deflate(list.get(), 1);
  return list;
}

// The bytes of a file in memory. H5Fget_file_image would clear a flag in the superblock without renewing the
// superblock's checksum, and such a copy cannot be opened; the driver's own buffer is right.
std::vector<std::byte> image_of(hid_t file) {
  require_good(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, "finish a file in memory");
  const auto size = H5Fget_file_image(file, nullptr, 0);
  void* buffer = nullptr;
  require_good(size > 0 && H5Fget_vfd_handle(file, H5P_DEFAULT, &buffer) >= 0, "give a file in memory");
  const auto* bytes = *static_cast<const std::byte* const*>(buffer);
  return {bytes, bytes + size};
}

}  // namespace

struct Writer::State {
  std::filesystem::path target;
  Form form = Form::checked;
  Handle file;

  ~State() {
    const Library library;
    file.reset();
  }

  void require_open() const {
    if (!file.good())
      throw std::invalid_argument("record::Writer: \"" + target.string() +
                                  "\" is committed already; make a new writer");
  }

  bool exists(const std::string& path) const {
    return path.empty() || H5Lexists(file.get(), path.c_str(), H5P_DEFAULT) > 0;
  }

  Handle group(const std::string& path) {
    if (path.empty()) return {H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose};
    group(path.substr(0, path.rfind('/') == std::string::npos ? 0 : path.rfind('/')));
    if (exists(path)) {
      Handle old(H5Gopen2(file.get(), path.c_str(), H5P_DEFAULT), H5Gclose);
      if (!old.good())
        throw std::invalid_argument("record::Writer: \"" + path +
                                    "\" is data, not a group; choose another name");
      return old;
    }
    Handle made(
        H5Gcreate2(file.get(), path.c_str(), H5P_DEFAULT, creation(H5P_GROUP_CREATE).get(), H5P_DEFAULT),
        H5Gclose);
    require_good(made.good(), "make group \"" + path + "\"");
    return made;
  }

  // An attribute of an open object.
  void attribute(hid_t object, const std::string& name, Element element, Bytes bytes) const {
    const Handle type = detail::element_type(element, bytes.size());
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle made(H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
    const std::byte nothing{0};  // an empty text is stored as one null byte
    require_good(
        made.good() && H5Awrite(made.get(), type.get(), bytes.empty() ? &nothing : bytes.data()) >= 0,
        "write attribute \"" + name + "\"");
  }

  void group_attribute(const std::string& group_path, const std::string& name, Element element, Bytes bytes) {
    require_open();
    const std::string path = detail::plain_path(group_path);
    const Handle object = group(path);
    if (H5Aexists(object.get(), name.c_str()) > 0)
      throw std::invalid_argument("record::Writer: attribute \"" + name + "\" of \"/" + path +
                                  "\" is written twice; write it once");
    attribute(object.get(), name, element, bytes);
  }

  void array(const std::string& data_path, Element element, Bytes bytes, std::vector<std::size_t> shape,
             std::size_t length = 0);
};

void Writer::State::array(const std::string& data_path, Element element, Bytes bytes,
                          std::vector<std::size_t> shape, std::size_t length) {
  require_open();
  const std::string path = detail::plain_path(data_path);
  const std::size_t count = bytes.size() / detail::element_size(element, length);
  if (std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()) != count)
    throw std::invalid_argument("record::Writer: \"" + path + "\" has " + std::to_string(count) +
                                " values, not as many as its shape; give the shape of the values");
  if (exists(path))
    throw std::invalid_argument("record::Writer: \"" + path + "\" is written twice; choose another name");
  group(path.substr(0, path.rfind('/') == std::string::npos ? 0 : path.rfind('/')));
  const Handle type = detail::element_type(element, length, detail::Characters::ascii);
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  const Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
  const Handle list = array_creation(shape, count, form);
  const Handle made(
      H5Dcreate2(file.get(), path.c_str(), type.get(), space.get(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
      H5Dclose);
  require_good(made.good(), "make \"" + path + "\"");
  if (count > 0)
    require_good(H5Dwrite(made.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0,
                 "write \"" + path + "\"");
}

Writer::Writer(std::filesystem::path target, const FileKind& kind, Form form)
    : state_(std::make_unique<State>()) {
  const Library library;
  state_->form = form;
  state_->target = std::move(target);
  state_->file = memory_file(state_->target.string());
  require_good(state_->file.good(), "make a file in memory");
  text("/", detail::format_name, kind.format);
  integer("/", detail::version_name, kind.version);
}

Writer::~Writer() = default;

void Writer::text(const std::string& group, const std::string& name, const std::string& value) {
  const Library library;
  // Texts are stored padded with null bytes, so trailing ones are not part of them.
  const std::string_view kept(value.data(), value.find_last_not_of('\0') + 1);
  state_->group_attribute(group, name, Element::text, std::as_bytes(std::span(kept)));
}

void Writer::number(const std::string& group, const std::string& name, double value) {
  const Library library;
  state_->group_attribute(group, name, Element::real64, std::as_bytes(std::span(&value, 1)));
}

void Writer::integer(const std::string& group, const std::string& name, std::int64_t value) {
  const Library library;
  state_->group_attribute(group, name, Element::int64, std::as_bytes(std::span(&value, 1)));
}

void Writer::array(const std::string& path, std::span<const double> values, std::vector<std::size_t> shape) {
  const Library library;
  state_->array(path, Element::real64, std::as_bytes(values),
                shape_or_count(std::move(shape), values.size()));
}

void Writer::array(const std::string& path, std::span<const float> values, std::vector<std::size_t> shape) {
  const Library library;
  state_->array(path, Element::real32, std::as_bytes(values),
                shape_or_count(std::move(shape), values.size()));
}

void Writer::array(const std::string& path, std::span<const std::int32_t> values,
                   std::vector<std::size_t> shape) {
  const Library library;
  state_->array(path, Element::int32, std::as_bytes(values), shape_or_count(std::move(shape), values.size()));
}

void Writer::scalar(const std::string& path, double value) {
  const Library library;
  state_->array(path, Element::real64, std::as_bytes(std::span(&value, 1)), {});
}

void Writer::scalar(const std::string& path, const std::string& value) {
  const Library library;
  const std::string stored = value.empty() ? std::string(1, '\0') : value;
  state_->array(path, Element::text, std::as_bytes(std::span(stored)), {}, stored.size());
}

void Writer::texts(const std::string& path, const std::vector<std::string>& values) {
  const Library library;
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::vector<char> padded(length * values.size(), '\0');
  for (std::size_t k = 0; k < values.size(); ++k)
    std::copy(values[k].begin(), values[k].end(), padded.begin() + static_cast<std::ptrdiff_t>(k * length));
  state_->array(path, Element::text, std::as_bytes(std::span(padded)), {values.size()}, length);
}

void Writer::table(const std::string& path, const Table& table) {
  const Library library;
  if (table.values.size() != table.rows() * table.columns.size())
    throw std::invalid_argument("record::Writer: table \"" + path + "\" has " +
                                std::to_string(table.values.size()) + " values in " +
                                std::to_string(table.columns.size()) + " columns; append whole rows");
  std::vector<std::string> names, units, descriptions;
  for (const Column& column : table.columns) {
    names.push_back(column.name);
    units.push_back(column.unit);
    descriptions.push_back(column.description);
  }
  texts(path + "/columns", names);
  texts(path + "/units", units);
  texts(path + "/descriptions", descriptions);
  array(path + "/values", std::span(table.values), {table.rows(), table.columns.size()});
}

void Writer::group(const std::string& path) {
  const Library library;
  state_->require_open();
  state_->group(detail::plain_path(path));
}

void Writer::describe(const std::string& data, const std::string& unit, const std::string& description,
                      const std::string& frame) {
  const Library library;
  state_->require_open();
  const std::string path = detail::plain_path(data);
  const Handle object(H5Dopen2(state_->file.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!object.good())
    throw std::invalid_argument("record::Writer: there is no data \"" + path +
                                "\" to describe; write it first");
  state_->attribute(object.get(), "unit", Element::text, std::as_bytes(std::span(unit)));
  state_->attribute(object.get(), "description", Element::text, std::as_bytes(std::span(description)));
  if (!frame.empty())
    state_->attribute(object.get(), "frame", Element::text, std::as_bytes(std::span(frame)));
}

void Writer::commit(const std::function<void(const std::filesystem::path&)>& check) {
  const Library library;
  state_->require_open();
  std::vector<std::byte> image = image_of(state_->file.get());
  state_->file.reset();
  if (state_->form == Form::checked) detail::append_trailer(image);
  write_atomically(state_->target, image, check);
}

}  // namespace drawpoint::engine::record
