// What people write into YAML by mistake: each is told its place, the key and what to write instead.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/misleading.hpp"
#include "common/vehicle_config.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::common {
namespace {

using test_support::HasProblem;
using test_support::kAnyName;
using test_support::ProblemIs;
using test_support::problemsOf;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

/// What the reader of a laser's sheet says of the text; nothing if it takes it.
std::vector<Problem> said(const std::string& text) {
  LaserConfig laser;
  return problemsOf([&] { config::YamlReader::fromText(text, "f.yaml").read(laser); });
}

std::string textsOf(const std::vector<Problem>& problems) {
  std::string texts;
  for (const Problem& problem : problems) texts += toString(problem) + "\n";
  return texts;
}

struct Mistake {
  std::string what, text;
  std::string name;
  std::string place;   ///< With the element: "f.yaml:2:3: rate_hz".
  std::string remedy;  ///< The hint.
};

/// For the names of the tests, which must not hold addresses.
void PrintTo(const Mistake& mistake, std::ostream* to) { *to << mistake.what; }

class YamlMistake : public testing::TestWithParam<Mistake> {};

TEST_P(YamlMistake, IsToldWithPlaceAndRemedy) {
  const Mistake& mistake = GetParam();
  const std::vector<Problem> problems = said(mistake.text);
  ASSERT_THAT(problems, ElementsAre(ProblemIs(mistake.name, mistake.place))) << mistake.what;
  EXPECT_EQ(problems[0].hint, mistake.remedy) << mistake.what;
}

INSTANTIATE_TEST_SUITE_P(
    Indentation, YamlMistake,
    testing::Values(Mistake{"deeper below a value", "beams: 4\n  rate_hz: 3\n", "yaml.below-a-value",
                            "f.yaml:2:3: rate_hz", "begin it in column 1"},
                    Mistake{"back to no column", "mount:\n    x_m: 1\n  y_m: 2\n", "yaml.other-column",
                            "f.yaml:3:3: y_m", "begin it in column 5 or 1"},
                    Mistake{"deeper than its neighbour", "mount:\n  x_m: 1\n   y_m: 2\n", "yaml.below-a-value",
                            "f.yaml:3:4: y_m", "begin it in column 3"},
                    Mistake{"below nothing", "mount:\nx_m: 1\n", "config.unknown-key", "f.yaml:2:1",
                            "`x_m` is a key of `mount`: indent it below that"},
                    Mistake{"in a section", "mount:\n  x_m: 1\n  beams: 4\n", "config.unknown-key", "f.yaml:3:3: mount",
                            "`beams` is no key of a section: do not indent it"},
                    Mistake{"dashes", "- beams: 4\n- rate_hz: 3\n", "config.no-keys", "f.yaml:1:1",
                            "leave out the dashes"},
                    Mistake{"a list of keys in a section", "mount:\n- x_m: 1\n- y_m: 2\n", "config.no-keys",
                            "f.yaml:2:1: mount", "leave out the dashes"},
                    Mistake{"an item among keys", "beams: 4\n- rate_hz: 3\n", "yaml.item-for-key",
                            "f.yaml:2:1: rate_hz", "leave out the dash, or give the list a key of its own"},
                    Mistake{"tabs", "mount:\n\tx_m: 1\n\ty_m: 2\n", "yaml.malformed", "f.yaml:2:5: x_m",
                            "YAML is indented by spaces, not tabs"},
                    Mistake{"tabs behind spaces", "mount:\n  x_m: 1\n  \ty_m: 2\n", "yaml.malformed", "f.yaml:3:3: y_m",
                            "YAML is indented by spaces, not tabs"}),
    [](const auto& mistake) { return std::to_string(mistake.index); });

INSTANTIATE_TEST_SUITE_P(Colons, YamlMistake,
                         testing::Values(Mistake{"first", "beams:4\nrate_hz: 3\n", "yaml.malformed",
                                                 "f.yaml:1:1: beams", "put a blank behind the colon: `beams: 4`"},
                                         Mistake{"last", "rate_hz: 3\nbeams:4\n", "config.unknown-key", "f.yaml:2:1",
                                                 "put a blank behind the colon: `beams: 4`"},
                                         Mistake{"in braces", "mount: {x_m:0.1, y_m: 2}\n", "config.unknown-key",
                                                 "f.yaml:1:9: mount", "put a blank behind the colon: `x_m: 0.1`"},
                                         Mistake{"alone", "mount:\n  x_m:0.1\n", "config.no-keys", "f.yaml:2:3: mount",
                                                 "put a blank behind the colon: `x_m: 0.1`"},
                                         Mistake{"equals", "beams = 4\nrate_hz: 3\n", "yaml.malformed",
                                                 "f.yaml:1:1: beams", "write `beams: 4`"},
                                         Mistake{"equals at the end", "rate_hz: 3\nbeams = 4\n", "config.unknown-key",
                                                 "f.yaml:2:1", "write `beams: 4`"},
                                         Mistake{"in a value", "name: a: b\n", "yaml.malformed", "f.yaml:1:8: name",
                                                 "put quotes around the value: `name: 'a: b'`"}),
                         [](const auto& mistake) { return std::to_string(mistake.index); });

INSTANTIATE_TEST_SUITE_P(
    Quotes, YamlMistake,
    testing::Values(Mistake{"brace", "beams: 4\nmount: {x_m: 1\nrate_hz: 3\n", "yaml.not-closed", "f.yaml:2:8: mount",
                            "put a `}` where it ends"},
                    Mistake{"bracket", "beams: [4\nrate_hz: 3\n", "yaml.not-closed", "f.yaml:1:8: beams",
                            "put a `]` where it ends"},
                    Mistake{"double quote", "name: \"x\nbeams: 4\n", "yaml.not-closed", "f.yaml:1:7: name",
                            "put a `\"` where it ends"},
                    Mistake{"single quote", "name: 'x\nbeams: 4\n", "yaml.not-closed", "f.yaml:1:7: name",
                            "put a `'` where it ends"},
                    Mistake{"bracket too many", "beams: 4]\n", "config.other-type", "f.yaml:1:8: beams",
                            "leave out the `]`: no bracket is open there"},
                    Mistake{"path of Windows", "name: \"C:\\xq\"\n", "yaml.malformed", "f.yaml:1:14: name",
                            "in double quotes a backslash begins a special character: use single quotes"},
                    Mistake{"apostrophe", "name: it's: b # don't\n", "yaml.malformed", "f.yaml:1:11: name",
                            "put quotes around the value: `name: \"it's: b\"`"},
                    Mistake{"apostrophe and quotes", "name: @it's \"b\"\n", "yaml.malformed", "f.yaml:1:7: name",
                            "put quotes around the value: `name: '@it''s \"b\"'`"},
                    Mistake{"apostrophe in quotes", "name: 'it's'\n", "yaml.malformed", "f.yaml:1:11: name",
                            "within single quotes an apostrophe is written twice: write `name: \"it's\"`"},
                    Mistake{"special sign", "name: @x\n", "yaml.malformed", "f.yaml:1:7: name",
                            "put quotes around the value: `name: '@x'`"}),
    [](const auto& mistake) { return std::to_string(mistake.index); });

INSTANTIATE_TEST_SUITE_P(
    Numbers, YamlMistake,
    testing::Values(
        Mistake{"comma", "range_max_m: 3,5\n", "config.other-type", "f.yaml:1:14: range_max_m", "write `3.5`"},
        Mistake{"comma in braces", "mount: {x_m: -0,05}\n", "config.unknown-key", "f.yaml:1:17: mount",
                "write decimals with a point"},
        Mistake{"two marks", "range_max_m: 1.234,5\n", "config.other-type", "f.yaml:1:14: range_max_m",
                "write decimals with a point, and no other marks"},
        Mistake{"unit of the key", "range_max_m: 3,5 m\n", "config.other-type", "f.yaml:1:14: range_max_m",
                "write `3.5`: the key's name has the unit"},
        Mistake{"degrees", "field_of_view_deg: 270\xc2\xb0\n", "config.other-type", "f.yaml:1:20: field_of_view_deg",
                "write `270`: the key's name has the unit"},
        Mistake{"degrees in Latin-1", "field_of_view_deg: 270\xb0\n", "config.other-type",
                "f.yaml:1:20: field_of_view_deg", "write `270`: the key's name has the unit"},
        Mistake{"another unit", "range_max_m: 350cm\n", "config.other-type", "f.yaml:1:14: range_max_m",
                "write the number alone, in the unit that the key's name ends with"},
        Mistake{"per cent", "dropout_rate: 3%\n", "config.other-type", "f.yaml:1:15: dropout_rate",
                "write `0.03`: shares are of 1"},
        Mistake{"a comma of thousands", "beams: 1,081\n", "config.other-type", "f.yaml:1:8: beams",
                "write a whole number, without points or commas"},
        Mistake{"decimals of a whole number", "beams: 4,5\n", "config.other-type", "f.yaml:1:8: beams",
                "write a whole number, without points or commas"},
        Mistake{"a unit of a key without one", "dropout_rate: 5ms\n", "config.other-type", "f.yaml:1:15: dropout_rate",
                "write the number alone, in the unit in which it is described"},
        Mistake{"three decimals", "range_max_m: 0,125\n", "config.other-type", "f.yaml:1:14: range_max_m",
                "write `0.125`"},
        Mistake{"thousands", "beams: 1'081\n", "config.other-type", "f.yaml:1:8: beams", "write `1081`"},
        Mistake{"comment", "beams: 4#x\n", "config.other-type", "f.yaml:1:8: beams",
                "put a blank before the comment: `4 #x`"},
        Mistake{"list of one", "beams: [4]\n", "config.other-type", "f.yaml:1:8: beams",
                "leave out the brackets or the dash"}),
    [](const auto& mistake) { return std::to_string(mistake.index); });

INSTANTIATE_TEST_SUITE_P(
    Characters, YamlMistake,
    testing::Values(Mistake{"no-break space",
                            "beams:\xc2\xa0"
                            "4\nrate_hz: 3\n",
                            "yaml.malformed", "f.yaml:1:1: beams",
                            "line 1 has a no-break space (U+00A0) in column 7: write a plain blank"},
                    Mistake{"that indents", "mount:\n\xc2\xa0\xc2\xa0x_m: 1\n", "config.unknown-key", "f.yaml:2:1",
                            "line 2 has a no-break space (U+00A0) in column 1: write a plain blank"},
                    Mistake{"zero width",
                            "\xe2\x80\x8b"
                            "beams: 4\n",
                            "config.unknown-key", "f.yaml:1:1",
                            "line 1 has a zero-width space (U+200B) in column 1: write nothing there"},
                    Mistake{"typographic minus",
                            "mount: {x_m: \xe2\x88\x92"
                            "0.1}\n",
                            "config.other-type", "f.yaml:1:14: mount.x_m",
                            "line 1 has a minus sign (U+2212) in column 14: write a plain minus"}),
    [](const auto& mistake) { return std::to_string(mistake.index); });

INSTANTIATE_TEST_SUITE_P(
    Wholes, YamlMistake,
    testing::Values(Mistake{"given twice", "beams: 4\nrate_hz: 3\nbeams: 5\n", "config.key-twice", "f.yaml:3:1",
                            "it is in line 1 too: leave out one of the two"},
                    Mistake{"two documents", "beams: 4\n---\nbeams: 5\n", "yaml.second-document", "f.yaml:3:1",
                            "leave out the line `---`, or give each its own file"},
                    Mistake{"a merge", "<<<<<<< HEAD\nbeams: 4\n=======\nbeams: 5\n>>>>>>> b\n", "yaml.merge-conflict",
                            "f.yaml:1:1",
                            "keep one of the two, and take out the lines that begin with <<<<<<<, ======= and "
                            ">>>>>>>"}),
    [](const auto& mistake) { return std::to_string(mistake.index); });

INSTANTIATE_TEST_SUITE_P(
    Causes, YamlMistake,
    testing::Values(
        Mistake{"first line indented", " beams: 4\nrate_hz: 3\n", "yaml.first-indented", "f.yaml:1:2: beams",
                "begin it in column 1"},
        Mistake{"INI file", "[laser]\nbeams = 4\n", "yaml.ini-section", "f.yaml:1:1",
                "write `laser:`, and below it, indented, each setting as `key: value`"},
        Mistake{"equals in all lines", "beams = 4\nname = x\n", "config.no-keys", "f.yaml:1:1", "write `beams: 4`"},
        Mistake{"dash without a blank", "name:\n  -{x: 1}\n", "config.other-type", "f.yaml:2:3: name",
                "put a blank behind the dash: `- {x: 1}`"},
        Mistake{"share in a unit", "range_max_m: 60%\n", "config.other-type", "f.yaml:1:14: range_max_m",
                "write the number alone, in the unit that the key's name ends with"},
        Mistake{"nothing", "rate_hz: \n\nbeams: 4\n", "config.other-type", "f.yaml:1:1: rate_hz",
                "write a value behind the colon, or leave out the key"},
        Mistake{"comment for a value", "name: #1\nbeams: 4\n", "config.other-type", "f.yaml:1:1: name",
                "`#` begins a comment: put quotes around a value that has one"},
        Mistake{"list for a value", "beams: [4, 5]\n", "config.other-type", "f.yaml:1:8: beams",
                "write one value, without brackets or dashes"},
        Mistake{"keys for a value", "beams: {n: 4}\n", "config.other-type", "f.yaml:1:8: beams",
                "write the value alone, without keys"},
        Mistake{"full-width digit", "range_max_m: \xef\xbc\x90.6\n", "config.other-type", "f.yaml:1:14: range_max_m",
                "line 1 has a character that looks like `0` (U+FF10) in column 14: write `0`"}),
    [](const auto& mistake) { return std::to_string(mistake.index); });

TEST(Misleading, IsNamedWithWhatIsMeant) {
  EXPECT_EQ(misleadingHint("cobra\xe2\x80\x8b"), "it has a zero-width space (U+200B): write nothing there");
  EXPECT_EQ(misleadingHint("c\xd0\xbe"
                           "bra"),
            "it has a Cyrillic letter (U+043E): write the Latin one");
  EXPECT_EQ(misleadingHint("\xe2\x80\x9c"
                           "cobra\xe2\x80\x9d"),
            "it has a character that looks like `\"` (U+201C): write `\"`");
  EXPECT_EQ(misleadingHint("a\xe2\x80\xa8"
                           "b"),
            "it has a line separator (U+2028): write a new line");
  EXPECT_EQ(misleadingHint(std::string("a\0", 2)), "it has a control character (U+0000): write nothing there");
  for (const char* fine : {"cobra",
                           "gr\xc3\xb6\xc3\x9f"
                           "er",
                           "\xd0\xba\xd0\xbe", "\xff\xfe", ""})
    EXPECT_EQ(misleadingHint(fine), "") << fine;
}

TEST(Yaml, WhatEditorsOfOtherSystemsSaveIsRead) {
  EXPECT_THAT(said("\xef\xbb\xbf"
                   "beams: 4\n"),
              IsEmpty())
      << "a byte order mark";
  EXPECT_THAT(said("beams: 4\r\nmount:\r\n  x_m: 1\r\n"), IsEmpty()) << "lines of Windows";
  EXPECT_THAT(said("beams: 4\rmount:\r  x_m: 1\r"), IsEmpty()) << "lines of old Macs";
  EXPECT_THAT(said(std::string("\xff\xfe"
                               "b\0e\0a\0m\0s\0:\0 \0"
                               "4\0\n\0",
                               20)),
              IsEmpty())
      << "UTF-16";
  EXPECT_THAT(said("---\nbeams: 4\n...\n"), IsEmpty()) << "with the marks of a document";
}

/// As PowerShell 5 saves it.
std::string utf16(const std::string& ascii) {
  std::string text = "\xff\xfe";
  for (const char letter : ascii) text += {letter, '\0'};
  return text;
}

TEST(Yaml, MistakesInUtf16AreToldAsThoseInUtf8) {
  for (const std::string text : {"beams: x\nmount: 4\n", "beams:4\nrate_hz: 3\n", "name: \"x\nbeams: 4\n",
                                 "[laser]\nbeams = 4\n", "beams: 4\n{a: 1} b: 2\n", "{a: 1} b: 2\n"}) {
    EXPECT_THAT(said(text), Not(IsEmpty()));
    EXPECT_EQ(textsOf(said(utf16(text))), textsOf(said(text)));
    EXPECT_EQ(textsOf(said("\xef\xbb\xbf" + text)), textsOf(said(text))) << "a byte order mark";
  }
  EXPECT_THAT(said(utf16("beams: 4\r\nrate_hz: x\r\n")),
              ElementsAre(ProblemIs("config.other-type", "f.yaml:2:10: rate_hz", "`x`")));
}

TEST(Yaml, LinesThatEndAsOnOldMacsAreLines) {
  EXPECT_THAT(said("name: x\rbeams: 4\nrate_hz: y\n"),
              ElementsAre(ProblemIs("config.other-type", "f.yaml:3:10: rate_hz", "`y`")));
}

TEST(Yaml, OfVeryManyMistakesTheFirstAreTold) {
  std::string text;
  for (int i = 0; i < 16'000; ++i) text += "unknown_" + std::to_string(i) + ": 1\n";
  const std::vector<Problem> problems = said(text);
  ASSERT_EQ(problems.size(), 101u);
  EXPECT_THAT(problems[99], ProblemIs("config.unknown-key", "f.yaml:100:1", "`unknown_99`"));
  EXPECT_THAT(problems[100], ProblemIs("config.more-problems", "f.yaml", "15900"));
}

TEST(Yaml, WhatIsRightIsNotDoubted) {
  EXPECT_THAT(said("name: it's\nbeams: 4 # don't\n"), IsEmpty());
  EXPECT_THAT(said("name: \"5\xc2\xa0m: 'laser'\"\n"), IsEmpty()) << "a no-break space in quotes";
  EXPECT_THAT(said("name: |\n  it's \"x\n  [\nbeams: 4\n"), IsEmpty());
  EXPECT_THAT(said("mount: {x_m: 1,\n  y_m: 2\n}\nbeams: 4\t# a comment\n"), IsEmpty());
  EXPECT_THAT(said(""), IsEmpty());
  EXPECT_THAT(said("name: a: b\n"), Not(HasProblem(kAnyName, "", "tabs"))) << "it has another cause";
  EXPECT_THAT(said("beams: 4.5\n"), ElementsAre(ProblemIs("config.other-type", "beams", "a whole number")));
}

}  // namespace
}  // namespace swiftlet::common
