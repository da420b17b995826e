// Configuration as users meet it: values over defaults, and mistakes explained.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/config.hpp"
#include "common/config_check.hpp"
#include "common/config_reference.hpp"
#include "common/error.hpp"
#include "common/validation.hpp"
#include "common/vehicle_config.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::common {
namespace {

using config::YamlPrinter;
using test_support::HasProblem;
using test_support::kAnyName;
using test_support::ProblemIs;
using testing::ElementsAre;
using testing::IsEmpty;

/// One field of each kind.
struct Leaf {
  double share = 0.5;
  int count = 3;
  double gain = 1.0;
  std::vector<double> corners_m{1.0, 2.0};
  std::vector<std::string> names{"a"};
  int color = 1;
  bool on = true;

  void describe(config::Fields& fields) {
    fields("share", share, {0, 1}, "A share.");
    fields("count", count, {1, 9}, "A count.");
    fields("gain", gain, config::kPositive, "A gain.");
    fields("corners_m", corners_m, {-10, 10}, "Some corners.");
    fields("names", names, "Some names.");
    fields.choice("color", color, {"red", "blue"}, "A colour.");
    fields("on", on, "A switch.");
  }
};

struct Branch {
  double near_m = 1.0;
  double far_m = 2.0;
  Leaf leaf;
  std::vector<Leaf> leaves;

