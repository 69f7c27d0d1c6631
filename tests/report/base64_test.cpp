#include "report/base64.h"

#include <gtest/gtest.h>

namespace knotlight {
namespace {

std::vector<unsigned char> bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

TEST(Base64, TestVectorsOfTheStandard) {  // RFC 4648 section 10
  EXPECT_EQ(base64(bytes("")), "");
  EXPECT_EQ(base64(bytes("f")), "Zg==");
  EXPECT_EQ(base64(bytes("fo")), "Zm8=");
  EXPECT_EQ(base64(bytes("foo")), "Zm9v");
  EXPECT_EQ(base64(bytes("foob")), "Zm9vYg==");
  EXPECT_EQ(base64(bytes("fooba")), "Zm9vYmE=");
  EXPECT_EQ(base64(bytes("foobar")), "Zm9vYmFy");
}

TEST(Base64, HighBytes) {
  EXPECT_EQ(base64({0xFF, 0xFB, 0x00, 0x80}), "//sAgA==");
}

}  // namespace
}  // namespace knotlight
