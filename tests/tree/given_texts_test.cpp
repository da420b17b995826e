// The texts that a SubTree, or the default of its model, gives to entries: they count as written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

/// The answer of the first tick of a SubTree that gives n="5".
std::string withFive(const std::string& inside) {
  return Story(R"(<SubTree ID="S" n="5"/>)", "<BehaviorTree ID=\"S\">" + inside + "</BehaviorTree>").tick();
}

TEST(GivenTexts, AreNews) {
  EXPECT_EQ(withFive(R"(<WaitValueUpdate entry="{n}"><AlwaysSuccess/></WaitValueUpdate>)"), "SUCCESS");
  EXPECT_EQ(withFive(R"(<SkipUnlessUpdated entry="{n}"><AlwaysSuccess/></SkipUnlessUpdated>)"), "SUCCESS");
  EXPECT_EQ(withFive(R"(<WasEntryUpdated entry="{n}"/>)"), "SUCCESS");
  EXPECT_EQ(withFive(R"(<Sequence><WasEntryUpdated entry="{n}"/><WasEntryUpdated entry="{n}"/>)"
                     R"(</Sequence>)"),
            "SUCCESS")
      << "each node has the news for itself";
}

TEST(GivenTexts, ThatAreNewsAreSeenOnce) {
  Story story(R"(<SubTree ID="S" n="5"/>)", R"(<BehaviorTree ID="S"><WasEntryUpdated entry="{n}"/></BehaviorTree>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
  EXPECT_EQ(story.tick(), "FAILURE");
}

TEST(GivenTexts, OfAModelAreNews) {
  Story story(R"(<SubTree ID="S"/>)",
              R"(<BehaviorTree ID="S"><WaitValueUpdate entry="{n}"><AlwaysSuccess/></WaitValueUpdate></BehaviorTree>)"
              R"(<TreeNodesModel><SubTree ID="S"><input_port name="n" default="5"/></SubTree></TreeNodesModel>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

}  // namespace
}  // namespace swiftlet::tree::testing