  void describe(config::Fields& fields) {
    fields("near_m", near_m, {0, 100}, "The near end.");
    fields("far_m", far_m, config::atLeast(0.5), "The far end.");
    fields.section("leaf", leaf, "One leaf.");
    fields.list("leaves", leaves, "Many leaves.");
  }
  std::vector<common::Problem> validate() const {
    return Validation()
        .atMost("near_m", near_m, "far_m", far_m)
        .require(leaf.share < 0.9 || leaf.count > 1, "leaf.share", {"leaf.too-much", "is too much for one"})
        .problems();
  }
};

/// A number that has no default.
struct Required {
  double size_m = 0.0;
  void describe(config::Fields& fields) { fields("size_m", size_m, {0.1, 1}, "A size."); }
};

template <typename Config>
std::vector<Problem> problemsOf(const std::string& yaml) {
  Config config;
  return test_support::problemsOf([&] { config::YamlReader::fromText(yaml, "test.yaml").read(config); });
}

TEST(Config, FileValuesReplaceDefaults) {
  LaserConfig laser;
  config::YamlReader::fromText("rate_hz: 10\nsweep_s: 0.05\nmount: {z_m: 0.1}\n", "t").read(laser);
  EXPECT_EQ(laser.rate_hz, 10);
  EXPECT_EQ(laser.mount.z_m, 0.1);
  EXPECT_EQ(laser.beams, 1081);
}

TEST(Config, UnknownKeyIsReportedWithItsPlaceAndASuggestion) {
  EXPECT_THAT(problemsOf<VehicleConfig>("mass_kg: 1.2\nhull_diametre_m: 0.5\n"),
              ElementsAre(ProblemIs("config.unknown-key", "test.yaml:2:1", "`hull_diameter_m`")));
}

TEST(Config, ADuplicateKeyIsReported) {
  EXPECT_THAT(problemsOf<VehicleConfig>("mass_kg: 1.2\nhull_diameter_m: 0.5\nmass_kg: 1.6\n"),
              ElementsAre(ProblemIs("config.key-twice", "test.yaml:3:1", "in line 1 too")));
}

TEST(Config, WrongTypeAndRangeAreReportedTogether) {
  const auto problems = problemsOf<LaserConfig>("beams: many\nrange_max_m: -3\nmount: {roll: 3}\n");
  EXPECT_THAT(problems, HasProblem("config.other-type", "test.yaml:1:8: beams", "a whole number"));
  EXPECT_THAT(problems, HasProblem("config.not-within", "test.yaml:2:14: range_max_m", "0.1 and 1000"));
  EXPECT_THAT(problems, HasProblem("config.unknown-key", "test.yaml:3:9: mount", "`roll_deg`"));
}

TEST(Config, NumbersAtTheEndsOfTheirRangeAreAccepted) {
  EXPECT_THAT(problemsOf<LaserConfig>("beams: -2147483648\nmirror_first_beam: 1\n"),
              HasProblem(kAnyName, "beams", "-2147483648"));
  EXPECT_THAT(problemsOf<VehicleConfig>("mass_kg: 1e400\n"), HasProblem("config.other-type", "mass_kg", "`1e400`"));
  EXPECT_THAT(problemsOf<Leaf>("share: 0\ncount: 9\n"), IsEmpty()) << "both ends are within";
  EXPECT_THAT(problemsOf<Leaf>("gain: 0\n"), ElementsAre(ProblemIs("config.not-positive", "test.yaml:1:7: gain")));
}

TEST(Config, NanIsNeverWithinBounds) {
  EXPECT_THAT(problemsOf<Leaf>("share: .nan\n"), ElementsAre(ProblemIs("config.not-within", "test.yaml:1:8: share")));
  EXPECT_THAT(problemsOf<Leaf>("gain: .nan\n"), ElementsAre(ProblemIs("config.not-positive", "test.yaml:1:7: gain")));
  EXPECT_THAT(problemsOf<Branch>("far_m: .nan\n"),
              ElementsAre(ProblemIs("config.out-of-bounds", "test.yaml:1:8: far_m", "at least 0.5")));
  EXPECT_THAT(problemsOf<LaserConfig>("mount: {roll_deg: .nan}\n"), HasProblem("config.not-within", "mount.roll_deg"));
}

TEST(Config, OutOfBoundsIsReportedWithItsPlaceInSectionsAndLists) {
  EXPECT_THAT(problemsOf<Branch>("leaf:\n  count: 10\n"),
              ElementsAre(ProblemIs("config.not-within", "test.yaml:2:10: leaf.count")));
  EXPECT_THAT(problemsOf<Branch>("leaves:\n  - count: 2\n  - {count: 0}\n"),
              ElementsAre(ProblemIs("config.not-within", "test.yaml:3:13: leaves[1].count")));
  EXPECT_THAT(problemsOf<Leaf>("corners_m: [1, -2,\n  30, .nan]\n"),
              ElementsAre(ProblemIs("config.not-within", "test.yaml:2:3: corners_m[2]", "30 is not within -10 and 10"),
                          ProblemIs("config.not-within", "test.yaml:2:7: corners_m[3]", "nan")));
}

/// A file that is read over another gives a list whole: its items keep nothing of those in their place.
TEST(Config, AListReplacesTheOneBefore) {
  Branch branch;
  branch.leaves.resize(3);
  branch.leaves[0].count = 7;
  branch.leaves[0].on = false;
  config::YamlReader::fromText("leaves:\n  - {share: 0.25}\n", "test.yaml").read(branch);
  ASSERT_EQ(branch.leaves.size(), 1u);
  EXPECT_EQ(branch.leaves[0].share, 0.25);
  EXPECT_EQ(branch.leaves[0].count, Leaf().count);
  EXPECT_EQ(branch.leaves[0].on, Leaf().on);
  branch.leaves[0].count = 5;
  config::YamlReader::fromText("near_m: 0.5\n", "test.yaml").read(branch);
  ASSERT_EQ(branch.leaves.size(), 1u) << "a file without it leaves it as it is";
  EXPECT_EQ(branch.leaves[0].count, 5);
}

TEST(Config, AViolatedRelationIsReportedAtTheFieldItNames) {
  EXPECT_THAT(problemsOf<Branch>("near_m: 5\nfar_m: 4\n"),
              ElementsAre(ProblemIs("config.above-other", "test.yaml:1:9: near_m")));
  EXPECT_THAT(problemsOf<Branch>("near_m: 1\nleaf: {count: 1, share: 0.95}\n"),
              ElementsAre(ProblemIs("leaf.too-much", "test.yaml:2:25: leaf.share")));
  EXPECT_THAT(problemsOf<Branch>("near_m: 5\n"), ElementsAre(ProblemIs("config.above-other", "test.yaml:1:9: near_m")));
}

TEST(Config, AValueOutOfBoundsIsNotComparedWithOthers) {
  EXPECT_THAT(problemsOf<Branch>("far_m: -1\n"),
              ElementsAre(ProblemIs("config.out-of-bounds", "test.yaml:1:8: far_m")));
  EXPECT_THAT(problemsOf<Branch>("near_m: many\nfar_m: 0.6\n"),
              ElementsAre(ProblemIs("config.other-type", "test.yaml:1:9: near_m")))
      << "nor is the default that it keeps";
}

TEST(Config, ANumberWithoutADefaultMustBeGiven) {
  EXPECT_THAT(problemsOf<Required>("{}\n"), ElementsAre(ProblemIs("config.missing", "test.yaml:1:1: size_m")));
  EXPECT_THAT(problemsOf<Required>("size_m: 0.2\n"), IsEmpty());
}

TEST(Config, InvalidYamlAndAMissingFileAreReported) {
  EXPECT_THAT(problemsOf<LaserConfig>("a: [1, 2"), HasProblem("yaml.not-closed", "test.yaml:1:4"));
  EXPECT_THROW(config::YamlReader::fromFile("/nowhere/x.yaml"), InputError);
  EXPECT_THAT(problemsOf<LaserConfig>("- 1\n- 2\n"), HasProblem("config.no-keys", "test.yaml:1:1", "a list"));
}

TEST(Config, AConfigMadeInCodeIsCheckedToo) {
  EXPECT_THAT(config::problemsOf(Branch()), IsEmpty());
  Branch branch;
  branch.near_m = std::nan("");
  branch.leaf.count = 0;
  branch.leaf.color = 2;
  branch.leaves.resize(2);
  branch.leaves[1].corners_m = {0.0, std::numeric_limits<double>::infinity()};
  EXPECT_THAT(
      config::problemsOf(branch),
      ElementsAre(ProblemIs("config.not-within", "near_m"), ProblemIs("config.not-within", "leaf.count"),
                  ProblemIs("config.no-such-word", "leaf.color"),
                  ProblemIs("config.not-within", "leaves[1].corners_m[1]"), ProblemIs("config.above-other", "near_m")));
}

TEST(Config, CommentsContainDescriptionAndBounds) {
  EXPECT_EQ(YamlPrinter(YamlPrinter::Comments::kYes).print(Branch()),
            "near_m: 1  # The near end. From 0 to 100.\n"
            "far_m: 2  # The far end. At least 0.5.\n"
            "leaf:  # One leaf.\n"
            "  share: 0.5  # A share. From 0 to 1.\n"
            "  count: 3  # A count. From 1 to 9.\n"
            "  gain: 1  # A gain. Above 0.\n"
            "  corners_m: [1, 2]  # Some corners. From -10 to 10.\n"
            "  names: [\"a\"]  # Some names.\n"
            "  color: blue  # A colour. One of: red, blue.\n"
            "  on: true  # A switch.\n"
            "leaves: []  # Many leaves.\n");
}

TEST(Config, PrintedConfigReadsBack) {
  LaserConfig laser;
  laser.rate_hz = 12.5;
  laser.name = "it's: \"odd\"";
  laser.mount.yaw_deg = -90;
  LaserConfig back;
  config::YamlReader::fromText(YamlPrinter(YamlPrinter::Comments::kYes).print(laser), "printed").read(back);
  EXPECT_EQ(back.rate_hz, 12.5);
  EXPECT_EQ(back.name, laser.name);
  EXPECT_EQ(back.mount.yaw_deg, -90);
}

TEST(Config, EveryKindOfFieldReadsBack) {
  Branch branch;
  branch.far_m = std::numeric_limits<double>::infinity();
  branch.leaf.corners_m = {-0.1, 1e-7};
  branch.leaf.names = {"", "# no comment", "two\nlines"};
  branch.leaf.color = 0;
  branch.leaves.resize(2);
  branch.leaves[1].on = false;
  for (const auto comments : {YamlPrinter::Comments::kNo, YamlPrinter::Comments::kYes}) {
    const std::string printed = YamlPrinter(comments).print(branch);
    Branch back;
    config::YamlReader::fromText(printed, "printed").read(back);
    EXPECT_EQ(YamlPrinter(comments).print(back), printed);
    EXPECT_EQ(back.leaf.corners_m, branch.leaf.corners_m);
    EXPECT_EQ(back.leaf.names, branch.leaf.names);
  }
}

TEST(Config, TheReferenceHasARowForEachSettingAndATableForEachSection) {
  EXPECT_EQ(config::ReferencePrinter().print("A branch", "What it is for.", Branch()),
            "## A branch\n"
            "\n"
            "What it is for.\n"
            "\n"
            "| setting | default | bounds | |\n"
            "| --- | --- | --- | --- |\n"
            "| `near_m` | `1` | 0 to 100 | The near end. |\n"
            "| `far_m` | `2` | at least 0.5 | The far end. |\n"
            "\n"
            "### `leaf`\n"
            "\n"
            "One leaf.\n"
            "\n"
            "| setting | default | bounds | |\n"
            "| --- | --- | --- | --- |\n"
            "| `share` | `0.5` | 0 to 1 | A share. |\n"
            "| `count` | `3` | 1 to 9 | A count. |\n"
            "| `gain` | `1` | above 0 | A gain. |\n"
            "| `corners_m` | `[1, 2]` | list, each -10 to 10 | Some corners. |\n"
            "| `names` | `[\"a\"]` | list of texts | Some names. |\n"
            "| `color` | `blue` | red, blue | A colour. |\n"
            "| `on` | `true` | true, false | A switch. |\n"
            "\n"
            "### `leaves[]`\n"
            "\n"
            "Many leaves.\n"
            "\n"
            "| setting | default | bounds | |\n"
            "| --- | --- | --- | --- |\n"
            "| `share` | `0.5` | 0 to 1 | A share. |\n"
            "| `count` | `3` | 1 to 9 | A count. |\n"
            "| `gain` | `1` | above 0 | A gain. |\n"
            "| `corners_m` | `[1, 2]` | list, each -10 to 10 | Some corners. |\n"
            "| `names` | `[\"a\"]` | list of texts | Some names. |\n"
            "| `color` | `blue` | red, blue | A colour. |\n"
            "| `on` | `true` | true, false | A switch. |\n");
}

}  // namespace
}  // namespace swiftlet::common
