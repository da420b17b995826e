// Slips that XML shows at another place, or not at all: comments, tags within tags, a page in the place of a file,
// names that look the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> slipsOf(const std::string& text) {
  return linesOf(parseText(text, "f.xml", Registry::standard()).problems);
}

/// `inside` starts at line 3, column 1.
std::vector<std::string> slipsIn(const std::string& inside, const std::string& more = {}) {
  return slipsOf(file(inside, more));
}

TEST(Slips, ACommentThatEndsEarlierThanMeantIsTold) {
  const std::string ended = "--> in line 3 already, a comment ends at its first -->";
  EXPECT_THAT(slipsIn("<Sequence><!-- A --> B --> C --><AlwaysSuccess/></Sequence>"),
              ElementsAre(AllOf(HasSubstr("f.xml:3:24: -->: the comment before has ended at the "), HasSubstr(ended))));
  EXPECT_THAT(slipsIn("<Sequence><!-- <Sequence> <!-- a --> <Sleep/> </Sequence> -->\n<AlwaysSuccess/></Sequence>"),
              ElementsAre(AllOf(HasSubstr("f.xml:3:59: -->: "), HasSubstr(ended))));
  EXPECT_THAT(slipsIn("<Sequence>--><AlwaysSuccess/></Sequence>"),
              ElementsAre(HasSubstr("f.xml:3:11: -->: no comment begins before it")));
  EXPECT_THAT(slipsIn("<Sequence>go<!-- a --><AlwaysSuccess/></Sequence>"),
              ElementsAre(HasSubstr("text is not expected here")));
}

TEST(Slips, ATagWithinATagIsToldByWhatItIs) {
  EXPECT_THAT(slipsIn("<Sleep <!-- home --> msec=\"1;1\"/>"),
              ElementsAre(HasSubstr("a comment stands between two tags, move it out of this one")));
  EXPECT_THAT(slipsIn("<Sleep msec='1;1' <AlwaysSuccess/>"),
              ElementsAre(HasSubstr("the tag before has no > at its end")));
  EXPECT_THAT(slipsIn("<Sleep msec='<!-- 1;1'/>"), ElementsAre(HasSubstr("in a value, write < as &lt;")));
}

TEST(Slips, AnHtmlPageIsTold) {
  for (const char* page : {"<!DOCTYPE html>\n<html lang=\"en\"><br></html>", "<!doctype HTML><p>", "<HTML><br></HTML>"})
    EXPECT_THAT(slipsOf(page), ElementsAre(HasSubstr("this is an HTML page, not a file of trees"))) << page;
}

TEST(Slips, ANameThatLooksTheSameIsNamedByItsCharacter) {
  const std::string set = "<SetBlackboard value=\"1\" output_key=\"n\u200cn\"/>";
  EXPECT_THAT(slipsIn("<Sequence>" + set + "<ScriptCondition code=\"nn == 1\"/></Sequence>"),
              ElementsAre(AllOf(HasSubstr("nothing sets the entry {nn}, did you mean `n"),
                                HasSubstr("which holds U+200C (zero width non-joiner, take it out)?"))));
  EXPECT_THAT(slipsIn("<SubTree ID=\"a-b\"/>", "<BehaviorTree ID=\"a\u2212b\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(HasSubstr("which holds U+2212 (minus sign, write `-`)?")));
}

TEST(Slips, AMarkThatIsNoCommentIsTold) {
  for (const char* mark : {"<! -- a -->", "<!- a -->", "<!a>"})
    EXPECT_THAT(slipsIn("<Sequence>" + std::string(mark) + "<AlwaysSuccess/></Sequence>"),
                ElementsAre(HasSubstr("a comment is written as <!-- text -->")))
        << mark;
}

TEST(Slips, WhatXmlReservesIsReportedWithHowItIsWritten) {
  EXPECT_THAT(slipsIn("<Script code=\"a := 1 && 0\"/>"),
              ElementsAre(AllOf(HasSubstr("f.xml:3:23: "), HasSubstr(", write & as &amp;"))));
  EXPECT_THAT(slipsIn("<Script code=\"a := 1 & 0\"/>"), ElementsAre(HasSubstr(", write & as &amp;")));
  EXPECT_THAT(slipsIn("<ScriptCondition code=\"1 < 2\"/>"),
              ElementsAre(AllOf(HasSubstr("f.xml:3:26: "), HasSubstr(", in a value, write < as &lt;"))));
  EXPECT_THAT(slipsIn("<Script code=1/>"), ElementsAre(HasSubstr(", put the value in quotes")));
}

}  // namespace
}  // namespace swiftlet::tree::testing
