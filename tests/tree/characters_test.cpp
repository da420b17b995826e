// Characters that cannot be seen, or look like others: whatever reads them names them by their code point.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/characters.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Characters, HaveLengthsOnlyWhereTheyAreUtf8) {
  const std::string text = "a\u00e9\u2212\U0001F600";
  EXPECT_EQ(characterLength(text, 0), 1U);
  EXPECT_EQ(characterLength(text, 1), 2U);
  EXPECT_EQ(characterLength(text, 3), 3U);
  EXPECT_EQ(characterLength(text, 6), 4U);
  EXPECT_EQ(characterLength(text, 2), 0U) << "within one";
  EXPECT_EQ(characterLength(text, 10), 0U) << "behind the end";
  EXPECT_EQ(characterLength("\xE2\x88", 0), 0U) << "cut off";
  EXPECT_TRUE(isUtf8(text));
  EXPECT_FALSE(isUtf8("gr\xFC\xDF"));
}

TEST(Characters, AreNamedByCodePoint) {
  EXPECT_EQ(nameOfCharacter("\u00a0", 0), "U+00A0 (no-break space, write a blank)");
  EXPECT_EQ(nameOfCharacter("x\u200b", 1), "U+200B (zero width space, take it out)");
  EXPECT_EQ(nameOfCharacter("\u2212", 0), "U+2212 (minus sign, write `-`)");
  EXPECT_EQ(nameOfCharacter("\uff1b", 0), "U+FF1B (full-width form, write `;`)");
  EXPECT_EQ(nameOfCharacter("\u00e9", 0), "U+00E9");
  EXPECT_EQ(nameOfCharacter("\v", 0), "U+000B (control character, take it out)");
}

TEST(Characters, ThatMisleadNobodyAreNotMentioned) {
  EXPECT_EQ(misleadingCharacterIn("`Küche` is not a point, дверь, 東京, 20 °C"), "");
  EXPECT_THAT(misleadingCharacterIn("`\u0422akeOff`"), HasSubstr("U+0422 (a Cyrillic letter)"));
  EXPECT_THAT(misleadingCharacterIn("`Ph\u03bftograph`"), HasSubstr("U+03BF (a Greek letter)"));
  EXPECT_EQ(misleadingCharacterIn("\xFF\xE2 only bytes"), "");
}

TEST(Characters, AreNamedWhereverTheyStand) {
  const auto expectNamed = [](const std::string& inside, const char* name) {
    EXPECT_THAT(toString(problemsWithStandIns(file(inside))), HasSubstr(name)) << inside;
  };
  expectNamed("<A\u200b/>", "U+200B (zero width space");
  expectNamed("<A\u00a0name=\"a\"/>", "U+00A0 (no-break space");
  expectNamed("<A name=\u201ca\u201d/>", "U+201C (left double quotation mark, write `\"`)");
  expectNamed("<Sequence>\ufeff<A/></Sequence>", "U+FEFF (byte order mark");
  expectNamed("<Sequence><A/>\u00a0</Sequence>", "U+00A0 (no-break space");
  expectNamed("<Repeat num_cycles=\"\u22121\"><A/></Repeat>", "U+2212 (minus sign");
  expectNamed("<Repeat num_cycles=\"\uff13\"><A/></Repeat>", "U+FF13 (full-width form, write `3`)");
  expectNamed("<Timeout msec=\"1\u202f000\"><A/></Timeout>", "U+202F (narrow no-break space");
  expectNamed("<Timeout m\u00b7sec=\"1\"><A/></Timeout>", "U+00B7 (middle dot");
  expectNamed("<SubTree ID=\"Main\u200e\"/>", "U+200E (left-to-right mark");
  expectNamed("<ScriptCondition code=\"ready\u00ad\"/>", "U+00AD (soft hyphen");
  expectNamed("<Script code=\"\u00a0 n := 1\"/>", "U+00A0 (no-break space");
  expectNamed("<ScriptCondition code=\"1 \u2265 1\"/>", "U+2265 (greater-than or equal to, write `>=`)");
  expectNamed("<Script code=\"a := 1\uff1bb := 2\"/>", "U+FF1B (full-width form, write `;`)");
  expectNamed("<Script code=\"s := \u2018text\u2019\"/>", "U+2018 (left single quotation mark");
  expectNamed("<Script code=\"na\u00efve := 1\"/>", "U+00EF");
  expectNamed("<Sequence><Script code=\"n := 1\"/><Repeat num_cycles=\"{n\u200b}\"><A/></Repeat></Sequence>", "U+200B");
}

TEST(Characters, AreNamedAroundTheElements) {
  EXPECT_THAT(problemsWithStandIns("\n\ufeff" + file("<A/>")),
              ElementsAre(At("2:1", "tree.xml-malformed", "U+FEFF (byte order mark, take it out)")));
  EXPECT_THAT(problemsWithStandIns(file("<A/>") + "\ufeff" + file("<A/>")),
              ElementsAre(At("6:1", "tree.xml-malformed", "U+FEFF")));
  EXPECT_THAT(problemsWithStandIns(file("<A/>") + "\x1a"), ElementsAre(At("6:1", "tree.xml-malformed", "U+001A")));
  EXPECT_THAT(problemsWithStandIns("\ufeff" + file("<A/>")), ElementsAre())
      << "one mark at the beginning is as it should be";
}

TEST(Characters, OfATextThatIsAllowedAreNotMentioned) {
  EXPECT_THAT(problemsWithStandIns(
                  file("<Sequence name=\"wait \u2013 look\"><Script code=\"s := '\u201cgo\u201d'\"/></Sequence>")),
              ElementsAre());
  EXPECT_THAT(toString(problemsWithStandIns(file("<Sequence name=\"\u2013\"/>"))), Not(HasSubstr("U+")));
}

}  // namespace
}  // namespace swiftlet::tree::testing
