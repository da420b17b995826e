#include "common/printable.hpp"

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "common/table.hpp"

namespace swiftlet::common {
namespace {

TEST(Printable, PlainTextIsNotChanged) {
  for (const char* text : {"", "maps/ground floor.yaml", "Wände 2 µm, 日本, 🚁", "a\\b `c`"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable("\x1b[2Jgone"), "\\x1b[2Jgone");
  EXPECT_EQ(printable("a\r\nb\tc\x7f\a"), "a\\r\\nb\\tc\\x7f\\x07");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "the control sequence introducer of eight bits";
}

TEST(Printable, InvalidUtf8IsEscaped) {
  EXPECT_EQ(printable("\x9b"
                      "2J"),
            "\\x9b2J");
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "an overlong form";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
}

TEST(Printable, LineBreaksCanBeKept) { EXPECT_EQ(printableLines("a\n\tb\r\x1b"), "a\n\tb\\r\\x1b"); }

TEST(Printable, ProblemsAndTablesArePrintable) {
  const Problem problem{
      {"a\x1b.xml", 3, 4}, "Fly\x1b", Message("test.number", "`\x1b[2J` is no\nnumber"), "did you mean `\x07`?"};
  EXPECT_EQ(toString(problem), "a\\x1b.xml:3:4: Fly\\x1b: `\\x1b[2J` is no\\nnumber, did you mean `\\x07`?");
  EXPECT_STREQ(InputError(problem).what(), toString(problem).c_str());
  const Table table{"\x1b", {"a"}, {{{"b\x1b"}}}};
  EXPECT_EQ(toText(table), "\\x1b\na\n-----\nb\\x1b\n");
}

}  // namespace
}  // namespace swiftlet::common
