// The field of a point charge below a plane on which u + k du/dn = 0, n outward (up): the charge
// itself, the same charge mirrored, and a line of opposite charge from the mirror point upwards,
//
//   u(x) = G(x - y) + G(x - y*) - (2/k) int_0^inf exp(-s/k) G(x - y* - s n) ds,
//
// G(d) = exp(-lambda |d|)/(4 pi |d|). On the plane the first two have equal values and opposite
// normal derivatives; partial integration of the third along s gives its Robin value, -2 G.
#pragma once

#include <array>
#include <limits>

#include "core/vec3.h"

namespace knotlight {

struct PointCharge {
  Vec3 position;
  double strength;
};

// The mirror charge first, then those that stand for the line, nearest first.
struct RobinImage {
  static constexpr int most_charges = 7;
  std::array<PointCharge, most_charges> charges;
  int count = 0;

  const PointCharge* begin() const { return charges.data(); }
  const PointCharge* end() const { return charges.data() + count; }
};

// Where there is room only up to a height `clear` above the plane, charges of the line that would
// lie higher are gathered there in one, of a strength with which the Robin condition still holds at
// the foot; a mirror charge that would lie higher is left out, and all of the image with it.
//
// y: position of the charge; strength: its own; plane through `plane` with outward unit normal n;
// k > 0: length.
//
// A charge above the plane, at a height h, is its own mirror charge. It stands for a charge on the
// plane that is spread out there: seen from below, exp(lambda h) times the field of a charge at the
// height h is that of a layer on the plane of total charge 1 and width h (without lambda, density h
// / (2 pi (rho^2 + h^2)^(3/2)), Kuzmin's disc [BT08 ch. 2.3.1]). The image is then that of the
// layer.
//
// The line becomes 6, 4 or 3 point charges for a charge that is less than 0.15 k, 0.8 k or more
// below the plane: with them its value on the plane is right to 1.1e-3 of the charge's own, however
// deep the charge and wherever on the plane, for lambda k <= 1.2.
RobinImage robin_image(const Vec3& y, double strength, const Vec3& plane, const Vec3& n, double k,
                       double lambda, double clear = std::numeric_limits<double>::infinity());

struct FieldSample {
  double value;
  Vec3 gradient;
};

// G and its gradient at offset d = x - y from a charge 1, d != 0; lambda >= 0.
FieldSample point_charge_field(const Vec3& d, double lambda);

// The image's part of u for a charge 1, with the line as point charges, at x.
FieldSample robin_image_field(const Vec3& x, const Vec3& y, const Vec3& plane, const Vec3& n,
                              double lambda, double k);

}  // namespace knotlight
