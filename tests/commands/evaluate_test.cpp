// `swiftlet evaluate` as users meet it: figures, keys, exit codes, and messages about bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/datasets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::ContainsRegex;
using testing::HasSubstr;

class Evaluate : public test_support::Scratch {
 protected:
  /// 1 m ahead, a quarter turn to the left, 2 m ahead.
  std::string estimate() const {
    return write("est.tum",
                 "1 0 0 0 0 0 0 1\n"
                 "2 1 0 0 0 0 0.70710678 0.70710678\n"
                 "3 1 2 0 0 0 0.70710678 0.70710678\n");
  }
  /// The same poses, except that the last one is half a metre to the right: x is 1.5.
  std::string reference() const {
    return write("ref.txt",
                 "# ipc_timestamp scan_index x y theta\n1 0 0 0 0\n2 1 1 0 1.57079633\n3 2 1.5 2 1.57079633\n");
  }
  /// Off by nothing, and by (0.3, 0.4) and 0.1 rad.
  std::string relations() const {
    return write("log.relations", "1 2 1 0 0 0 0 1.57079633\n2.000000 3.000000 1.7 -0.4 0 0 0 0.1\n");
  }

  nlohmann::json figures(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "evaluate");
    arguments.emplace_back("--json");
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    return nlohmann::json::parse(end.out, nullptr, false);
  }
  void expectRefused(std::vector<std::string> arguments, const std::string& says) const {
    arguments.insert(arguments.begin(), "evaluate");
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, HasSubstr(says)) << describe(end);
    EXPECT_EQ(end.out, "");
  }
};

TEST_F(Evaluate, ReportsRelationErrors) {
  const nlohmann::json found = figures({"relations", estimate(), relations()});
  EXPECT_EQ(found.at("relations"), 2);
  EXPECT_EQ(found.at("missing"), 0);
  // 0 and 0.5 m, 0 and 0.1 rad = 5.729578 deg; of two values, the spread is half their difference.
  EXPECT_NEAR(found.at("translational_mean_m"), 0.25, 1e-6);
  EXPECT_NEAR(found.at("translational_std_m"), 0.25, 1e-6);
  EXPECT_NEAR(found.at("rotational_mean_deg"), 2.864789, 1e-5);
  EXPECT_NEAR(found.at("rotational_std_deg"), 2.864789, 1e-5);
  EXPECT_NEAR(found.at("translational_squared_mean_m2"), 0.125, 1e-6);
  EXPECT_NEAR(found.at("translational_squared_std_m2"), 0.125, 1e-6);
  EXPECT_NEAR(found.at("rotational_squared_mean_deg2"), 16.414032, 1e-4);
  EXPECT_NEAR(found.at("rotational_squared_std_deg2"), 16.414032, 1e-4);
  const ProgramEnd table = runSwiftlet({"evaluate", "relations", estimate(), relations()});
  EXPECT_THAT(table.out, ContainsRegex("2 relations"));
  EXPECT_THAT(table.out, ContainsRegex("translation, m +0.250000 +0.250000"));
}

TEST_F(Evaluate, CountsRelationsWithoutPosesAndFails) {
  const std::string more = write("more.relations", "1 2 1 0 0 0 0 1.57079633\n2.5 3 0 0 0 0 0 0\n");
  const ProgramEnd end = runSwiftlet({"evaluate", "relations", estimate(), more, "--json"});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_EQ(nlohmann::json::parse(end.out).at("missing"), 1);
  EXPECT_EQ(nlohmann::json::parse(end.out).at("relations"), 1);
  EXPECT_THAT(end.err, HasSubstr("1 of 2 relations are missing"));
  EXPECT_THAT(end.err, HasSubstr("2.500000 to 3.000000"));
  EXPECT_EQ(figures({"relations", estimate(), more, "--allow-missing"}).at("missing"), 1);
  expectRefused({"relations", estimate(), write("other.relations", "7 8 0 0 0 0 0 0\n")}, "7.000000 and 8.000000");
}

TEST_F(Evaluate, ReportsStampsThatGoBackOrRepeat) {
  const std::string stray = write("stray.tum",
                                  "2 1 0 0 0 0 0.70710678 0.70710678\n"
                                  "1 9 9 9 0 0 0 1\n"
                                  "3 1 2 0 0 0 0.70710678 0.70710678\n"
                                  "1 0 0 0 0 0 0 1\n");
  const nlohmann::json found = figures({"relations", stray, relations()});
  EXPECT_NEAR(found.at("translational_mean_m"), 0.25, 1e-6) << "the last pose at 1 s is taken";
  EXPECT_EQ(found.at("estimate_stamps_back"), 2);
  EXPECT_EQ(found.at("estimate_stamps_repeated"), 1);
  const ProgramEnd table = runSwiftlet({"evaluate", "relations", stray, relations()});
  EXPECT_THAT(table.out, HasSubstr("stray.tum: 2 stamps go back in time"));
  EXPECT_THAT(table.out, HasSubstr("stray.tum: 1 stamps occur again"));
}

