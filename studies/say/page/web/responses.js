// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Which responses are looked at. Standard errors that runs tell of others stand in the tables of runs alone.

/// The responses that are no standard error of another one, {response, j}.
export const own = (responses) =>
  responses.map((response, j) => ({response, j})).filter(({response}) => !response.is_error);
