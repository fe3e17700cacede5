// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is read from strangers, each reader with any bytes: it takes them, or refuses them with
/// std::runtime_error or std::invalid_argument. Anything else is a fault, and so is what a sanitizer sees.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace drawpoint::fuzz {

using Bytes = std::span<const std::uint8_t>;
using Read = void (*)(Bytes);

inline std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// First byte even: a study.db as it is. Odd: lines "KEY TAB VALUE" that go into the table `study` of a sound
/// store, and "run TAB COLUMN TAB VALUE" into its first run, under checksums that fit.
void read_store(Bytes bytes);
/// A study as a JSON file, with an empty folder around it.
void read_study_file(Bytes bytes);
/// First byte even: the reply of a simulator. Odd: what the process of a run says to the driver.
void read_reply(Bytes bytes);
/// First byte even: a table of --import. Odd: one of tell.
void read_table(Bytes bytes);
/// Changes of a sound loading log (hdf5_edits.hpp), under a checksum that fits; then its figures.
void read_run_log(Bytes bytes);
/// Changes of a sound contact problem, which is then read.
void read_contact_problem(Bytes bytes);
/// What a client says to the live page.
void read_question(Bytes bytes);

/// By the folder of their corpus.
inline constexpr std::array<std::pair<const char*, Read>, 7> readers = {
    {{"store", read_store},
     {"study_file", read_study_file},
     {"reply", read_reply},
     {"table", read_table},
     {"run_log", read_run_log},
     {"contact_problem", read_contact_problem},
     {"live_page", read_question}}};

}  // namespace drawpoint::fuzz
