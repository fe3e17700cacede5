// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Arithmetic of the finite field of q = p^m elements, numbered 0..q-1.
///
/// Element e stands for the polynomial whose coefficients over GF(p) are the digits of e in base p, lowest
/// first; multiplication is modulo the first irreducible monic polynomial of degree m in that numbering
/// (found by trial of all divisors). Tables of q² entries each. Cost to build O(q² m²) beside the search of
/// the modulus.

#include <cstddef>
#include <utility>
#include <vector>

namespace drawpoint::doe::detail {

/// p when q = p^m with p prime and m >= 1, else 0.
inline int prime_of_power(int q) {
  if (q < 2) return 0;
  int p = 2;
  while (p * p <= q && q % p != 0) ++p;
  if (q % p != 0) p = q;
  while (q % p == 0) q /= p;
  return q == 1 ? p : 0;
}

/// Coefficients, lowest degree first.
using Polynomial = std::vector<int>;

inline Polynomial polynomial_of(int element, int p) {
  Polynomial digits;
  for (; element > 0; element /= p) digits.push_back(element % p);
  return digits;
}

inline int element_of(const Polynomial& digits, int p) {
  int element = 0;
  for (std::size_t k = digits.size(); k-- > 0;) element = element * p + digits[k];
  return element;
}

/// Remainder of a by the monic polynomial `modulus`, over GF(p), without leading zeros.
inline Polynomial remainder(Polynomial a, const Polynomial& modulus, int p) {
  while (a.size() >= modulus.size()) {
    const int factor = a.back();
    const std::size_t shift = a.size() - modulus.size();
    for (std::size_t k = 0; k < modulus.size(); ++k)
      a[shift + k] = ((a[shift + k] - factor * modulus[k]) % p + p) % p;
    a.pop_back();
  }
  while (!a.empty() && a.back() == 0) a.pop_back();
  return a;
}

/// Whether no monic polynomial of half the degree or less divides it.
inline bool irreducible(const Polynomial& monic, int p) {
  const std::size_t degree = monic.size() - 1;
  int first = p;  // the polynomial x
  for (std::size_t k = 1; 2 * k <= degree; ++k, first *= p)
    for (int e = first; e < 2 * first; ++e)  // leading coefficient 1
      if (remainder(monic, polynomial_of(e, p), p).empty()) return false;
  return true;
}

class GaloisField {
 public:
  /// q must be a prime power.
  explicit GaloisField(int q) : q_(q), sum_(cells()), product_(cells()) {
    const int p = prime_of_power(q);
    int e = q;  // x^m
    while (!irreducible(polynomial_of(e, p), p)) ++e;
    const Polynomial modulus = polynomial_of(e, p);
    for (int a = 0; a < q; ++a)
      for (int b = 0; b < q; ++b) {
        sum_[index(a, b)] = add(a, b, p);
        product_[index(a, b)] = multiply(a, b, p, modulus);
      }
  }

  int order() const { return q_; }
  int sum(int a, int b) const { return sum_[index(a, b)]; }
  int product(int a, int b) const { return product_[index(a, b)]; }

 private:
  std::size_t cells() const { return static_cast<std::size_t>(q_) * static_cast<std::size_t>(q_); }

  std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(q_) + static_cast<std::size_t>(b);
  }

  static int add(int a, int b, int p) {
    int sum = 0;
    for (int place = 1; a > 0 || b > 0; place *= p, a /= p, b /= p) sum += (a % p + b % p) % p * place;
    return sum;
  }

  static int multiply(int a, int b, int p, const Polynomial& modulus) {
    if (a == 0 || b == 0) return 0;
    const Polynomial x = polynomial_of(a, p), y = polynomial_of(b, p);
    Polynomial z(x.size() + y.size() - 1, 0);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t k = 0; k < y.size(); ++k) z[i + k] = (z[i + k] + x[i] * y[k]) % p;
    return element_of(remainder(std::move(z), modulus, p), p);
  }

  int q_;
  std::vector<int> sum_, product_;
};

}  // namespace drawpoint::doe::detail
