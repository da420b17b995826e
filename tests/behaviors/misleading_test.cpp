// Files of missions and of settings call the same characters misleading.
#include <gtest/gtest.h>

#include <cstdint>

#include "behaviors/tree/characters.hpp"
#include "common/misleading.hpp"

namespace swiftlet::behaviors {
namespace {

std::string utf8Of(std::uint32_t code) {
  const auto tail = [&](unsigned shift) { return static_cast<char>(0x80U | (code >> shift & 0x3FU)); };
  if (code < 0x800) return {static_cast<char>(0xC0U | code >> 6U), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xE0U | code >> 12U), tail(6), tail(0)};
  return {static_cast<char>(0xF0U | code >> 18U), tail(12), tail(6), tail(0)};
}

TEST(Misleading, IsTheSameInMissionsAndSettings) {
  for (std::uint32_t code = 0x80; code < 0xE0200; ++code) {
    if (code == 0x10000) code = 0xE0000;
    for (const std::string before : {"", "a"}) {
      const std::string text = before + utf8Of(code);
      EXPECT_EQ(common::misleadingIn(text).has_value(), !tree::misleadingCharacterIn(text).empty()) << std::hex << code;
      const bool ends_line = code == 0x2028 || code == 0x2029;  // A blank in XML, a new line in YAML.
      EXPECT_TRUE(ends_line || common::asSeen(text) == tree::asSeen(text)) << std::hex << code;
    }
  }
}

}  // namespace
}  // namespace swiftlet::behaviors
