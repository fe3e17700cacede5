// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace drawpoint::studies {

/// Lets the process keep memory that it frees, up to 256 MB, for what it allocates next. Each of the hundreds of
/// searches that polish a front takes some megabytes and gives them back; with the usual settings of the GNU C
/// library a third of the time of a front goes into asking the system for them. Elsewhere: does nothing.
void keep_freed_memory();

}  // namespace drawpoint::studies
