// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The page finds Plotly in a script before its own.
declare const Plotly: any;
