// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The site on 127.0.0.1, until a signal comes.
///
/// It answers GET and HEAD, and only where the Host that was asked for is 127.0.0.1 or localhost with its
/// port: a page of another site whose name is made to lead here (DNS rebinding) gets nothing. Others on the
/// same machine do.

#include <drawpoint/studies/say/live/site.h>

#include <functional>
#include <string>

namespace drawpoint::studies {

/// port: 0 for any that is free. `started` is told the port. Returns after SIGINT, SIGTERM or SIGHUP, when
/// what was being answered is answered; where a client takes longer than three seconds, ends the process with
/// code 0. Throws std::runtime_error that names the port where it cannot be had.
void serve(Site& site, int port, const std::function<void(int port)>& started);

/// Version of the HTTP library, such as "0.11.4".
std::string http_version();

}  // namespace drawpoint::studies
