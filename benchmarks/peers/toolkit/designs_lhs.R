# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
#
# Latin hypercubes of R's lhs: Rscript designs_lhs.R RUNS SEEDS FOLDER writes KIND.SEED.csv (one run per line, unit box) and
# prints one line of JSON a design.
words <- commandArgs(trailingOnly = TRUE)
runs <- as.integer(words[1])
kinds <- list(maximinLHS = lhs::maximinLHS, improvedLHS = lhs::improvedLHS, randomLHS = lhs::randomLHS)
for (kind in names(kinds)) for (seed in seq_len(as.integer(words[2]))) {
  set.seed(seed)
  seconds <- sum(system.time(X <- kinds[[kind]](runs, 4))[1:2])
  path <- file.path(words[3], sprintf("%s.%d.csv", kind, seed))
  write.table(format(X, digits = 17), path, sep = ",", quote = FALSE, row.names = FALSE, col.names = FALSE)
  cat(sprintf('{"system": "lhs %s %s", "path": "%s", "cpu_s": %g}\n', packageVersion("lhs"), kind, path, seconds))
}
