// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/store/plain_text.h>

#include <cstdint>

namespace drawpoint::studies {
namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";

unsigned byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
}

/// Bytes of the character that begins the text; 0: no UTF-8 does.
std::size_t length_of_first(std::string_view text) {
  const unsigned first = byte_at(text, 0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte_at(text, k) & 0xC0u) != 0x80u) return 0;
  const unsigned second = byte_at(text, 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool none = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || none ? 0 : length;
}

std::uint32_t code_of(std::string_view character) {
  if (character.size() == 1) return byte_at(character, 0);
  std::uint32_t code = byte_at(character, 0) & (0xFFu >> (character.size() + 1));
  for (std::size_t k = 1; k < character.size(); ++k) code = code << 6 | (byte_at(character, k) & 0x3Fu);
  return code;
}

bool turns_direction(std::uint32_t code) {
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

/// U+2400 and the control character's own number; delete has 0x21.
std::string picture_of(std::uint32_t control) {
  const char third = static_cast<char>(0x80 + (control == 0x7F ? 0x21 : control));
  return std::string("\xE2\x90") + third;
}

std::string shown(std::string_view character) {
  const std::uint32_t code = code_of(character);
  if (code == '\n' || code == '\t') return std::string(character);
  if (code < 0x20 || code == 0x7F) return picture_of(code);
  if ((code >= 0x80 && code < 0xA0) || turns_direction(code) || code == 0x2028 || code == 0x2029)
    return replacement;
  return std::string(character);
}

constexpr const char* note_begins = " ... (cut: it has ";
constexpr std::size_t longest_note = 50;

/// Where the note begins of a text that was cut to `most` before; npos: it was not.
std::size_t note_in(std::string_view text, std::size_t most) {
  const std::size_t note = text.ends_with(" bytes)") ? text.rfind(note_begins) : text.npos;
  return note != text.npos && note <= most && text.size() - note <= longest_note ? note : text.npos;
}

}  // namespace

std::string plain_text(std::string_view text, std::size_t most) {
  if (const std::size_t note = note_in(text, most); note != text.npos)
    return plain_text(text.substr(0, note), most) +
           plain_text(text.substr(note + 1), longest_note).insert(0, 1, ' ');
  std::string plain;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of_first(text.substr(at));
    const std::string next = length == 0 ? replacement : shown(text.substr(at, length));
    if (plain.size() + next.size() > most)
      return plain + note_begins + std::to_string(text.size()) + " bytes)";
    plain += next;
    at += length == 0 ? 1 : length;
  }
  return plain;
}

}  // namespace drawpoint::studies
