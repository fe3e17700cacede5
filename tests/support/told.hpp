// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

/// What a refused call tells its caller.
namespace drawpoint::support {

/// The message of the refusal; "taken" where there is none. Another exception goes on to the test.
template <class Refusal = std::invalid_argument>
std::string told(const std::function<void()>& call) {
  try {
    call();
    return "taken";
  } catch (const Refusal& error) {
    return error.what();
  }
}

/// Expects a refusal with all these words.
template <class Refusal = std::invalid_argument>
void expect_told(const std::function<void()>& call, const std::vector<std::string>& words) {
  const std::string what = told<Refusal>(call);
  for (const std::string& word : words)
    EXPECT_NE(what.find(word), std::string::npos) << what << "\nlacks " << word;
}

}  // namespace drawpoint::support
