// Trees as people and other programs write them: the real cases, if this machine has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/datasets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;

class FieldTrees : public test_support::Scratch {
 protected:
  static ProgramEnd check(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "check");
    return runSwiftlet(arguments);
  }
  static void expectRead(const ProgramEnd& end) { EXPECT_EQ(end.exit_code, 0) << describe(end); }
};

TEST_F(FieldTrees, AreReadOrRefusedWithTheTrueReason) {
  const auto cases = test_support::dataSet("10-field-cases");
  if (!cases) return;
  const auto file = [&](const char* name) { return (*cases / name).string(); };

  const std::string groot1 = file("bt_comment_dashes/G1_groot_old.xml");
  expectRead(runSwiftlet({"migrate", groot1, "--out", path("new.xml")}));
  expectRead(check({"--mock-leaves", path("new.xml")}));
  expectRead(check({file("bt_comment_dashes/X_comment_rule.xml")}));
  expectRead(check({"--system", "swiftlet_3d", file("bt_groot2_empty_ports/H1_groot2_empty_ports.xml")}));
  expectRead(check({"--mock-leaves", file("bt_mock_runtime_entries/M3_runtime_entry.xml")}));
  expectRead(check({"--mock-leaves", file("bt_root_private_attribute/M4_root_attr.xml")}));
  expectRead(
      check({"--mock-leaves", file("bt_trees_in_several_files/setA.xml"), file("bt_trees_in_several_files/setB.xml")}));

  const std::string unseen = check({file("bt_invisible_characters/B11_nbsp.xml")}).err;
  for (const char* name :
       {"U+00A0 (no-break space", "U+2265 (greater-than or equal to", "U+00EF", "U+2018 (left single"})
    EXPECT_THAT(unseen, HasSubstr(name));
  EXPECT_THAT(check({file("bt_invisible_characters/X_zero_width.xml")}).err, HasSubstr("U+200B (zero width space"));
  EXPECT_THAT(check({file("bt_main_tree_hint/M2_main_hint_one_file.xml")}).err,
              HasSubstr("write main_tree_to_execute=\"Tour\""));
  for (const char* name : {"bt_number_texts/above.xml", "bt_number_texts/sum.xml"}) {
    const ProgramEnd end = check({"--dry-run", file("bt_number_texts/answers.txt"), file(name)});
    EXPECT_THAT(end.err, HasSubstr("texts")) << describe(end);
  }
}

}  // namespace
}  // namespace swiftlet::commands
