// Lists of numbers with other marks than YAML's, and texts that are none.
#include "common/number_list.hpp"

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

TEST(NumberList, IsUnderstoodWithAnyMarks) {
  for (const char* text : {"-1.5 2e3 0", "-1.5; 2e3; 0", "(-1.5, 2e3, 0)", " -1.5,2e3,0 ", "-1,5;2e3;0", "-1.5  2e3\t0",
                           "-1.5 2e3, 0", "{-1.5, +2e3, 0}"})
    EXPECT_EQ(numberListOf(text), "[-1.5, 2e3, 0]") << text;
  EXPECT_EQ(numberListOf("7"), "[7]");
}

TEST(NumberList, IsNotMadeOfOtherTexts) {
  for (const char* text : {"", " ", "()", "a b", "1 2 m", "1, , 2", "45°", "1;2,3;x", "1, +-2", "10 000", "0x10"})
    EXPECT_EQ(numberListOf(text), "") << text;
  EXPECT_EQ(numberListHint("a b"), "write the numbers in brackets, with commas between them");
}

}  // namespace
}  // namespace swiftlet::common
