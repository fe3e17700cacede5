// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/aliasing.hpp>
#include <drawpoint/doe/augmented_latin_hypercube.hpp>
#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/doe/constrained.hpp>
#include <drawpoint/doe/constrained_latin_hypercube.hpp>
#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/d_optimal.hpp>
#include <drawpoint/doe/distribution.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/evaluate_options.hpp>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/doe/fractional_factorial.hpp>
#include <drawpoint/doe/full_factorial.hpp>
#include <drawpoint/doe/halton.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/lola_voronoi.hpp>
#include <drawpoint/doe/main_effects.hpp>
#include <drawpoint/doe/model_terms.hpp>
#include <drawpoint/doe/morris.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/orthogonal_array.hpp>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/process_pool.hpp>
#include <drawpoint/doe/processes.hpp>
#include <drawpoint/doe/propose.hpp>
#include <drawpoint/doe/propose_options.hpp>
#include <drawpoint/doe/quality.hpp>
#include <drawpoint/doe/region.hpp>
#include <drawpoint/doe/remembered.hpp>
#include <drawpoint/doe/response_surface_designs.hpp>
#include <drawpoint/doe/run_journal.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/doe/sensitivity.hpp>
#include <drawpoint/doe/slurm_array.hpp>
#include <drawpoint/doe/slurm_jobs.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/doe/value_and_jacobian.hpp>

/// Designed experiments over any black box: the whole of the module, in the order of use.
///
/// The problem and its runs:
///   problem.hpp                      named variables in a box, named responses with a goal each
///   bounds.hpp                       the box as two vectors, the levels of categories
///   black_box.hpp                    what may be called: f(x), f(x, seed), f(x, seed, stop), f(X, seeds)
///   outcome.hpp                      what a run gives: values, or a failure with its reason
///   value_and_jacobian.hpp           what a function with derivatives gives
///   seed.hpp                         seeds and counter-based random numbers
///   evaluate.hpp                     runs a black box at every row of a design
///   evaluate_options.hpp             threads, replicates, time limit, stop, journal, progress
///   evaluations.hpp                  the table of runs, as CSV too
///   run_journal.hpp                  runs on disk as they end; an interrupted evaluation resumes
///   remembered.hpp                   a black box that never makes a run twice: a store in memory or on disk
///   process_pool.hpp                 a program as a black box: each run a process of its own
///   processes.hpp                    the child processes beneath it
///   slurm_array.hpp                  a program as a black box on a Slurm cluster
///   slurm_jobs.hpp                   the tasks of job arrays beneath it
///
/// Designs:
///   latin_hypercube.hpp              one run in each of n strata of every variable; corners
///   optimized_latin_hypercube.hpp    the same, chosen for how evenly it fills the box
///   augmented_latin_hypercube.hpp    designs that grow, and nested ones
///   orthogonal_array.hpp             balance in several variables at once
///   sobol.hpp                        scrambled Sobol points
///   halton.hpp                       Halton points
///   uniform.hpp                      independent uniform points, for validation
///   full_factorial.hpp               every combination of levels
///   fractional_factorial.hpp         a fraction of the two-level combinations
///   aliasing.hpp                     which effects a fraction cannot tell apart
///   response_surface_designs.hpp     central composite and Box-Behnken
///   d_optimal.hpp                    the best runs for a polynomial, in any region, beside runs that there are
///   model_terms.hpp                  the terms of such a polynomial, as a matrix
///   region.hpp                       the part of the box where runs are allowed
///   constrained.hpp                  designs inside a region
///   constrained_latin_hypercube.hpp  a Latin hypercube inside a region
///   quality.hpp                      how good a design is: distances, discrepancies, correlation
///
/// Adaptive sampling:
///   adaptive.hpp                     first design, then batches where a criterion says, until it suffices
///   criterion.hpp                    what scores a candidate point, alone or with those of its batch; mixes
///   lola_voronoi.hpp                 run more where the response bends and where there are holes
///   propose.hpp                      the best of many candidates, moved uphill, kept apart
///   propose_options.hpp              batch, candidates, rule, where it is allowed
///
/// What the inputs do:
///   distribution.hpp                 how inputs are distributed that one cannot choose
///   morris.hpp                       elementary effects: which of many inputs matter at all
///   main_effects.hpp                 how the mean of a response moves with one input
///   sensitivity.hpp                  Sobol' indices with intervals, of one input and of two
///
/// Apart from these, and not included here because it needs nlohmann-json: problem_json.hpp, a problem as
/// JSON. What stands in detail/ may change in any version. Needs Eigen and a thread library.
namespace drawpoint::doe {}
