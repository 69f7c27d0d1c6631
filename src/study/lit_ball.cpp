#include "study/lit_ball.h"

#include "reference/legendre.h"
#include "study/flat_basis.h"

namespace knotlight {

// max(0, mu) = sum c_l P_l with c_0 = 1/4, c_1 = 1/2 and for even l
//   c_l = (2l+1)/2 int_0^1 mu P_l dmu,   int_0^1 mu P_l dmu = -P_l(0) / ((l-1)(l+2))
// from Legendre's equation, (l(l+1) - 2) int = (mu P_l' (1 - mu^2) - (1 - mu^2) P_l) at 0, 1.
// Each wave then has the Robin factor 1 + k lambda i_l'/i_l, lambda i_l'/i_l = l + lambda
// i_(l+1)/i_l.
Eigen::VectorXd lit_ball_field(const Eigen::VectorXd& cosines, double lambda, double k) {
  constexpr int degree = 2000;  // terms fall as l^-3 / k at the shadow's edge, their rest as l^-2
  const Eigen::VectorXd ratios = bessel_ratios(lambda, degree + 1);
  const std::vector<double> at_zero = legendre_polynomials(degree, 0.0);
  Eigen::VectorXd terms(degree + 1);
  for (int l = 0; l <= degree; ++l) {
    const double integral =
        l == 1 ? 1.0 / 3.0 : -at_zero[static_cast<std::size_t>(l)] / ((l - 1.0) * (l + 2.0));
    terms[l] = (l + 0.5) * integral / (1.0 + k * (l + lambda * ratios[l]));
  }
  Eigen::VectorXd u(cosines.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const std::vector<double> p = legendre_polynomials(degree, cosines[i]);
    u[i] = terms.dot(Eigen::Map<const Eigen::VectorXd>(p.data(), terms.size()));
  }
  return u;
}

}  // namespace knotlight
