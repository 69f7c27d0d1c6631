// Runs the built program as a user would.
#pragma once

#include <filesystem>
#include <string>

namespace knotlight::test {

struct ProgramResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

// Runs `program arguments...` in `folder` through the shell, standard input empty.
ProgramResult run_program(const std::string& program, const std::string& arguments,
                          const std::filesystem::path& folder);

// The file's bytes; empty if it is not there.
std::string read_file(const std::filesystem::path& path);

}  // namespace knotlight::test
