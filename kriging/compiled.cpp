// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// What a program with DRAWPOINT_KRIGING_COMPILED compiles once: detail/compiled.hpp.

#ifndef DRAWPOINT_KRIGING_COMPILED
#error \
    "drawpoint: define DRAWPOINT_KRIGING_COMPILED for all files of the program, or leave kriging/compiled.cpp out"
#endif

#include <drawpoint/kriging/detail/first_design.hpp>
#include <drawpoint/kriging/detail/fit_definition.hpp>
#include <drawpoint/kriging/detail/model_definitions.hpp>
#include <drawpoint/kriging/detail/nearest/fit_definition.hpp>
#include <drawpoint/kriging/detail/next_run.hpp>
#include <drawpoint/kriging/detail/optimum_found.hpp>
