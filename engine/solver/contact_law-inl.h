// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// The steps of the contact law, stated once for every number type T: double (contact_law_scalar.h) or the
/// lanes of a batch (batch/pair_lanes-inl.h), in the same order of operations.
///
/// A point has the impulse λ in its frame (n, t1, t2), the relative velocity u and the response W = J M⁻¹ Jᵀ,
/// so that λ changes u by W Δλ. The normal's step is λ_n ← max(0, λ_n − (u_n + Σ λ_n − b) / (W_nn + Σ)). The
/// tangents stick, λ_t − W_tt⁻¹ u_t, where the cone |λ_t| ≤ limit allows it; else they take the scalar step
/// λ_t − u_t / ρ, ρ = λ_max(W_tt), and are projected on the disc. The scalar step also serves where W_tt is
/// singular: a machine part with few freedoms does not answer in every direction. The moment between two
/// bodies takes the same steps, its normal within ± limit.
///
/// This is text without includes, and without a guard: lanes must be compiled once per instruction set,
/// inside the namespace of each, because code outside it cannot inline their operators. Whoever includes it
/// has declared in namespace law: number<T>(x), T of the double x; singular_determinant, below which W_tt is
/// singular, of T's precision; none(condition), true where T knows at once that no value is selected; and in
/// reach of it for T: + − * / < >, select(condition, yes, no), min, max, abs, sqrt. Both values of a select
/// are computed, so none may trap.
namespace law {

/// 1/x of what answers, else 0.
template <class T>
[[gnu::always_inline]] inline T inverse_or_zero(const T& x) {
  const T zero = number<T>(0);
  return select(x > zero, number<T>(1) / x, zero);
}

/// W_tt⁻¹ and 1/ρ.
template <class T>
struct TangentInverse {
  T xx, xy, yy, rho;
};

/// The inverse of W_tt = (a b; b c), 1/ρ times the identity where that is singular, and 1/ρ.
template <class T>
[[gnu::always_inline]] inline TangentInverse<T> invert_tangents(const T& a, const T& b, const T& c) {
  const T half = number<T>(0.5), difference = half * (a - c);
  const T rho = half * (a + c) + sqrt(difference * difference + b * b);
  const T inverse_rho = inverse_or_zero(rho);
  const T determinant = a * c - b * b;
  const auto regular = determinant > number<T>(singular_determinant) * rho * rho;
  const T inverse = inverse_or_zero(determinant);
  return {select(regular, c * inverse, inverse_rho), select(regular, -b * inverse, number<T>(0)),
          select(regular, a * inverse, inverse_rho), inverse_rho};
}

/// λ_n after its step; `inverse_nn` = 1 / (W_nn + Σ). Beyond the speed `fastest` the contact does not push, so that the
/// law is u_n ≥ min(b − Σ λ_n, fastest) (contact_law.hpp).
template <class T>
[[gnu::always_inline]] inline T normal_step(const T& impulse, const T& velocity, const T& sigma,
                                            const T& target, const T& inverse_nn, const T& fastest) {
  const T rest = max((velocity + sigma * impulse) - target, velocity - fastest);
  return max(number<T>(0), impulse - inverse_nn * rest);
}

/// The normal moment after its step, within ± limit.
template <class T>
[[gnu::always_inline]] inline T spin_step(const T& moment, const T& velocity, const T& inverse_nn,
                                          const T& limit) {
  return min(limit, max(-limit, moment - inverse_nn * velocity));
}

/// What brings a vector, |x|² = `square`, on the disc of the radius when multiplied with it.
template <class T>
[[gnu::always_inline]] inline T disc_factor(const T& square, const T& radius) {
  const auto outside = square > radius * radius;
  if (none(outside)) return number<T>(1);
  return select(outside, radius / sqrt(square), number<T>(1));
}

/// λ_t = (l1, l2) after its step against u_t = (u1, u2), within the disc of radius `limit`.
template <class T>
[[gnu::always_inline]] inline void tangent_step(T& l1, T& l2, const T& u1, const T& u2,
                                                const TangentInverse<T>& inverse, const T& limit) {
  const T s1 = l1 - (inverse.xx * u1 + inverse.xy * u2);
  const T s2 = l2 - (inverse.xy * u1 + inverse.yy * u2);
  const auto slides = s1 * s1 + s2 * s2 > limit * limit;
  if (none(slides)) {
    l1 = s1;
    l2 = s2;
    return;
  }
  const T p1 = l1 - inverse.rho * u1, p2 = l2 - inverse.rho * u2;
  const T factor = disc_factor(p1 * p1 + p2 * p2, limit);
  l1 = select(slides, p1 * factor, s1);
  l2 = select(slides, p2 * factor, s2);
}

/// |λ_t − P(λ_t − u_t / ρ)|, P the projection on the disc: zero at a solution (residual.hpp).
template <class T>
[[gnu::always_inline]] inline T tangent_residual(const T& l1, const T& l2, const T& u1, const T& u2,
                                                 const T& inverse_rho, const T& limit) {
  const T p1 = l1 - inverse_rho * u1, p2 = l2 - inverse_rho * u2;
  const T factor = disc_factor(p1 * p1 + p2 * p2, limit);
  const T d1 = l1 - p1 * factor, d2 = l2 - p2 * factor;
  return sqrt(d1 * d1 + d2 * d2);
}

/// b [m/s] of a gap [m] (negative: overlap) and its approach G v⁻ [m/s] (negative: closing); `closing_rate` =
/// −1/h. An open gap only limits the approach to what closes it; an impact takes the whole approach
/// (contact_law.hpp).
template <class T>
[[gnu::always_inline]] inline T bias_velocity(const T& gap, const T& approach, const T& upsilon,
                                              const T& closing_rate) {
  const T open = gap * closing_rate, zero = number<T>(0);
  const T damping = select(approach < number<T>(-constants::impact_speed), zero, approach);
  return select(gap > zero, open, upsilon * (damping + number<T>(4) * open));
}

/// What of a substep's normal impulse λ is there for the next one to start from. Load that is there to stay
/// grows by `load_growth` at most, or by what stops an approach of `impact_speed`; more than that is an
/// impact, which is over. To start from it would strike again, and the iterations that take it back shake the
/// pile. `initial` is what the substep itself started from.
template <class T>
[[gnu::always_inline]] inline T kept_load(const T& impulse, const T& initial, const T& inverse_nn) {
  return min(impulse,
             number<T>(constants::load_growth) * initial + number<T>(constants::impact_speed) * inverse_nn);
}

/// Share of the whole impulse that the next substep starts from.
template <class T>
[[gnu::always_inline]] inline T warm_start_fraction(const T& impulse, const T& kept) {
  return select(impulse > kept, kept / impulse, number<T>(1));
}

/// What the moment of a pair changes by, relative to it, when `impacts` of the pair's normal load do not
/// carry over.
template <class T>
[[gnu::always_inline]] inline T moment_change(const T& impacts, const T& load) {
  const T zero = number<T>(0);
  return select(impacts > zero, -impacts / load, zero);
}

}  // namespace law
