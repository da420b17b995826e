// The table of the slowest tests that scripts/test shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/repository/source_tree.hpp"

namespace swiftlet::repository {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

const std::string kSummary = "\n100% tests passed, 0 tests failed out of 30\n\nTotal Test time (real) =  31.00 sec\n";

/// The output of ctest for `count` tests, each a second longer than the one before.
std::string ctestOutput(int count) {
  std::string text;
  for (int i = 1; i <= count; ++i) {
    const std::string number = std::to_string(i);
    text += "      Start " + number + ": room.Story" + number + "\n" + number + "/" + std::to_string(count) +
            " Test #" + number + ": room.Story" + number + " .....   " + (i == 3 ? "***Failed " : "Passed ") + number +
            ".25 sec\n";
  }
  return text + kSummary;
}

std::string tableOf(const std::string& ctest_output) {
  const auto file = std::filesystem::path(SWIFTLET_BINARY_DIR) / ("slowest_" + std::to_string(ctest_output.size()));
  std::ofstream(file) << ctest_output;
  return run("awk -f tests/slowest.awk <'" + file.string() + "'").text;
}

TEST(SlowestTests, AreListedBeforeTheSummary) {
  const std::string text = tableOf(ctestOutput(30));
  EXPECT_THAT(text, HasSubstr("The 20 slowest of 30 tests:\n   30.25 s  room.Story30\n   29.25 s  room.Story29\n"));
  EXPECT_THAT(text, HasSubstr("   11.25 s  room.Story11\n\n100% tests passed"));
  EXPECT_THAT(text, Not(HasSubstr("s  room.Story10\n")));
  EXPECT_THAT(text, HasSubstr("***Failed 3.25 sec\n"));
  EXPECT_THAT(text, EndsWith(kSummary.substr(1)));
}

TEST(SlowestTests, AreNotListedForFewTests) {
  const std::string output = ctestOutput(20);
  EXPECT_EQ(tableOf(output), output);
}

}  // namespace
}  // namespace swiftlet::repository
