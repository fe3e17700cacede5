// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/program/program_reply.h>
#include <drawpoint/studies/run/program/strict_json.h>
#include <drawpoint/studies/run/store/plain_text.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drawpoint::studies {
namespace {

using nlohmann::json;

/// JSON in a few words, for a message.
std::string brief(const json& value) {
  return plain_text(value.dump(-1, ' ', false, json::error_handler_t::replace), 200);
}

Attempt values_of(const doe::Problem& problem, const json& values) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(problem.responses.size()));
  for (std::size_t j = 0; j < problem.responses.size(); ++j) {
    const std::string& name = problem.responses[j].name;
    if (!values.contains(name)) return Crash{"its reply has no value for \"" + name + "\""};
    if (!values[name].is_number())
      return Crash{"its reply has " + brief(values[name]) + " for \"" + name + "\", which is no number"};
    y[static_cast<Eigen::Index>(j)] = values[name].get<double>();
  }
  return doe::Outcome(y);
}

}  // namespace

Attempt reply_of(const std::string& text, const doe::Problem& problem) {
  json reply;
  try {
    reply = strict_json(text);
  } catch (const std::runtime_error& e) {
    return Crash{plain_text(std::string("its reply ") + e.what())};
  }
  const bool failed = reply.is_object() && reply.contains("failure");
  if (failed == (reply.is_object() && reply.contains("values")))
    return Crash{R"(its reply is not one of {"values": {...}} and {"failure": "..."})"};
  if (!failed && reply["values"].is_object()) return values_of(problem, reply["values"]);
  if (!failed || !reply["failure"].is_string() || reply["failure"].get<std::string>().empty())
    return Crash{"its reply has " + std::string(failed ? "no text as failure" : "no object as values")};
  return doe::Outcome(doe::Failure{plain_text(reply["failure"].get<std::string>())});
}

}  // namespace drawpoint::studies
