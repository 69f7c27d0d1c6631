#include "core/file_io.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/errors.h"

namespace knotlight {

namespace {

// Path of the temporary being written, for the signal handler; empty string = none. One file is
// written at a time.
char pending_path[4096] = "";

void set_pending(const std::string& path) {
  const std::size_t length = std::min(path.size(), sizeof(pending_path) - 1);
  pending_path[0] = '\0';  // never half a name
  std::copy_n(path.data() + 1, length > 0 ? length - 1 : 0, pending_path + 1);
  pending_path[length] = '\0';
  if (length > 0) pending_path[0] = path[0];
}

}  // namespace

void remove_pending_file() noexcept {
  if (pending_path[0] != '\0') ::unlink(pending_path);
}

void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write) {
  std::filesystem::path target(path);
  if (std::filesystem::exists(target)) {
    target = std::filesystem::canonical(target);
    if (!std::filesystem::is_regular_file(target)) {
      write(target.string());
      return;
    }
  }
  // Beside the target, so that the rename stays within one file system; hidden and with the process
  // number, so that two runs do not meet.
  const std::filesystem::path temporary =
      target.parent_path() / fmt::format(".knotlight-{}-{}{}", ::getpid(), target.stem().string(),
                                         target.extension().string());
  set_pending(temporary.string());
  try {
    write(temporary.string());
    std::filesystem::rename(temporary, target);
    set_pending("");
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    set_pending("");
    throw;
  }
}

void write_text_file(const std::string& path, const std::string& text) {
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(path + ": cannot write");
  });
}

void make_output_folder(const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder + ": cannot make this folder, expected a place to write to");
}

}  // namespace knotlight
