// Relations and reference poses: read exactly, and refused with line and column if they are not valid.
#include "interfaces/files/relations.hpp"

#include <gmock/gmock.h>

#include "interfaces/files/trajectory_file.hpp"
#include "support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Time;
using test_support::HasProblem;
using test_support::problemsOf;

const std::string kRelation = "976052905.167303 976052911.885496 -0.056990 -0.128430 0.5 0.1 -0.2 -1.682210\n";

TEST(Relations, AreReadWithMicroseconds) {
  const auto relations = parseRelations("# a comment\n\n" + kRelation + "1 2 0 0 0 0 0 0", "r");
  ASSERT_EQ(relations.size(), 2u);
  EXPECT_EQ(relations[0].from, Time::fromNanoseconds(976'052'905'167'303'000));
  EXPECT_EQ(relations[0].to, Time::fromNanoseconds(976'052'911'885'496'000));
  EXPECT_EQ(relations[0].T_from_to.position_m, Eigen::Vector3d(-0.056990, -0.128430, 0.5));
  const common::RollPitchYaw angles = common::rollPitchYaw(relations[0].T_from_to.rotation);
  EXPECT_NEAR(angles.roll_rad, 0.1, 1e-12);
  EXPECT_NEAR(angles.pitch_rad, -0.2, 1e-12);
  EXPECT_NEAR(angles.yaw_rad, -1.682210, 1e-12);
  EXPECT_TRUE(parseRelations("", "r").empty());
}

TEST(Relations, ReportThePlaceOfMistakes) {
  const auto problem = [](const std::string& text) { return problemsOf([&] { parseRelations(text, "x.relations"); }); };
  EXPECT_THAT(problem(kRelation + "1 2 0 0 0\n"),
              HasProblem("text.number-count", "x.relations:2:9: relation", "`t1 t2 x y z roll pitch yaw`"));
  EXPECT_THAT(problem("1 2 0 0 0 0 0 0 9\n"), HasProblem("text.number-count", "x.relations:1:17: relation"));
  EXPECT_THAT(problem("1 later 0 0 0 0 0 0\n"), HasProblem("text.not-a-time", "x.relations:1:3: t2"));
  EXPECT_THAT(problem("1 1600000000000000000 0 0 0 0 0 0\n"),
              HasProblem("text.not-a-time", "x.relations:1:3: t2", "1e9"));
  EXPECT_THAT(problem(" 1 2 0 inf 0 0 0 0\n"), HasProblem("text.not-finite", "x.relations:1:8: y"));
  EXPECT_THAT(problem("1 2 0 0 1e300 0 0 0\n"), HasProblem("text.too-far", "x.relations:1:9: z"));
  EXPECT_THAT(problem("1 2 0 0 0 0 0 0x1\n"), HasProblem("text.not-finite", "x.relations:1:15: yaw"));
  EXPECT_THAT(problem(kRelation + "1 2 0"), HasProblem("text.number-count", "x.relations:2:5: relation"));
}

TEST(Relations, NameAMissingFile) {
  EXPECT_THAT(problemsOf([] { readRelations("none.relations.gz"); }),
              HasProblem("file.not-opened", "none.relations.gz"));
}

TEST(Relations, OfTheBenchmarkAreRead) {
  const auto intel = test_support::dataSet("01-laser-slam/intel/intel.relations.gz");
  const auto fr079 = test_support::dataSet("01-laser-slam/fr079/fr079.relations.gz");
  if (!intel || !fr079) return;
  EXPECT_EQ(readRelations(*intel).size(), 2984u);
  EXPECT_EQ(readRelations(*fr079).size(), 1685u);
}

TEST(Poses, FormatIsRecognizedByTheNumberOfWords) {
  const ScratchFolder folder;
  put(folder / "tum", "# t x y z qx qy qz qw\n2.5 1 2 3 0 0 0 1\n1.5 4 5 6 0 0 0 1\n");
  const auto tum = readPoses(folder / "tum");
  ASSERT_EQ(tum.size(), 2u) << "stamps may go back here";
  EXPECT_EQ(tum[1].stamp, Time::fromNanoseconds(1'500'000'000));
  EXPECT_EQ(tum[1].pose.position_m, Eigen::Vector3d(4, 5, 6));

  put(folder / "reference", "# ipc_timestamp scan_index x y theta\n976052890.244111 169 0.5 -0.25 -0.354665\n");
  const auto reference = readPoses(folder / "reference");
  ASSERT_EQ(reference.size(), 1u);
  EXPECT_EQ(reference[0].stamp, Time::fromNanoseconds(976'052'890'244'111'000));
  EXPECT_EQ(reference[0].pose.position_m, Eigen::Vector3d(0.5, -0.25, 0));
  EXPECT_NEAR(common::yawOf(reference[0].pose.rotation), -0.354665, 1e-12);
}

TEST(Poses, InAnUnknownFormatAreRefused) {
  const ScratchFolder folder;
  const auto problem = [&](const std::string& text) {
    put(folder / "x", text);
    return problemsOf([&] { readPoses(folder / "x"); });
  };
  EXPECT_THAT(problem("# t x y z yaw pitch\n1 2 3 4 5 6\n"),
              HasProblem("poses.other-count", "x:2:11: pose", "`t x y z qx qy qz qw`"));
  EXPECT_THAT(problem("1 0 0 0 0 1 0 0 0 0 1 0\n"), HasProblem("poses.no-stamps", "x", "`t x y z qx qy qz qw`"));
  EXPECT_THAT(problem("# only a comment\n"), HasProblem("poses.none"));
  EXPECT_THAT(problem(""), HasProblem("poses.none"));
  EXPECT_THAT(problem("1 0 0 0 x\n"), HasProblem("text.not-finite", "x:1:9: theta"));
  EXPECT_THAT(problem("1 0 1e300 0 0\n"), HasProblem("text.too-far", "x:1:5: x"));
  EXPECT_THAT(problem("1 0 0 0 0\n2 0 0 0 0 0 0 1\n"), HasProblem("text.number-count", "x:2:15: pose"));
}

}  // namespace
}  // namespace swiftlet::interfaces
