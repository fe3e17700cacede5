// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// With DRAWPOINT_KRIGING_COMPILED defined in every file of a program, fit.hpp, model.hpp and optimize.hpp declare what
/// kriging/compiled.cpp defines once; without it they are headers like the others. The target
/// Drawpoint::kriging_compiled brings both. The source is compiled with the flags of the program, so that
/// Eigen's alignment is that of its other files.

#ifdef DRAWPOINT_KRIGING_COMPILED
#define DRAWPOINT_KRIGING_INLINE
#else
#define DRAWPOINT_KRIGING_INLINE inline
#endif
