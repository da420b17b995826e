// The texts that a SubTree, or the default of its model, gives to entries: they count as written, scripts see the
// numbers that they are, and ports read them as they stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/leaf.hpp"
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

TEST(GivenTexts, AreNumbersForScripts) {
  const auto holds = [](const std::string& given, const std::string& code) {
    return Story("<SubTree ID=\"S\" " + given + "/>",
                 "<BehaviorTree ID=\"S\"><ScriptCondition code=\"" + code + "\"/></BehaviorTree>")
        .tick();
  };
  EXPECT_EQ(holds(R"(lo="9" hi="10")", "lo &lt; hi"), "SUCCESS");
  EXPECT_EQ(holds(R"(lo="9" hi="10")", "lo + hi == 19"), "SUCCESS");
  EXPECT_EQ(holds(R"(a="1" b="1.0")", "a == b"), "SUCCESS");
  EXPECT_EQ(holds(R"(a="1e3" b="-0.5")", "a + b == 999.5"), "SUCCESS");
  EXPECT_EQ(holds(R"(a="9007199254740993")", "a - 9007199254740992 == 1"), "SUCCESS") << "whole numbers stay exact";
  EXPECT_EQ(holds(R"(a="1;2" b="3")", "a + b == '1;23'"), "FAILURE") << "a text and a number";
  EXPECT_EQ(holds(R"(a="1m" b=" 2")", "a + b == '1m 2'"), "SUCCESS") << "only the whole text";
  EXPECT_EQ(holds(R"(a="nan" b="inf")", "a .. b == 'naninf'"), "SUCCESS");
}

TEST(GivenTexts, AreNumbersAlsoWhereTheyAreCopied) {
  Story story(R"(<SubTree ID="S" lo="9" hi="10"/>)",
              R"(<BehaviorTree ID="S"><Sequence><SetBlackboard value="{lo}" output_key="{a}"/>)"
              R"(<SetBlackboard value="{hi}" output_key="{b}"/><ScriptCondition code="a &lt; b"/></Sequence>)"
              R"(</BehaviorTree>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(GivenTexts, AreNumbersAlsoInTreesBelowAndInModels) {
  Story story(R"(<SubTree ID="S" n="9"/>)",
              R"(<BehaviorTree ID="S"><SubTree ID="T" m="{n}"/></BehaviorTree>)"
              R"(<BehaviorTree ID="T"><ScriptCondition code="m &lt; limit"/></BehaviorTree>)"
              R"(<TreeNodesModel><SubTree ID="T"><input_port name="m"/><input_port name="limit" default="10"/>)"
              R"(</SubTree></TreeNodesModel>)");
  EXPECT_EQ(story.tick(), "SUCCESS");
}

TEST(GivenTexts, AreReplacedByWhatIsWritten) {
  Story text(R"(<SubTree ID="S" n="5"/>)", R"(<BehaviorTree ID="S"><Sequence><Script code="n := 'five'; n := n + n"/>)"
                                           R"(<ScriptCondition code="n == 'fivefive'"/></Sequence></BehaviorTree>)");
  EXPECT_EQ(text.tick(), "SUCCESS");
  Story number(R"(<SubTree ID="S" n="5"/>)",
               R"(<BehaviorTree ID="S"><Sequence><SetBlackboard value="6" output_key="n"/>)"
               R"(<ScriptCondition code="n == '6' &amp;&amp; n + '1' == '61'"/></Sequence></BehaviorTree>)");
  EXPECT_EQ(number.tick(), "SUCCESS") << "SetBlackboard writes text";
}

class TextReader final : public Leaf {
 public:
  TextReader(const NodeSetup& setup, std::vector<std::string>& read) : Leaf(setup), text_(setup, "text"), read_(read) {}

 private:
  Status act(TickContext&) override {
    read_.push_back(text_.get().value_or("nothing"));
    return Status::kSuccess;
  }

  Input<std::string> text_;
  std::vector<std::string>& read_;
};

TEST(GivenTexts, StayAsTheyAreForPortsOfText) {
  std::vector<std::string> read;
  Registry registry = Registry::standard();
  registry.add({.id = "Say", .kind = NodeKind::kAction, .ports = {{.name = "text", .required = true}}},
               [&read](const NodeSetup& setup) { return std::make_unique<TextReader>(setup, read); });
  Story story(file(R"(<SubTree ID="S" id="007" price="1.50"/>)",
                   R"(<BehaviorTree ID="S"><Sequence><Say text="{id}"/><Say text="{price}"/><Script code="id += 1"/>)"
                   R"(<Say text="{id}"/></Sequence></BehaviorTree>)"),
              registry);
  EXPECT_EQ(story.tick(), "SUCCESS");
  EXPECT_THAT(read, ::testing::ElementsAre("007", "1.50", "8"));
}

}  // namespace
}  // namespace swiftlet::tree::testing
