// Files that are not UTF-8, as editors and other programs write them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/tree/encoding.hpp"
#include "behaviors/tree/migrate.hpp"
#include "behaviors/tree/parameters.hpp"
#include "tests/tree/story.hpp"

namespace swiftlet::tree::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// ASCII in units of so many bytes, the lowest first or last.
std::string wide(std::string_view text, std::size_t bytes, bool big_endian) {
  std::string result;
  for (const char c : text) {
    const std::string zeros(bytes - 1, '\0');
    result += big_endian ? zeros + c : c + zeros;
  }
  return result;
}

std::string declared(const std::string& encoding, const std::string& inside = "<A/>") {
  return "<?xml version=\"1.0\" encoding=\"" + encoding + "\"?>\n" + file(inside);
}

TEST(Encodings, OfUnicodeAreRead) {
  for (const bool big_endian : {false, true}) {
    const std::string utf16 = wide(declared("UTF-16"), 2, big_endian), utf32 = wide(declared("utf-32"), 4, big_endian);
    const std::string mark16 = big_endian ? "\xFE\xFF" : "\xFF\xFE";
    const std::string mark32 = big_endian ? std::string("\0\0\xFE\xFF", 4) : std::string("\xFF\xFE\0\0", 4);
    for (const std::string& text : {utf16, mark16 + utf16, utf32, mark32 + utf32})
      EXPECT_THAT(problemsWithStandIns(text), IsEmpty()) << big_endian;
  }
  EXPECT_THAT(problemsWithStandIns(wide(file("<A/>\n<Nobody/>"), 2, false)),
              ElementsAre(At("2:1 BehaviorTree", "tree.root-count"), At("4:1 Nobody", "tree.unknown-node")));
}

TEST(Encodings, OfTheNamesInAnyCaseAreRead) {
  for (const char* name : {"ASCII", "us-ascii", "utf8", "UTF-8", "Utf-8", "ISO-8859-1", "iso-8859-15", "latin1",
                           "windows-1252", "cp1251", "utf-16", "no-such-encoding"})
    EXPECT_THAT(problemsWithStandIns(declared(name)), IsEmpty()) << name;
  EXPECT_THAT(problemsWithStandIns(declared("ISO-8859-1",
                                            "<!-- gr\xFC\xDF --><A name=\"K\xFC"
                                            "che\"/>")),
              IsEmpty());
  EXPECT_THAT(problemsWithStandIns(declared("latin1",
                                            "<A name=\"K\xC3\xBC"
                                            "che\"/>")),
              IsEmpty())
      << "it is UTF-8 nevertheless";
  EXPECT_THAT(problemsWithStandIns(declared("Shift_JIS", "<A name=\"\x93\x8C\x8B\x9E\"/>")), IsEmpty());
}

TEST(Encodings, ThatAreReadHaveTheirPlaces) {
  EXPECT_THAT(problemsWithStandIns(declared("windows-1252", "<A name=\"\x84q\x93\" ten=\"1\"/>")),
              ElementsAre(At("4:15 A", "tree.unknown-port", "`ten`")));
}

TEST(Encodings, ThatAreNotWhatTheySayAreToldWithARemedy) {
  EXPECT_THAT(problemsWithStandIns(declared("UTF-8",
                                            "<A name=\"K\xFC"
                                            "che\"/>")),
              ElementsAre(At("4:11", "tree.not-utf-8", "`iconv -f WINDOWS-1252 -t UTF-8 f.xml > NEW.xml`")));
  EXPECT_THAT(problemsWithStandIns("<root>\xFF</root>"), ElementsAre(At("1:7", "tree.not-utf-8")));
  EXPECT_THAT(problemsWithStandIns(declared("ascii", "<A name=\"\xFC\"/>")),
              ElementsAre(At("4:10", "tree.not-utf-8", "ascii")));
  EXPECT_THAT(problemsWithStandIns(declared("utf-16", "<A name=\"\xFC\"/>")),
              ElementsAre(At("4:10", "tree.not-utf-8", "utf-16")));
  EXPECT_THAT(problemsWithStandIns(wide("<root/>", 2, false) + "<"),
              ElementsAre(At("1:1", "tree.file-wide", "UTF-16LE")));
}

TEST(Encodings, OfWhatIsRewrittenAreUtf8) {
  const std::string old =
      "<?xml version=\"1.0\" encoding='ISO-8859-1' standalone=\"yes\"?><root><BehaviorTree ID=\"K\xFC"
      "che\">"
      "<SequenceStar><AlwaysSuccess/></SequenceStar></BehaviorTree></root>";
  const Migration migration = migrateToVersion4(old, "f.xml");
  ASSERT_THAT(migration.problems, IsEmpty());
  EXPECT_THAT(migration.text,
              HasSubstr("encoding='UTF-8'      standalone=\"yes\"?><root BTCPP_format=\"4\"><BehaviorTree "
                        "ID=\"K\u00fc"
                        "che\"><SequenceWithMemory>"));
  EXPECT_EQ(inUtf8(migration.text), migration.text);
  const Changed changed = withParameters(declared("latin1", "<A name=\"\xFC\"/>"), "f.xml", Registry::standard(), {});
  EXPECT_THAT(changed.text, HasSubstr("<A name=\"\u00fc\"/>"));
}

TEST(LineEnds, OfAllKindsCountLines) {
  for (const std::string& end : {std::string("\n"), std::string("\r\n"), std::string("\r")}) {
    std::string text = file("<Sequence>\n<A/>\n<Script code=\"n := 1;\n m := 2\"/>\n<Nobody/>\n</Sequence>");
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + end.size()))
      text.replace(at, 1, end);
    EXPECT_THAT(problemsWithStandIns(text), ElementsAre(At("7:1 Nobody", "tree.unknown-node")));
  }
}

}  // namespace
}  // namespace swiftlet::tree::testing
