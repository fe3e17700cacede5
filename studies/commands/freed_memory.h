// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace drawpoint::studies {

/// Lets the process keep memory that it frees for what it allocates next: blocks below 32 MB, which is the most
/// that the GNU C library takes, and up to 256 MB at the end of its heap. Each of the hundreds of searches that
/// polish a front takes some megabytes and gives them back, and a third of the time of a front goes into asking
/// the system for them otherwise. Does nothing with another C library, and where the environment says how
/// memory is to be kept (MALLOC_TRIM_THRESHOLD_, MALLOC_MMAP_THRESHOLD_, GLIBC_TUNABLES).
void keep_freed_memory();

}  // namespace drawpoint::studies
