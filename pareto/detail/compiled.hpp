// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// With DRAWPOINT_PARETO_COMPILED defined in every file of a program, the searches' headers declare what
/// pareto/compiled.cpp defines once; without it they are headers like the others. The target
/// Drawpoint::pareto_compiled brings both. The source is compiled with the flags of the program, so that
/// Eigen's alignment is that of its other files.

#ifdef DRAWPOINT_PARETO_COMPILED
#define DRAWPOINT_PARETO_INLINE
#else
#define DRAWPOINT_PARETO_INLINE inline
#endif
