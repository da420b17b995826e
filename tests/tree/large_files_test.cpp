// Files within the limits are judged in a moment, whatever they hold: nothing takes the square of their size.
#include <ctime>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/migrate.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

/// Processor time, because other programs may run.
class Moment {
 public:
  ~Moment() { EXPECT_LT(static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC, 2.0); }

 private:
  std::clock_t start_ = std::clock();
};

/// Each `#` is the number of the copy.
std::string repeated(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i)
    for (const char c : text) all += c == '#' ? std::to_string(i) : std::string(1, c);
  return all;
}

ParseResult judged(const std::string& text) {
  static const Registry kRegistry = Registry::standard();
  return parseText(text, "f.xml", kRegistry);
}

/// As many as are listed.
void expectMany(const ParseResult& result) {
  ASSERT_EQ(result.problems.size(), 101U);
  EXPECT_EQ(result.problems.back().message.name(), "tree.more-problems");
}

TEST(LargeFiles, WithAttributesThatNothingReads) {
  const Moment moment;
  const std::string attributes = repeated(25'000, " a#=\"1\"");
  expectMany(judged(file("<AlwaysSuccess" + attributes + "/>")));
  expectMany(judged("<root BTCPP_format=\"4\"" + attributes + "><BehaviorTree><AlwaysSuccess/></BehaviorTree></root>"));
  expectMany(
      judged(file("<SubTree ID=\"S\"" + attributes + "/>", "<BehaviorTree ID=\"S\"><AlwaysSuccess/></BehaviorTree>")));
}

TEST(LargeFiles, WithElementsThatAreWrong) {
  const Moment moment;
  expectMany(judged(file("<Sequence>" + repeated(100'000, "<Nope/>") + "</Sequence>")));
  expectMany(judged(file("<AlwaysSuccess/>", "<TreeNodesModel><Action ID=\"X\">" + repeated(50'000, "<input_port/>") +
                                                 "</Action></TreeNodesModel>")));
  expectMany(judged(file("<AlwaysSuccess/>", repeated(50'000, "<BehaviorTree ID=\"T#\"/>"))));
}

TEST(LargeFiles, OfVersion3) {
  const Moment moment;
  const std::string stars = "<root><BehaviorTree ID=\"M\"><Sequence>\n" +
                            repeated(20'000, "<SequenceStar><AlwaysSuccess/></SequenceStar>\n") +
                            "</Sequence></BehaviorTree></root>";
  expectMany(judged(stars));
  EXPECT_EQ(migrateToVersion4(stars, "f.xml").changes.size(), 20'001U);
  const std::string remaps =
      "<root><BehaviorTree ID=\"M\"><SubTree ID=\"S\"" + repeated(20'000, " a#=\"b\"") + "/></BehaviorTree></root>";
  expectMany(judged(remaps));
  EXPECT_EQ(migrateToVersion4(remaps, "f.xml").changes.size(), 20'001U);
}

TEST(LargeFiles, WithManyWritersAndReadersOfOneEntry) {
  const Moment moment;
  const int count = 20'000;
  const ParseResult same =
      judged(file("<Sequence>" + repeated(count, "<SetBlackboard value=\"1\" output_key=\"x\"/>") +
                  repeated(count, "<Repeat num_cycles=\"{x}\"><AlwaysSuccess/></Repeat>") + "</Sequence>"));
  ASSERT_TRUE(same.tree.has_value());
  for (const NodeRecord& node : same.tree->nodes()) {
    if (node.manifest->id != "Repeat") continue;
    ASSERT_THAT(same.tree->knownValues(node.node->id(), "num_cycles"), ::testing::ElementsAre(Value(std::int64_t{1})));
  }
  EXPECT_TRUE(
      judged(file("<Sequence>" + repeated(count, "<SetBlackboard value=\"#\" output_key=\"x\"/>") +
                  repeated(count, "<Script code=\"a# := x\"/><Repeat num_cycles=\"{a#}\"><AlwaysSuccess/></Repeat>") +
                  "</Sequence>"))
          .tree.has_value());
}

TEST(LargeFiles, WithManySiblings) {
  const Moment moment;
  const ParseResult wide = judged(file("<Sequence>" + repeated(50'000, "<AlwaysSuccess/>") + "</Sequence>"));
  ASSERT_TRUE(wide.tree.has_value());
  for (const NodeRecord& node : wide.tree->nodes()) ASSERT_FALSE(wide.tree->pathOf(node.node->id()).empty());
  EXPECT_EQ(wide.tree->pathOf(50'000), "Main/Sequence/AlwaysSuccess[50000]");
}

TEST(LargeFiles, ThatCannotBeMigratedListTheirFirstProblems) {
  const std::string unwritable = "<root><BehaviorTree ID=\"M\"><Sequence>" +
                                 repeated(1000,
                                          "<BlackboardCheckInt value_A=\"{a b}\" value_B=\"1\"><AlwaysSuccess/>"
                                          "</BlackboardCheckInt>") +
                                 "</Sequence></BehaviorTree></root>";
  EXPECT_EQ(migrateToVersion4(unwritable, "f.xml").problems.size(), 101U);
  EXPECT_THAT(migrateToVersion4(std::string((std::size_t{8} << 20) + 1, ' '), "f.xml").problems,
              ::testing::ElementsAre(At("f.xml", "tree.file-large")));
}

}  // namespace
}  // namespace swiftlet::tree::testing
