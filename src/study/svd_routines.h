// The singular value decompositions that LAPACK offers, called one by one to be compared; what the
// program itself uses is in bkm/lapack.h and bkm/spectral.h.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace knotlight {

struct SvdRun {
  double seconds = 0.0;   // of the processor
  double residual = 0.0;  // |A - U S V^T| / |A|, Frobenius norms, in double precision
  int kept = 0;           // singular values above max(m, n) eps times the largest, eps its own
};

// QR iteration, divide and conquer, Jacobi's rotations; the first two in single (s) and double (d)
// precision. `sampled` is the program's own, by random products; it finds only what is kept.
enum class SvdRoutine { sgesvd, dgesvd, sgesdd, dgesdd, dgejsv, sampled };
const std::vector<SvdRoutine>& svd_routines();
std::string name_of(SvdRoutine routine);

// a: square, finite. Throws std::runtime_error if the routine does not converge.
SvdRun run_svd(SvdRoutine routine, const Eigen::MatrixXd& a);

}  // namespace knotlight
