// The quick validation as a program of its own: `sound` ends with 0 if every figure passes,
// `broken` if some figure fails. What failed is printed.
#include <fmt/format.h>

#include <exception>
#include <string>

#include "validate/report.h"
#include "validate/validate.h"

int main(int argc, char** argv) {
  using namespace knotlight;
  const std::string expected = argc == 2 ? argv[1] : "";
  if (expected != "sound" && expected != "broken") {
    fmt::print(stderr, "usage: {} sound|broken\n", argv[0]);
    return 2;
  }
  try {
    RunContext run(RunOptions{}, false);
    const Validation validation = validate({.only = {}, .quick = true}, run);
    fmt::print("{}", validation_text(validation));
    return (validation.failed() == 0) == (expected == "sound") ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
