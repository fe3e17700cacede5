// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What reader and writer share: handles of the HDF5 library, its lock and paths. Private to
/// engine/record; the library's own header stays out of headers (an HDF5 identifier is a 64-bit integer).
namespace drawpoint::engine::record::detail {

using Id = std::int64_t;

/// Closes what it holds.
class Handle {
 public:
  using Close = int (*)(Id);
  Handle() = default;
  Handle(Id id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() { reset(); }
  void reset() {
    if (id_ >= 0) close_(std::exchange(id_, -1));
  }
  Id get() const { return id_; }
  bool good() const { return id_ >= 0; }

 private:
  Id id_ = -1;
  Close close_ = nullptr;
};

/// One thread at a time in the library, and the library silent: it is not thread-safe and prints its errors.
/// Errors are told by exceptions instead; the caller's setting comes back.
class Library {
 public:
  Library();
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

 private:
  std::unique_lock<std::recursive_mutex> lock_;
  int (*printer_)(Id, void*) = nullptr;
  void* printer_data_ = nullptr;
};

enum class Element : std::int32_t { real64 = 1, real32 = 2, int32 = 3, int64 = 4, text = 5 };

/// What a text is said to be; its bytes are UTF-8 in either. Data is said to be ASCII: Octave loads no other
/// text, and none of a file that has other.
enum class Characters : std::int32_t { ascii = 0, utf8 = 1 };

/// The library's type; for text of `length` bytes, at least 1.
Handle element_type(Element element, std::size_t length = 0, Characters characters = Characters::utf8);
/// As NumPy says: "float64".
std::string numpy_name(Element element);
std::size_t element_size(Element element, std::size_t length = 0);

/// Without leading and trailing "/"; the root is "".
std::string plain_path(std::string_view path);
std::string joined(std::string_view group, std::string_view name);

/// Names that belong to the file itself.
inline constexpr const char* format_name = "format";
inline constexpr const char* version_name = "version";

}  // namespace drawpoint::engine::record::detail
