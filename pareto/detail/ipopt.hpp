// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Ipopt's headers, whose unused parameters would be warned of in programs that find them by pkg-config.

#pragma GCC system_header
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
