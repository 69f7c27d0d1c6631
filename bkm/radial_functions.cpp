#include "bkm/radial_functions.h"

#include <cassert>
#include <cmath>

namespace knotlight {
namespace {

// w(q), w'(q)/q and lap w = w'' + 2 w'/q of a function of q = r/c [V09 6.15], as functions of
// t = q^2. One struct a function, so that each derivation stands in one place.
struct Profile {
  Batch value, slope, laplacian;
};

Profile linear(const Batch& t) {
  const Batch q = t.sqrt();
  return {q * t / 12.0, q / 4.0, q};
}

Profile cubic(const Batch& t) {
  const Batch q = t.sqrt();
  return {q * t.square() / 30.0, q * t / 6.0, q * t};
}

// lap (q^4 log q) = 20 q^2 log q + 9 q^2 and lap q^4 = 20 q^2. log q -> -infinity is beaten by the
// power of q before it; at q = 0 itself the product is set to that limit.
Profile thin_plate(const Batch& t) {
  const Batch log_q = (t == 0.0).select(Batch::Zero(t.size()), 0.5 * t.log());
  return {t.square() * (log_q / 20.0 - 9.0 / 400.0), t * (log_q / 5.0 - 0.04), t * log_q};
}

// (1 + t)^(b/2); lap = b (1 + t)^(b/2 - 2) (3 (1 + t) + (b - 2) t).
Profile multiquadric(const Batch& t, double b) {
  const Batch base = 1.0 + t;
  const Batch value = base.pow(0.5 * b);
  return {value, b * value / base, b * value / base.square() * (3.0 + (b + 1.0) * t)};
}

// `inside` where q < 1, `outside` beyond; not-a-number goes through `inside`.
Batch by_support(const Batch& t, const Batch& inside, const Batch& outside) {
  return (t >= 1.0).select(outside, inside);
}

// Outside the ball lap psi = 0, and q^2 psi' is what the ball holds: integral of q^2 (1 - q)^2 over
// (0, 1) = 1/30. The constant inside makes psi continuous at q = 1.
Profile compact_c0(const Batch& t) {
  const Batch q = t.sqrt();
  const Batch zero = Batch::Zero(t.size());
  return {by_support(t, t / 6.0 - t * q / 6.0 + t.square() / 20.0 - 1.0 / 12.0, -1.0 / (30.0 * q)),
          by_support(t, 1.0 / 3.0 - q / 2.0 + t / 5.0, 1.0 / (30.0 * q * t)),
          by_support(t, (1.0 - q).square(), zero)};
}

Profile compact_c2(const Batch& t) {
  const Batch q = t.sqrt(), p = 1.0 - q;
  const Batch zero = Batch::Zero(t.size());
  return {by_support(t, p.square().square() * (4.0 * q + 1.0), zero),
          by_support(t, -20.0 * p.cube(), zero),
          by_support(t, 60.0 * p.square() * (2.0 * q - 1.0), zero)};
}

Profile compact_c4(const Batch& t) {
  const Batch q = t.sqrt(), p = 1.0 - q;
  const Batch p4 = p.square().square();
  const Batch zero = Batch::Zero(t.size());
  return {by_support(t, p4 * p.square() * (35.0 * t + 18.0 * q + 3.0), zero),
          by_support(t, -56.0 * p4 * p * (5.0 * q + 1.0), zero),
          by_support(t, -168.0 * p4 * (1.0 + 4.0 * q - 15.0 * t), zero)};
}

Profile evaluate(const RadialFunction& w, const Batch& t) {
  switch (w.kind) {
    case RadialKind::linear:
      return linear(t);
    case RadialKind::cubic:
      return cubic(t);
    case RadialKind::thin_plate:
      return thin_plate(t);
    case RadialKind::multiquadric:
      return multiquadric(t, w.exponent);
    case RadialKind::inverse_multiquadric:
      return multiquadric(t, -w.exponent);
    case RadialKind::compact_c0:
      return compact_c0(t);
    case RadialKind::compact_c2:
      return compact_c2(t);
    case RadialKind::compact_c4:
      return compact_c4(t);
    case RadialKind::gaussian:
    case RadialKind::nonsingular:
      break;  // have functions of their own in kernel_batch.h
  }
  assert(false);
  return {};
}

}  // namespace

Batch psi_values(const RadialFunction& w, const Batch& s) {
  if (w.kind == RadialKind::gaussian) return gaussian_values(s, w.c);
  if (w.kind == RadialKind::nonsingular) return nonsingular_values(s, w.lambda, w.R, w.order);
  return evaluate(w, s / (w.c * w.c)).value;
}

RadialBatch psi_with_slopes(const RadialFunction& w, const Batch& s) {
  if (w.kind == RadialKind::gaussian) return gaussians(s, w.c);
  if (w.kind == RadialKind::nonsingular) return nonsingular_solutions(s, w.lambda, w.R, w.order);
  const Profile at = evaluate(w, s / (w.c * w.c));
  return {at.value, at.slope / (w.c * w.c)};
}

Batch phi_values(const RadialFunction& w, const Batch& s) {
  if (w.kind == RadialKind::gaussian) return gaussian_helmholtz_values(s, w.c, w.lambda);
  if (w.kind == RadialKind::nonsingular) {
    if (w.order == 0) return 0.0 * s;  // not-a-number stays
    return nonsingular_values(s, w.lambda, w.R, w.order - 1);
  }
  const Profile at = evaluate(w, s / (w.c * w.c));
  return at.laplacian / (w.c * w.c) - w.lambda * w.lambda * at.value;
}

}  // namespace knotlight
