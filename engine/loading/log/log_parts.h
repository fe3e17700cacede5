// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/log_numbers.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <string>

/// The parts of a loading log in its file. Every number and array of numbers has the attributes "unit",
/// "description" and, where its numbers are in axes, "frame".
namespace drawpoint::engine::loading {

/// "group/0007".
std::string numbered(const std::string& group, std::size_t k);

/// Throws std::invalid_argument: what is to be written contradicts itself.
[[noreturn]] void contradiction(const std::string& what);

/// Throws std::runtime_error: what another program wrote, or a damaged file that its checksum does not know
/// of.
void require_fit(const record::Reader& file, bool fits, const std::string& data, const std::string& expected);

inline constexpr const char* world_frame =
    "world: x from the machine into the drift, y to the left, z up, floor at z = 0";

/// As described in CycleRecord; below `group`.
void write_cycle(record::Writer& file, const std::string& group, const CycleRecord& cycle);
CycleRecord read_cycle(const record::Reader& file, const std::string& group);

/// A number as data with its unit and description, and one of a file, which had it as an attribute up to
/// version 5.
void write_number(record::Writer& file, const std::string& path, double value, const LogNumber* meaning);
double read_number(const record::Reader& file, const std::string& group, const std::string& name);

/// Below "scene".
void write_scene(record::Writer& file, const SceneRecord& scene);
SceneRecord read_scene(const record::Reader& file, LogContent content);

}  // namespace drawpoint::engine::loading
