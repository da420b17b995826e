// Files within the limits are judged in a moment, whatever they hold: nothing takes the square of their size.
#include <ctime>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/migrate.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::HasSubstr;

/// Processor time, because other programs may run.
class Moment {
 public:
  ~Moment() { EXPECT_LT(static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC, 2.0); }

 private:
  std::clock_t start_ = std::clock();
};

std::string repeated(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) {
    const std::size_t at = text.find('#');
    all += text.substr(0, at);
    if (at != std::string::npos) all += std::to_string(i) + text.substr(at + 1);
  }
  return all;
}

ParseResult read(const std::string& text) {
  static const Registry kRegistry = Registry::standard();
  return parseText(text, "f.xml", kRegistry);
}

/// As many as are listed.
void expectMany(const ParseResult& result) {
  ASSERT_EQ(result.problems.size(), 101U);
  EXPECT_EQ(result.problems.back().message, "there are more problems");
}

TEST(LargeFiles, WithAttributesThatNothingReads) {
  const Moment moment;
  const std::string attributes = repeated(25'000, " a#=\"1\"");
  expectMany(read(file("<AlwaysSuccess" + attributes + "/>")));
  expectMany(read("<root BTCPP_format=\"4\"" + attributes + "><BehaviorTree><AlwaysSuccess/></BehaviorTree></root>"));
  expectMany(
      read(file("<SubTree ID=\"S\"" + attributes + "/>", "<BehaviorTree ID=\"S\"><AlwaysSuccess/></BehaviorTree>")));
}

TEST(LargeFiles, WithElementsThatAreWrong) {
  const Moment moment;
  expectMany(read(file("<Sequence>" + repeated(100'000, "<Nope/>") + "</Sequence>")));
  expectMany(read(file("<AlwaysSuccess/>", "<TreeNodesModel><Action ID=\"X\">" + repeated(50'000, "<input_port/>") +
                                               "</Action></TreeNodesModel>")));
  expectMany(read(file("<AlwaysSuccess/>", repeated(50'000, "<BehaviorTree ID=\"T#\"/>"))));
}

TEST(LargeFiles, OfVersion3) {
  const Moment moment;
  const std::string stars = "<root><BehaviorTree ID=\"M\"><Sequence>\n" +
                            repeated(20'000, "<SequenceStar><AlwaysSuccess/></SequenceStar>\n") +
                            "</Sequence></BehaviorTree></root>";
  expectMany(read(stars));
  EXPECT_EQ(migrateToVersion4(stars, "f.xml").changes.size(), 20'001U);
  const std::string remaps =
      "<root><BehaviorTree ID=\"M\"><SubTree ID=\"S\"" + repeated(20'000, " a#=\"b\"") + "/></BehaviorTree></root>";
  expectMany(read(remaps));
  EXPECT_EQ(migrateToVersion4(remaps, "f.xml").changes.size(), 20'001U);
}

TEST(LargeFiles, ThatCannotBeMigratedListTheirFirstProblems) {
  const std::string unwritable = "<root><BehaviorTree ID=\"M\"><Sequence>" +
                                 repeated(1000,
                                          "<BlackboardCheckInt value_A=\"{a b}\" value_B=\"1\"><AlwaysSuccess/>"
                                          "</BlackboardCheckInt>") +
                                 "</Sequence></BehaviorTree></root>";
  EXPECT_EQ(migrateToVersion4(unwritable, "f.xml").problems.size(), 101U);
  EXPECT_THAT(linesOf(migrateToVersion4(std::string((std::size_t{8} << 20) + 1, ' '), "f.xml").problems),
              ::testing::ElementsAre("f.xml: is larger than 8388608 bytes"));
}

}  // namespace
}  // namespace swiftlet::tree::testing
