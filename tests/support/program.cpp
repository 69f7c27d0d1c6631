#include "support/program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace knotlight::test {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

ProgramResult run_program(const std::string& program, const std::string& arguments,
                          const std::filesystem::path& folder) {
  char capture[] = "/tmp/knotlight_test_XXXXXX";
  if (mkdtemp(capture) == nullptr) return {};
  const std::string out = std::string(capture) + "/out";
  const std::string err = std::string(capture) + "/err";
  const std::string command = "cd '" + folder.string() + "' && '" + program + "' " + arguments +
                              " >'" + out + "' 2>'" + err + "' </dev/null";
  const int status = std::system(command.c_str());
  const ProgramResult result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out),
                             read_file(err)};
  std::filesystem::remove_all(capture);
  return result;
}

}  // namespace knotlight::test
