// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether the simulator is the one that made a folder's runs, tried on one of them.
///
/// A fingerprint of files does not see a changed library, module or machine. So before a folder gets more runs,
/// one that is done is made again, where runs are made now, and compared bit by bit. With each resume it is another
/// one, of the half that took least time.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>

namespace drawpoint::studies {

/// Nothing where none is done, or settings.execution.spot_check is off. Requires an InterruptGuard. Throws
/// std::runtime_error that says what differs, Interrupted after a signal.
void spot_check(const Store& store, const Folder& folder, const Settings& settings, int message_descriptor);

}  // namespace drawpoint::studies
