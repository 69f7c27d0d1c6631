#include "reference/exact_transport.h"

#include <limits>

namespace knotlight {

// [vdH80 table 35] and [G55], as [WJZ95 tables 1 and 2] quote them.
const std::vector<ExactSlab>& classic_slabs() {
  static const std::vector<ExactSlab> slabs{
      {1.0, 0.9, 2.0, 0.75, 0.09739, 0.66096, 1e-5},
      {1.5, 0.9, std::numeric_limits<double>::infinity(), 0.0, 0.2600, 0.0, 1e-4},
  };
  return slabs;
}

const std::vector<ExactSlab>& diffusive_slabs() {
  constexpr double digit = 1e-4;
  static const std::vector<ExactSlab> slabs{
      {1.0, 0.9, 2, 0, 0.36165, 0.3565, digit},     {1.0, 0.9, 10, 0, 0.41493, 0.00561, digit},
      {1.0, 0.99, 2, 0, 0.49749, 0.4657, digit},    {1.0, 0.99, 10, 0, 0.74093, 0.08476, digit},
      {1.0, 0.99, 20, 0, 0.75235, 0.01482, digit},  {1.0, 0.999, 10, 0, 0.83888, 0.13825, digit},
      {1.0, 0.999, 20, 0, 0.89331, 0.06311, digit}, {1.4, 0.9, 10, 0, 0.2784, 0.0045, digit},
      {1.4, 0.99, 10, 0, 0.6219, 0.1026, digit},    {1.4, 0.99, 20, 0, 0.6311, 0.0181, digit},
      {1.4, 0.999, 20, 0, 0.8323, 0.0937, digit},   {1.0, 0.99, 50, 0.8, 0.52172, 0.01633, digit},
      {1.4, 0.99, 50, 0.8, 0.3858, 0.0151, digit},
  };
  return slabs;
}

}  // namespace knotlight
