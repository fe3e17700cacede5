// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

/// Eigen as the public headers of the engine include it: with one alignment in the library and in its users' programs.
///
/// Eigen aligns fixed-size types, and allocates dynamic ones, by the widest vectors that the compiler flags allow:
/// 16 bytes and malloc on plain x86-64, 32 with AVX, 64 with AVX-512, a way of its own with the address sanitizer. A
/// program compiled with -march=native would lay out engine::Rock otherwise than the library and free its vectors in
/// another way. So the targets Drawpoint::contact and Drawpoint::engine, and their pkg-config files, define for whoever
/// links them what is true on plain x86-64: EIGEN_MAX_ALIGN_BYTES=16 and EIGEN_MALLOC_ALREADY_ALIGNED=1. AVX is still
/// used, on unaligned data. A program that reaches the headers without them does not compile
/// (docs/decisions/0020).
namespace drawpoint::engine {

static_assert(
    EIGEN_MAX_ALIGN_BYTES == 16 && EIGEN_MAX_STATIC_ALIGN_BYTES == 16 && EIGEN_MALLOC_ALREADY_ALIGNED == 1,
    "drawpoint: this file lays out or allocates Eigen types otherwise than the engine's library. Link "
    "Drawpoint::contact or Drawpoint::engine, use pkg-config drawpoint-engine, or define "
    "EIGEN_MAX_ALIGN_BYTES=16 and EIGEN_MALLOC_ALREADY_ALIGNED=1 before Eigen is included for the first "
    "time");

}  // namespace drawpoint::engine
