#pragma once

namespace knotlight {

// n!, exact in double up to n = 22.
constexpr double factorial(int n) {
  return n < 2 ? 1.0 : n * factorial(n - 1);
}

// n (n - 2) (n - 4) ..., n!!; 1 for n < 2.
constexpr double double_factorial(int n) {
  return n < 2 ? 1.0 : n * double_factorial(n - 2);
}

}  // namespace knotlight
