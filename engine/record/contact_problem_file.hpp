// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <filesystem>
#include <memory>
#include <string>

/// A contact problem in a file: everything that a method needs to solve it again, bit for bit.
///
/// Format "drawpoint contact problem", version 3, in the form of record/file.hpp (HDF5, checksummed, written
/// whole or not at all). The root has the step [s], a note and the law in words; /bodies, /pairs, /points
/// and, with a machine, /machine hold one array per field of contact_problem.hpp, the index of the body, pair
/// or point first, float64 or int32, each with attributes "unit" and "description". What solving puts out is
/// not in the file. docs/explanation/contact-solving.md lists the fields. Versions 1 and 2, which are read still, store
/// matrices by columns; version 1 calls bodies/external_velocity_change bodies/push.
///
/// A problem is checked when written and when read: counts agree, indices are in range, numbers are finite,
/// the step is positive, normals are unit, limits are ordered. Size: about 150 bytes per point.
namespace drawpoint::engine::record {

/// The machine lives on the heap, so copies and moves of this keep problem.machine valid.
struct RecordedProblem {
  engine::ContactProblem problem;
  std::shared_ptr<const engine::SuperBody> machine;  ///< none: nullptr
  std::string note;                                  ///< where the problem comes from
};

/// Before it is solved: World::before_solve gives it. Throws std::invalid_argument if it contradicts itself,
/// std::runtime_error if it cannot be written.
void write_contact_problem(const std::filesystem::path& path, const engine::ContactProblem& problem,
                           const std::string& note = {});

/// Throws std::runtime_error, with the file, the field, the row and the value, if the file cannot be read,
/// is damaged or holds no sound problem.
RecordedProblem read_contact_problem(const std::filesystem::path& path);

/// The same arrays in a plain file (record/file.hpp), for and from other programs. Errors as above; an import
/// is checked as a problem, but has no checksum that shows damage.
void export_contact_problem(const std::filesystem::path& path, const engine::ContactProblem& problem,
                            const std::string& note = {});
RecordedProblem import_contact_problem(const std::filesystem::path& path);

/// Hash of all that is in a file but the note: equal problems have equal hashes, whatever version of the format they
/// come from. Not for security.
std::uint64_t problem_hash(const engine::ContactProblem& problem);

}  // namespace drawpoint::engine::record
