// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The folder that --with names, beside that of --out; neither is changed.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <string>

namespace drawpoint::studies {

/// The store of --with. Its options may be others; name and problem are the study's. Throws UsageError for
/// another study and for the folder of --out itself, std::runtime_error where there is none. `command` begins
/// the message.
Store store_of_other_folder(const std::string& command, const Study& study, const Settings& settings);

}  // namespace drawpoint::studies
