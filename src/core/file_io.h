// Files are written whole or not at all: to a temporary name beside the target, then renamed.
#pragma once

#include <functional>
#include <string>

namespace knotlight {

// Calls write(temporary_path) and renames the result to `path`. If write throws, or the rename
// fails, no trace is left and `path` is as it was. The temporary keeps the extension of `path`. A
// link is followed; what is there but no regular file (a pipe, a device) is written to directly.
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

// Removes the temporary that is being written, if any. For signal handlers: calls nothing but
// unlink.
void remove_pending_file() noexcept;

// The same as write_atomically for text.
void write_text_file(const std::string& path, const std::string& text);

// Makes the folder, and those above it, if they are not there; InputError if that is not possible.
void make_output_folder(const std::string& folder);

}  // namespace knotlight
