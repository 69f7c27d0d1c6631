#include "support/virtual_screen.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "support/program.h"

namespace knotlight::test {
namespace {

constexpr std::chrono::milliseconds poll{20};

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

bool is_installed(const char* program) {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", program).c_str()) == 0;
}

}  // namespace

Child::Child(const std::vector<std::string>& command, const std::vector<std::string>& environment,
             const std::filesystem::path& output) {
  pid_ = fork();
  if (pid_ != 0) return;
  const int file = open(output.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  _exit(127);
}

Child::~Child() {
  if (pid_ <= 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
}

int Child::exit_code(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < end) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::this_thread::sleep_for(poll);
  }
  return -1;
}

double Screenshot::mean(int columns) const {
  double sum = 0.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < columns; ++x) sum += grey[static_cast<std::size_t>(y) * width + x];
  return sum / columns / height;
}

double Screenshot::difference(const Screenshot& other, int columns) const {
  if (width != other.width || height != other.height) return 255.0;
  double sum = 0.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < columns; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      sum += std::abs(grey[i] - other.grey[i]);
    }
  return sum / columns / height;
}

bool VirtualScreen::is_available() {
  return is_installed("Xvfb") && is_installed("xdotool");
}

VirtualScreen::VirtualScreen(int width, int height, const std::filesystem::path& folder)
    : folder_(folder),
      server_({"Xvfb", "-displayfd", "1", "-screen", "0", fmt::format("{}x{}x24", width, height),
               "-fbdir", folder.string(), "-nolisten", "tcp"},
              {}, folder / "display") {
  // It writes the number of the display when it is ready.
  for (int i = 0; i < 500 && display_.empty(); ++i) {
    std::this_thread::sleep_for(poll);
    const std::string text = read_file(folder_ / "display");
    const std::size_t end = text.find('\n');
    if (end != std::string::npos) display_ = "DISPLAY=:" + text.substr(0, end);
  }
}

// The file is an X window dump: a header of 32-bit words, big end first, a colour map, and rows of
// 4 bytes per pixel, blue first.
Screenshot VirtualScreen::look() const {
  const std::string dump = read_file(folder_ / "Xvfb_screen0");
  Screenshot shot;
  if (dump.size() < 100) return shot;
  shot.width = static_cast<int>(big_endian(dump, 16));
  shot.height = static_cast<int>(big_endian(dump, 20));
  const std::size_t row = big_endian(dump, 48);
  constexpr std::size_t colour_entry = 12;
  const std::size_t start = big_endian(dump, 0) + colour_entry * big_endian(dump, 76);
  if (dump.size() < start + row * static_cast<std::size_t>(shot.height)) return {};
  for (int y = 0; y < shot.height; ++y)
    for (int x = 0; x < shot.width; ++x) {
      const std::size_t pixel = start + row * y + 4 * static_cast<std::size_t>(x);
      unsigned sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += static_cast<unsigned char>(dump[pixel + c]);
      shot.grey.push_back(static_cast<unsigned char>(sum / 3));
    }
  return shot;
}

void VirtualScreen::hand(const std::string& words) const {
  const int status =
      std::system(fmt::format("{} xdotool {} >/dev/null 2>&1", display_, words).c_str());
  (void)status;  // what it did is seen on the screen
}

}  // namespace knotlight::test
