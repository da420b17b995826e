// Slips that XML shows at another place, or not at all: comments, tags within tags, a page in the place of a file,
// names that look the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;

std::vector<Problem> slipsOf(const std::string& text) {
  return parseText(text, "f.xml", Registry::standard()).problems;
}

/// `inside` starts at line 3, column 1.
std::vector<Problem> slipsIn(const std::string& inside, const std::string& more = {}) {
  return slipsOf(file(inside, more));
}

TEST(Slips, ACommentThatEndsEarlierThanMeantIsTold) {
  EXPECT_THAT(slipsIn("<Sequence><!-- A --> B --> C --><AlwaysSuccess/></Sequence>"),
              ElementsAre(At("3:24 -->", "tree.comment-ended", "line 3")));
  EXPECT_THAT(slipsIn("<Sequence><!-- <Sequence> <!-- a --> <Sleep/> </Sequence> -->\n<AlwaysSuccess/></Sequence>"),
              ElementsAre(At("3:59 -->", "tree.comment-ended", "line 3")));
  EXPECT_THAT(slipsIn("<Sequence>--><AlwaysSuccess/></Sequence>"),
              ElementsAre(At("3:11 -->", "tree.comment-unopened")));
  EXPECT_THAT(slipsIn("<Sequence>go<!-- a --><AlwaysSuccess/></Sequence>"),
              ElementsAre(At("3:11 Sequence", "tree.stray-text")));
}

TEST(Slips, ATagWithinATagIsToldByWhatItIs) {
  EXPECT_THAT(slipsIn("<Sleep <!-- home --> msec=\"1;1\"/>"),
              ElementsAre(At("3:8 <BehaviorTree>", "tree.xml-malformed", "a comment stands between two tags")));
  EXPECT_THAT(slipsIn("<Sleep msec='1;1' <AlwaysSuccess/>"),
              ElementsAre(At("3:19 <BehaviorTree>", "tree.xml-malformed", "the tag before has no >")));
  EXPECT_THAT(slipsIn("<Sleep msec='<!-- 1;1'/>"),
              ElementsAre(At("3:14 <BehaviorTree>", "tree.xml-malformed", "&lt;")));
}

TEST(Slips, AnHtmlPageIsTold) {
  for (const auto& [page, place] : {std::pair{"<!DOCTYPE html>\n<html lang=\"en\"><br></html>", "1:15"},
                                    {"<!doctype HTML><p>", "1:1"},
                                    {"<HTML><br></HTML>", "1:1"}})
    EXPECT_THAT(slipsOf(page), ElementsAre(At(place, "tree.html-page"))) << page;
}

TEST(Slips, ANameThatLooksTheSameIsNamedByItsCharacter) {
  const std::string set = "<SetBlackboard value=\"1\" output_key=\"n\u200cn\"/>";
  EXPECT_THAT(slipsIn("<Sequence>" + set + "<ScriptCondition code=\"nn == 1\"/></Sequence>"),
              ElementsAre(At("3:71 ScriptCondition.code", "tree.entry-unset", "{nn}", "`n\u200cn`", "U+200C")));
  EXPECT_THAT(slipsIn("<SubTree ID=\"a-b\"/>", "<BehaviorTree ID=\"a\u2212b\"><AlwaysSuccess/></BehaviorTree>"),
              ElementsAre(At("3:10 SubTree", "tree.unknown-tree", "U+2212")));
}

TEST(Slips, AMarkThatIsNoCommentIsTold) {
  for (const auto& [mark, place] :
       {std::pair{"<! -- a -->", "3:13 <Sequence>"}, {"<!- a -->", "3:14 <Sequence>"}, {"<!a>", "3:13 <Sequence>"}})
    EXPECT_THAT(slipsIn("<Sequence>" + std::string(mark) + "<AlwaysSuccess/></Sequence>"),
                ElementsAre(At(place, "tree.xml-malformed", "<!-- text -->")))
        << mark;
}

TEST(Slips, WhatXmlReservesIsReportedWithHowItIsWritten) {
  EXPECT_THAT(slipsIn("<Script code=\"a := 1 && 0\"/>"),
              ElementsAre(At("3:23 <BehaviorTree>", "tree.xml-malformed", "&amp;")));
  EXPECT_THAT(slipsIn("<Script code=\"a := 1 & 0\"/>"),
              ElementsAre(At("3:23 <BehaviorTree>", "tree.xml-malformed", "&amp;")));
  EXPECT_THAT(slipsIn("<ScriptCondition code=\"1 < 2\"/>"),
              ElementsAre(At("3:26 <BehaviorTree>", "tree.xml-malformed", "&lt;")));
  EXPECT_THAT(slipsIn("<Script code=1/>"), ElementsAre(At("3:14 <BehaviorTree>", "tree.xml-malformed", "quotes")));
}

}  // namespace
}  // namespace swiftlet::tree::testing
