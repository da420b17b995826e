// Trajectories: exact, the same bytes each time, and refused with line and column if they are not valid.
#include "interfaces/files/tum.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "interfaces/files/stamp_units.hpp"
#include "support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Time;
using test_support::HasProblem;
using test_support::problemsOf;
using testing::HasSubstr;
using testing::IsEmpty;

common::StampedPose pose(std::int64_t ns, double x, double y, double z, const Eigen::Quaterniond& q) {
  return {Time::fromNanoseconds(ns), {q, {x, y, z}}};
}

TEST(Tum, WritesOneLinePerPose) {
  EXPECT_EQ(toTumLine(pose(1'305'031'102'160'407'000, 1.344379, -0.5, 0, {0.5, -0.5, 0.5, -0.5})),
            "1305031102.160407000 1.344379000 -0.500000000 0.000000000 -0.500000000 0.500000000 -0.500000000 "
            "0.500000000\n");
}

TEST(Tum, WritesNegativeZeroAsZero) {
  EXPECT_EQ(toTumLine(pose(0, -0.0, -1e-12, 0, Eigen::Quaterniond::Identity())),
            toTumLine(pose(0, 0, 0, 0, Eigen::Quaterniond::Identity())));
}

TEST(Tum, StampsBeforeZeroReadBack) {
  const auto back = parseTum(toTumLine(pose(-1'500'000'001, 0, 0, 0, Eigen::Quaterniond::Identity())), "t");
  ASSERT_EQ(back.size(), 1u);
  EXPECT_NEAR(back[0].stamp.seconds(), -1.500000001, 1e-9);
}

RC_GTEST_PROP(Tum, ReadsBackWhatItWrote, ()) {
  const auto ns = *rc::gen::inRange<std::int64_t>(0, 4'000'000'000'000'000'000);
  const auto draw = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) * 1e-5; };
  const Eigen::Quaterniond q = Eigen::Quaterniond(draw() + 11, draw(), draw(), draw()).normalized();
  const auto written = pose(ns, draw(), draw(), draw(), q);
  const auto back = parseTum(toTumLine(written), "t");
  RC_ASSERT(back.size() == 1u);
  RC_ASSERT(back[0].stamp == written.stamp);
  RC_ASSERT((back[0].pose.position_m - written.pose.position_m).norm() < 2e-9);
  RC_ASSERT(back[0].pose.rotation.angularDistance(q) < 1e-8);
}

TEST(Tum, SkipsCommentsAndBlankLinesAndTakesExponents) {
  const auto trajectory = parseTum("# a comment\n\n  1.5 +1 2e0 3 0 0 0 2\r\n2.000000000000e+00\t1 2 3 0 0 0 1", "t");
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp, Time::fromNanoseconds(1'500'000'000));
  EXPECT_EQ(trajectory[0].pose.position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_DOUBLE_EQ(trajectory[0].pose.rotation.norm(), 1.0);
  EXPECT_EQ(trajectory[1].stamp, Time::fromNanoseconds(2'000'000'000));
}

TEST(Tum, ReportsATruncatedLastLine) {
  EXPECT_THAT(problemsOf([] { parseTum("1 0 0 0 0 0 0 1\n2 0 0", "x.tum"); }),
              HasProblem("text.number-count", "x.tum:2:5: pose"));
  EXPECT_EQ(parseTum("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1", "x.tum").size(), 2u) << "only its newline is missing";
}

TEST(Tum, ReadsStampsInAnyOrderOnRequest) {
  const auto poses = parseTum("2 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n2 3 0 0 0 0 0 1\n", "t", StampOrder::kAny);
  ASSERT_EQ(poses.size(), 3u) << "as they stand in the file";
  EXPECT_EQ(poses[1].stamp, Time::fromSeconds(1));
  EXPECT_EQ(poses[2].pose.position_m.x(), 3);
}

TEST(Tum, ReadsCompressedFiles) {
  const auto file = test_support::dataSet("03-rgbd/tum-trajectories/freiburg1_xyz-groundtruth.txt.gz");
  if (!file) return;
  EXPECT_EQ(readTum(*file).size(), 3000u);
}

TEST(Tum, ReportsThePlaceOfMistakes) {
  const auto problem = [](const std::string& text) { return problemsOf([&] { parseTum(text, "x.tum"); }); };
  const std::string good = "1 0 0 0 0 0 0 1\n";
  EXPECT_THAT(problem(good + "2 0 0 0 0 0 1\n"), HasProblem("text.number-count", "x.tum:2:13: pose"));
  EXPECT_THAT(problem("# c\n2 0 zero 0 0 0 0 1\n"), HasProblem("text.not-finite", "x.tum:2:5: y"));
  EXPECT_THAT(problem("+2 0 +1.5 0 0 0 0 1\n"), IsEmpty());
  EXPECT_THAT(problem("2 0 +-1.5 0 0 0 0 1\n"), HasProblem("text.not-finite", "x.tum:1:5: y"));
  EXPECT_THAT(problem("2 0 0,25 0 0 0 0 1\n"), HasProblem("text.not-finite", "x.tum:1:5: y"));
  EXPECT_THAT(problem("1700000001,5 0 0 0 0 0 0 1\n"), HasProblem("text.not-a-time"));
  EXPECT_THAT(problem("2 0 0 nan 0 0 0 1\n"), HasProblem("text.not-finite", "x.tum:1:7: z"));
  EXPECT_THAT(problem("x 0 0 0 0 0 0 1\n"), HasProblem("text.not-a-time", "x.tum:1:1: t"));
  EXPECT_THAT(problem("1e300 0 0 0 0 0 0 1\n"), HasProblem("text.not-a-time"));
  EXPECT_THAT(problem("1 0 0 0 0 0 0 0\n"), HasProblem("tum.rotation-zero", "x.tum:1:9: qx qy qz qw"));
  EXPECT_THAT(problem("1 0 0 0 0 0 1e300 1e300\n"), HasProblem("tum.rotation-infinite"));
  EXPECT_THAT(problem(good + "2 0 -1e300 0 0 0 0 1\n"), HasProblem("text.too-far", "x.tum:2:5: y"));
  EXPECT_THAT(problem("1 1e8 -1e8 1e8 0 0 0 1\n"), IsEmpty());
  EXPECT_THAT(problem(good + good), HasProblem("tum.not-later", "x.tum:2:1: t"));
  EXPECT_THAT(problemsOf([] { readTum("/nowhere/x.tum"); }), HasProblem("file.not-opened", "/nowhere/x.tum"));
}

TEST(Tum, SaysWhichUnitStampsSince1970AreIn) {
  const auto problem = [](const std::string& stamp) {
    return problemsOf([&] { parseTum(stamp + " 0 0 0 0 0 0 1\n", "x.tum"); });
  };
  EXPECT_THAT(problem("1600000000123456789"), HasProblem("text.not-a-time", "x.tum:1:1: t"));
  EXPECT_THAT(problem("1.6e18"), HasProblem("text.not-a-time", "", "1e9"));
  EXPECT_THAT(problem("1600000000123456"), HasProblem("text.not-a-time", "", "1e6"));
  EXPECT_THAT(problem("1600000000123.5"), HasProblem("text.not-a-time", "", "1e3"));
  EXPECT_THAT(problem("86400000000000"), HasProblem("text.not-a-time", "", "1e9; by 1e6 or 1e3"));
  EXPECT_THAT(problem("1600000000.123456789"), IsEmpty());
}

TEST(StampUnits, AreSuspectedFromTheStepsOfASensor) {
  for (const double step_s : {0.0, 0.001, 0.1, 1.0, 5.0, -1.0}) EXPECT_EQ(stampStepNote(step_s), "") << step_s;
  EXPECT_EQ(stampStepNote(100.0),
            "the stamps are 100 s apart in the median: are they milliseconds? Then divide them by 1e3");
  EXPECT_THAT(stampStepNote(1e5), HasSubstr("are they microseconds? Then divide them by 1e6"));
  EXPECT_THAT(stampStepNote(1e8), HasSubstr("are they nanoseconds? Then divide them by 1e9"));
}

TEST(StampUnits, OfAFormatOfMicrosecondsAreSuspectedOnBothSides) {
  for (const double step_s : {0.0, 0.001, 0.1, 5.0, -1.0}) EXPECT_EQ(microsecondStepNote(step_s), "") << step_s;
  EXPECT_EQ(microsecondStepNote(98e-6),
            "the stamps are 98 apart in the median, where this format has microseconds: are "
            "they milliseconds? Then multiply them by 1e3");
  EXPECT_THAT(microsecondStepNote(98.0), HasSubstr("are they nanoseconds? Then divide them by 1e3"));
  EXPECT_THAT(microsecondStepNote(1e-6), HasSubstr("are they seconds? Then multiply them by 1e6"));
}

TEST(Tum, SaysThatCommasSeparateTheNumbers) {
  const auto problem = [](const std::string& text) { return problemsOf([&] { parseTum(text, "x.tum"); }); };
  EXPECT_THAT(problem("1.5,0,0,0,0,0,0,1\n"), HasProblem("text.number-count", "", "`tr ',' ' ' < FILE`"));
  EXPECT_THAT(problem("1305031102160407000,1,2,3,1,0,0,0\n"),
              HasProblem("text.number-count", "", "`evo_traj euroc FILE --save_as_tum`"));
}

TEST(Tum, LeavesOutPosesThatAreNotFinite) {
  const ScratchFolder folder;
  auto writer = TumWriter::create(folder / "t.tum");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write(pose(1, std::nan(""), 0, 0, Eigen::Quaterniond::Identity())));
  ASSERT_TRUE(writer->write(pose(2, 0, std::numeric_limits<double>::infinity(), 0, Eigen::Quaterniond::Identity())));
  ASSERT_TRUE(writer->write(pose(3, 0, 0, 0, Eigen::Quaterniond::Identity())));
  EXPECT_EQ(readTum(folder / "t.tum").size(), 1u);
}

TEST(Tum, ReadsTheFilesOfTheBenchmark) {
  const auto folder = test_support::dataSet("03-rgbd/tum-trajectories");
  if (!folder) return;
  const auto read = [&](const char* name) {
    return parseTum(outputOf("zcat " + (*folder / name).string()).value_or(""), name);
  };
  EXPECT_EQ(read("freiburg1_xyz-groundtruth.txt.gz").size(), 3000u);
  const auto estimate = read("freiburg1_xyz-rgbdslam.txt.gz");
  EXPECT_EQ(estimate.size(), 788u);
  EXPECT_EQ(estimate.front().stamp, Time::fromNanoseconds(1'305'031'102'160'407'000));
}

}  // namespace
}  // namespace swiftlet::interfaces
