#include "core/file_io.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace knotlight {

void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write) {
  const std::filesystem::path target(path);
  // Beside the target, so that the rename stays within one file system; hidden and with the process
  // number, so that two runs do not meet.
  const std::filesystem::path temporary =
      target.parent_path() / fmt::format(".knotlight-{}-{}{}", ::getpid(), target.stem().string(),
                                         target.extension().string());
  try {
    write(temporary.string());
    std::filesystem::rename(temporary, target);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
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

}  // namespace knotlight
