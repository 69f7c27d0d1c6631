#include "report/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace knotlight {
namespace {

namespace fs = std::filesystem;

// A folder of our own under the system's temporary one, gone at the end of the scope. Files instead
// of pipes: nothing can block, whatever the sizes.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "knotlight-chart-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make a temporary folder for a chart: " + name);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string first_line_that_says_something(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    // gnuplot repeats the line of the script and points at a column of it first.
    if (line.find_first_not_of(" \t^") != std::string::npos && line.rfind("plot", 0) != 0)
      return line;
  return "no message";
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const TemporaryFolder folder;
  const std::string in = folder.file("script");
  const std::string out = folder.file("out");
  const std::string messages = folder.file("messages");
  std::ofstream file(in, std::ios::binary);
  file << script;
  file.close();
  if (!file) throw std::runtime_error("cannot write the script of a chart to " + in);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int create = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), create, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), create, 0600);
  // -d: the user's own settings stay out of our charts.
  std::string words[] = {"gnuplot", "-d", in};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw std::runtime_error(
        "gnuplot, which draws the charts, cannot be started; on Debian: apt-get install "
        "gnuplot-nox");
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(
        fmt::format("gnuplot failed: {}", first_line_that_says_something(contents(messages))));
  return contents(out);
}

}  // namespace knotlight
