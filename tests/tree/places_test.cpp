// Lines and columns of files, whatever ends their lines and however long these are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/source_text.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;

TEST(Places, LinesEndAsOnEverySystem) {
  const std::string lines = "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"A\">\n<Nope/>\n</BehaviorTree></root>";
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : lines) text += c == '\n' ? std::string(end) : std::string(1, c);
    EXPECT_THAT(parseText(text, "f.xml", Registry::standard()).problems,
                ElementsAre(At("3:1 Nope", "tree.unknown-node")));
  }
}

TEST(Places, AreThoseOfTheSlowCount) {
  std::string text = "\xEF\xBB\xBF";
  for (int i = 0; i < 4000; ++i) text += i % 7 == 0 ? "ö" : i % 997 == 0 ? "\r\n" : i % 1301 == 0 ? "\n" : "x";
  const SourceText source("f.xml", text);
  int line = 1, column = 1;
  for (std::size_t i = 3; i < text.size(); ++i) {
    const Location place = source.locate(i);
    ASSERT_EQ(place.line, line) << i;
    ASSERT_EQ(place.column, column) << i;
    column += (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U ? 0 : 1;
    if (text[i] == '\n') ++line, column = 1;
  }
  EXPECT_EQ(source.locate(text.size() + 5).line, line);
  EXPECT_EQ(SourceText("f.xml", "").locate(7).column, 1);
}

}  // namespace
}  // namespace swiftlet::tree::testing