TEST_F(Evaluate, ReportsTheAbsoluteError) {
  const nlohmann::json found = figures({"ate", estimate(), reference(), "--align", "none"});
  EXPECT_EQ(found.at("pairs"), 3);
  EXPECT_NEAR(found.at("ate_rmse_m"), std::sqrt(0.25 / 3), 1e-6);
  EXPECT_NEAR(found.at("ate_mean_m"), 0.5 / 3, 1e-6);
  EXPECT_NEAR(found.at("ate_median_m"), 0.0, 1e-6);
  EXPECT_NEAR(found.at("ate_std_m"), std::sqrt(0.25 / 3 - 0.25 / 9), 1e-6);
  EXPECT_NEAR(found.at("ate_max_m"), 0.5, 1e-6);
  EXPECT_NEAR(found.at("ate_rotational_rmse_deg"), 0.0, 1e-5);
  EXPECT_EQ(found.at("align"), "none");
  EXPECT_LT(figures({"ate", estimate(), reference(), "--align", "planar"}).at("ate_rmse_m"), found.at("ate_rmse_m"));
  EXPECT_GT(figures({"ate", estimate(), reference(), "--scale"}).at("scale"), 1.0);
}

TEST_F(Evaluate, ReportsTheRelativeError) {
  const nlohmann::json frames = figures({"rpe", estimate(), reference()});
  EXPECT_EQ(frames.at("stretches"), 2);
  EXPECT_NEAR(frames.at("rpe_translational_rmse_m"), std::sqrt(0.25 / 2), 1e-6);
  EXPECT_NEAR(frames.at("rpe_rotational_rmse_deg"), 0.0, 1e-5);
  const nlohmann::json seconds = figures({"rpe", estimate(), reference(), "--delta", "2", "--unit", "seconds"});
  EXPECT_EQ(seconds.at("stretches"), 1);
  EXPECT_NEAR(seconds.at("rpe_translational_max_m"), 0.5, 1e-6);
}

TEST_F(Evaluate, RefusesBadInput) {
  const std::string broken = write("broken.relations", "1 2 0 0 0 0 0\n"), none = write("none", "# nothing\n");
  expectRefused({"relations", estimate(), broken}, "broken.relations:1:13: relation: 7 numbers instead of 8");
  expectRefused({"relations", estimate(), none},
                "holds no relations, a line of them is `from to x y z roll pitch yaw`");
  expectRefused({"relations", none, relations()}, "holds no poses");
  expectRefused({"relations", path("nowhere.tum"), relations()}, "nowhere.tum");
  expectRefused({"ate", estimate(), write("odd.txt", "1 2 3.5\n")}, "odd.txt:1:5: pose: 3 numbers");
  expectRefused({"ate", estimate(), write("late.txt", "9 0 0 0 0\n")}, "1.000000 to 3.000000 against 9.000000");
  expectRefused({"ate", estimate(), write("one.txt", "1 0 0 0 0\n")}, "1 pairs do not determine the spatial alignment");
  expectRefused({"ate", estimate(), write("us.txt", "7e6 0 0 0 0\n8e6 1 0 0 0\n9e6 2 0 0 0\n")},
                "in the second file the stamps are 1e+06 s apart in the median: are they nanoseconds?");
  expectRefused({"ate", estimate(), write("ns.txt", "1600000000000000000 0 0 0 0\n")}, "nanoseconds since 1970");
  expectRefused({"ate", estimate(), reference(), "--align", "none", "--scale"}, "--scale: is fitted with");
  expectRefused({"ate", write("up.tum", "1 0 0 0 0 0 0 1\n2 0.1 0 5 0 0 0 1\n"),
                 write("down.tum", "1 0 0 0 0 0 0 1\n2 0.1 0 -5 0 0 0 1\n"), "--align", "planar", "--scale"},
                "no scale above zero fits, it moves against the reference");
  expectRefused({"ate", estimate(), reference(), "--align", "sideways"}, "sideways");
  expectRefused({"ate", estimate(), reference(), "--max-difference", "-1"}, "-1");
  expectRefused({"rpe", estimate(), reference(), "--delta", "0"}, "`0`");
  expectRefused({"rpe", estimate(), reference(), "--delta", "1.5"},
                "--delta: 1.5 is no number of frames, give a whole one");
  expectRefused({"rpe", estimate(), reference(), "--delta", "9"}, "no stretch of 9 frames");
  expectRefused({"rpe", estimate(), reference(), "--unit", "miles"}, "miles");
  expectRefused({"rpe", estimate()}, "reference");
  expectRefused({}, "metric");
  expectRefused({"swim"}, "swim");
}

TEST_F(Evaluate, HelpShowsAnExampleOfEach) {
  for (const std::string metric : {"relations", "ate", "rpe"}) {
    const ProgramEnd end = runSwiftlet({"evaluate", metric, "--help"});
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    EXPECT_THAT(end.out, HasSubstr("Example: swiftlet evaluate " + metric));
  }
}

// 13 of the scans are not among the reference poses.
TEST_F(Evaluate, TheBenchmarksFilesGiveTheKnownFigures) {
  const auto folder = test_support::dataSet("01-laser-slam/fr079");
  if (!folder) return;
  const nlohmann::json found = figures(
      {"relations", "--allow-missing", *folder / "fr079.reference_poses.txt.gz", *folder / "fr079.relations.gz"});
  EXPECT_EQ(found.at("relations"), 1672);
  EXPECT_EQ(found.at("missing"), 13);
  EXPECT_NEAR(found.at("translational_mean_m"), 0.058202756, 1e-8);
  EXPECT_NEAR(found.at("rotational_mean_deg"), 0.703298189, 1e-7);
}

}  // namespace
}  // namespace swiftlet::commands
