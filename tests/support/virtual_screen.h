// A screen without a screen: the X server Xvfb, whose pixels are a file, and xdotool for a hand.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace knotlight::test {

// Runs a program with extra environment variables; ended with the object if it still runs.
class Child {
 public:
  Child(const std::vector<std::string>& command, const std::vector<std::string>& environment,
        const std::filesystem::path& output);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Waits at most so long; -1 if it has not ended by itself then.
  int exit_code(double seconds);

 private:
  pid_t pid_ = -1;
};

struct Screenshot {
  int width = 0, height = 0;
  std::vector<unsigned char> grey;  // mean of red, green and blue, row by row

  // Mean over the part that is `columns` wide from the left.
  double mean(int columns) const;
  // Mean of |a - b| over that part.
  double difference(const Screenshot& other, int columns) const;
};

class VirtualScreen {
 public:
  static bool is_available();  // whether Xvfb and xdotool are installed

  // folder: for the server's files.
  VirtualScreen(int width, int height, const std::filesystem::path& folder);

  const std::string& display() const { return display_; }  // "DISPLAY=:7"; empty: did not start
  Screenshot look() const;
  // xdotool with these words.
  void hand(const std::string& words) const;

 private:
  std::filesystem::path folder_;
  Child server_;
  std::string display_;
};

}  // namespace knotlight::test
