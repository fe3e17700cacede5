// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a fraction of a two-level factorial can tell apart: generators, defining relation, resolution,
/// aliases.
///
/// Variables are called A, B, C, ... in their order, I left out. The first k of them are free; each
/// generator, such as "E=ABC" or "E=-ABC", makes one further variable the product of free ones. The products
/// of generators form the defining relation, a group of 2^(d-k) - 1 words that are constant over the design;
/// the resolution is the length of its shortest word (Box, Hunter 1961). Effects whose product is such a word
/// cannot be told apart. Among designs the one of minimum aberration has the fewest shortest words, then the
/// fewest of the next length (Fries, Hunter 1980).

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drawpoint::doe {

/// Report on a fraction of d variables.
struct Aliasing {
  int resolution = 0;                       ///< 0: a full factorial, nothing is aliased
  std::vector<std::string> defining_words;  ///< such as "ABCE" or "-ABCE", short ones first
  std::vector<int> word_counts;             ///< words of length 0..d
  std::vector<std::string> aliases;  ///< main effects and pairs with theirs, such as "AB = CE", up to pairs
};

namespace detail {

inline constexpr std::string_view factor_letters = "ABCDEFGHJKLMNOPQRSTUVWXYZ";

/// A product of variables as bits, bit j the variable j, and its sign.
struct Word {
  std::uint32_t factors = 0;
  bool negative = false;

  friend Word operator*(Word a, Word b) { return {a.factors ^ b.factors, a.negative != b.negative}; }
  friend bool operator==(Word a, Word b) { return a.factors == b.factors && a.negative == b.negative; }
  int length() const { return std::popcount(factors); }

  /// A in the highest bit: among words of one length the larger comes first in the alphabet.
  std::uint32_t mirrored() const {
    std::uint32_t bits = 0;
    for (std::uint32_t j = 0; j < 32; ++j) bits |= (factors >> j & 1U) << (31 - j);
    return bits;
  }
};

inline std::string word_text(Word word) {
  std::string text = word.negative ? "-" : "";
  for (std::size_t j = 0; j < factor_letters.size(); ++j)
    if (word.factors >> j & 1U) text += factor_letters[j];
  return text;
}

[[noreturn]] inline void reject_generator(const std::string& generator, const std::string& why) {
  throw std::invalid_argument("doe::fractional_factorial: generator \"" + generator + "\" " + why);
}

/// The product on the right of the generator of variable j, over the first `free` variables.
inline Word generated_word(const std::string& generator, std::size_t j, std::size_t free) {
  const std::string letter(1, factor_letters[j]);
  if (generator.size() < 3 || generator[0] != letter[0] || generator[1] != '=')
    reject_generator(generator, "does not read \"" + letter + "=...\"; one generator a variable, in order");
  Word word{0, generator[2] == '-'};
  for (std::size_t k = word.negative ? 3 : 2; k < generator.size(); ++k) {
    const std::size_t factor = factor_letters.find(generator[k]);
    if (factor >= free || word.factors >> factor & 1U)
      reject_generator(generator, "uses '" + generator.substr(k, 1) + "'; allowed is each of " +
                                      std::string(factor_letters.substr(0, free)) + " once");
    word.factors |= 1U << factor;
  }
  if (word.length() < 2) reject_generator(generator, "multiplies fewer than 2 variables; name more");
  return word;
}

/// The words of the variables behind the free ones.
inline std::vector<Word> generated_words(std::size_t d, const std::vector<std::string>& generators) {
  if (d > factor_letters.size() || generators.size() >= d)
    throw std::invalid_argument(
        "doe::fractional_factorial: " + std::to_string(d) + " variables and " +
        std::to_string(generators.size()) +
        " generators; allowed are up to 25 variables and fewer generators than variables");
  const std::size_t free = d - generators.size();
  std::vector<Word> words;
  for (std::size_t g = 0; g < generators.size(); ++g)
    words.push_back(generated_word(generators[g], free + g, free));
  return words;
}

/// All products of the words "variable times its generator", identity left out.
inline std::vector<Word> defining_relation(const std::vector<Word>& generated, std::size_t free) {
  std::vector<Word> group{{}};
  for (std::size_t g = 0; g < generated.size(); ++g) {
    const Word word = generated[g] * Word{1U << (free + g), false};
    for (std::size_t k = 0, size = group.size(); k < size; ++k) group.push_back(group[k] * word);
  }
  group.erase(group.begin());
  std::sort(group.begin(), group.end(), [](Word a, Word b) {
    return a.length() != b.length() ? a.length() < b.length() : a.mirrored() > b.mirrored();
  });
  return group;
}

/// "A = BC", with the effects of at most two variables that share the column of `effect`; empty when there is
/// none.
inline std::string alias_text(Word effect, const std::vector<Word>& relation) {
  std::string text;
  for (const Word& word : relation)
    if (const Word other = effect * word; other.length() <= 2) text += " = " + word_text(other);
  return text.empty() ? text : word_text(effect) + text;
}

}  // namespace detail

/// The report for d variables (up to 25) and generators of the last ones. The defining relation has
/// 2^generators words: at most 20 generators. Throws std::invalid_argument on a generator that cannot be
/// read.
inline Aliasing aliasing(int d, const std::vector<std::string>& generators) {
  if (d < 1 || generators.size() > 20)
    throw std::invalid_argument("doe::aliasing: " + std::to_string(d) + " variables and " +
                                std::to_string(generators.size()) +
                                " generators; allowed are 1 to 25 and up to 20; take more runs");
  const auto count = static_cast<std::size_t>(d);
  const std::vector<detail::Word> generated = detail::generated_words(count, generators);
  const std::vector<detail::Word> relation = detail::defining_relation(generated, count - generators.size());
  Aliasing report;
  report.word_counts.assign(count + 1, 0);
  for (const detail::Word& word : relation) {
    ++report.word_counts[static_cast<std::size_t>(word.length())];
    report.defining_words.push_back(detail::word_text(word));
  }
  if (!relation.empty()) report.resolution = relation.front().length();
  std::vector<detail::Word> effects;
  for (std::size_t j = 0; j < count; ++j) effects.push_back({1U << j, false});
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t k = j + 1; k < count; ++k) effects.push_back({1U << j | 1U << k, false});
  for (const detail::Word& effect : effects)
    if (std::string text = detail::alias_text(effect, relation); !text.empty())
      report.aliases.push_back(std::move(text));
  return report;
}

}  // namespace drawpoint::doe
