// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// What a program with DRAWPOINT_PARETO_COMPILED compiles once: detail/compiled.hpp.

#ifndef DRAWPOINT_PARETO_COMPILED
#error \
    "drawpoint: define DRAWPOINT_PARETO_COMPILED for all files of the program, or leave pareto/compiled.cpp out"
#endif

#include <drawpoint/pareto/detail/moead_definition.hpp>
#include <drawpoint/pareto/detail/nsga2_definition.hpp>
#include <drawpoint/pareto/detail/nsga3_definition.hpp>
#include <drawpoint/pareto/detail/search_definitions.hpp>
#include <drawpoint/pareto/detail/sms_emoa_definition.hpp>
