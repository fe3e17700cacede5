// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <IpoptConfig.h>

namespace drawpoint::kriging::detail {

/// The version of the Ipopt that this was compiled with, such as "3.11.9".
inline const char* ipopt_version() { return IPOPT_VERSION; }

}  // namespace drawpoint::kriging::detail
