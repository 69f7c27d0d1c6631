// Bytes as text, for pictures inside a page.
#pragma once

#include <string>
#include <vector>

namespace knotlight {

// RFC 4648 section 4, with padding.
std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace knotlight
