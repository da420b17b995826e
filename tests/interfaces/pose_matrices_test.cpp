// Poses as matrices in the layouts of the data sets: the same poses from each, and refused with the place of a mistake.
#include "interfaces/files/pose_matrices.hpp"

#include <gmock/gmock.h>

#include "common/geometry.hpp"
#include "interfaces/files/numbered_frames.hpp"
#include "interfaces/files/trajectory_file.hpp"
#include "support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::HasProblem;
using test_support::problemsOf;

/// At the origin; then at (1, 2, 3), turned by 90 deg to the left.
constexpr const char* kFirst = "1 0 0 0 0 1 0 0 0 0 1 0";
constexpr const char* kSecond = "0 -1 0 1 1 0 0 2 0 0 1 3";
constexpr const char* kFirstBlock = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
constexpr const char* kSecondBlock = "0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n";

void expectBoth(const RecordedPoses& found, PoseOrder order, double first_s, double second_s) {
  EXPECT_EQ(found.order, order);
  ASSERT_EQ(found.poses.size(), 2u);
  EXPECT_EQ(found.poses[0].stamp, common::Time::fromSeconds(first_s));
  EXPECT_EQ(found.poses[1].stamp, common::Time::fromSeconds(second_s));
  EXPECT_EQ(found.poses[0].pose.position_m, Eigen::Vector3d::Zero());
  EXPECT_EQ(found.poses[1].pose.position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(common::yawOf(found.poses[1].pose.rotation), 90 * common::kRadPerDeg, 1e-12);
}

TEST(PoseMatrices, OfEveryLayoutAreTheSamePoses) {
  const std::string first = kFirst, second = kSecond, first_block = kFirstBlock, second_block = kSecondBlock;
  const auto read = [](const std::string& text) { return parsePoseMatrices(text, "x"); };
  expectBoth(read(first + "\n" + second), PoseOrder::kLines, 0, 1);
  expectBoth(read("# KITTI\n" + first + "\r\n\n" + second + "\n"), PoseOrder::kLines, 0, 1);
  expectBoth(read(first + " 0 0 0 1\n" + second + " 0 0 0 1\n"), PoseOrder::kLines, 0, 1);
  expectBoth(read("7 " + first + "\n12 " + second + "\n"), PoseOrder::kNumbers, 7, 12);
  expectBoth(read("7 " + first + " 0 0 0 1\n12 " + second + " 0 0 0 1\n"), PoseOrder::kNumbers, 7, 12);
  expectBoth(read(first_block + second_block), PoseOrder::kLines, 0, 1);
  expectBoth(read("3 3 4\n" + first_block + "8 8 9\n" + second_block), PoseOrder::kNumbers, 3, 8);
}

TEST(PoseMatrices, WithoutAFiniteNumberAreCountedAndLeftOut) {
  const std::string none = "-inf -inf -inf -inf\n", first = kFirstBlock, second = kSecondBlock;
  const RecordedPoses found = parsePoseMatrices(first + none + none + none + none + second, "x");
  EXPECT_EQ(found.without_pose, 1u);
  expectBoth(found, PoseOrder::kLines, 0, 2);
}

TEST(PoseMatrices, ReportThePlaceOfMistakes) {
  const auto problem = [](const std::string& text) { return problemsOf([&] { parsePoseMatrices(text, "x"); }); };
  const std::string good = std::string(kFirst) + "\n";
  EXPECT_THAT(problem(good + "1 0 0 0 0 1 0 0 0 0 1\n"), HasProblem("text.number-count", "x:2:21: pose"));
  EXPECT_THAT(problem(good + "1 0 0 0 0 1 0 zero 0 0 1 0\n"), HasProblem("text.not-a-number", "x:2:15: pose"));
  EXPECT_THAT(problem(good + "1 0 0 0 0 1 0 nan 0 0 1 0\n"), HasProblem("matrix.not-finite", "x:2:1: pose"));
  EXPECT_THAT(problem(good + "1 0 0 1e9 0 1 0 0 0 0 1 0\n"), HasProblem("text.too-far", "x:2:7: pose"));
  EXPECT_THAT(problem("2 0 0 0 0 2 0 0 0 0 2 0\n"), HasProblem("matrix.no-rotation", "x:1:1: pose"));
  EXPECT_THAT(problem("-1 0 0 0 0 1 0 0 0 0 1 0\n"), HasProblem("matrix.reflection"));
  EXPECT_THAT(problem("1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1\n"), HasProblem("matrix.last-row"));
  EXPECT_THAT(problem("1 0 0 0\n0 1 0 0\n0 0 1 0\n9 2 3 1\n"), HasProblem("matrix.last-row"));
  for (const double first_s : {0.0, 1.5e9}) {
    std::string stamped;
    for (int i = 0; i < 5; ++i) stamped += std::to_string(first_s + 0.1 * i) + " 1.5 0.1 0\n";
    EXPECT_THAT(problem(stamped), HasProblem("matrix.positions", "x:4: pose", "`t x y z qx qy qz qw`"));
  }
  EXPECT_THAT(problem("1.5 " + good), HasProblem("matrix.no-frame-number", "x:1:1: frame"));
  EXPECT_THAT(problem("1 0 0 0\n0 1 0 0\n0 0 1 0\n"), HasProblem("matrix.cut", "x:3: pose"));
  EXPECT_THAT(problem("1 0 0 0\n0 1 0 0 0\n"), HasProblem("text.number-count", "x:2:9: pose"));
  EXPECT_THAT(problem("0 1 20\n" + std::string(kFirstBlock)), HasProblem("matrix.other-frame", "x:1:3: frame"));
  EXPECT_THAT(problem("0 0 1\n" + std::string(kFirstBlock) + "1 0 0 0\n"),
              HasProblem("text.number-count", "x:6:7: frame"));
  EXPECT_THAT(problem("0 0 1\n"), HasProblem("matrix.cut"));
  EXPECT_THAT(problem("1 2\n"), HasProblem("poses.other-count", "x:1:3: pose"));
}

TEST(NumberedFrames, AreReadInTheOrderOfTheirNumbers) {
  const ScratchFolder scratch;
  const fs::path folder = scratch / "frames";
  fs::create_directories(folder);
  EXPECT_THAT(problemsOf([&] { readNumberedFrames(folder); }), HasProblem("frames.unknown-format"));
  put(folder / "camera-intrinsics.txt", "585 0 320\n");
  put(folder / "frame-000010.pose.txt", kSecondBlock);
  put(folder / "frame-000002.pose.txt", kFirstBlock);
  put(folder / "frame-000002.color.txt", "no pose");
  expectBoth(readNumberedFrames(folder), PoseOrder::kNumbers, 2, 10);
  put(folder / "11.txt", "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n");
  EXPECT_EQ(readRecordedPoses(folder).without_pose, 1u);
  put(folder / "12.txt", std::string(kFirstBlock) + kSecondBlock);
  EXPECT_THAT(problemsOf([&] { readNumberedFrames(folder); }), HasProblem("frames.several-poses", "12.txt"));
  put(folder / "12.txt", "1 0 0 0\n0 1 0 x\n");
  EXPECT_THAT(problemsOf([&] { readNumberedFrames(folder); }), HasProblem("text.not-a-number", "12.txt:2:7: pose"));
  put(folder / "12.txt", kFirstBlock);
  put(folder / "0012.txt", kFirstBlock);
  EXPECT_THAT(problemsOf([&] { readNumberedFrames(folder); }), HasProblem("frames.number-twice"));
}

TEST(RecordedPoses, OfAFolderAreThoseOfItsTrajectory) {
  const ScratchFolder scratch;
  const fs::path folder = scratch / "run";
  fs::create_directories(folder);
  put(folder / "frame-000002.pose.txt", kFirstBlock);
  put(folder / "groundtruth.txt", "# time\n1.5 1 2 3 0 0 0 1\n");
  EXPECT_EQ(readRecordedPoses(folder).order, PoseOrder::kStamps);
  put(folder / "groundtruth.txt", "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\nnan nan nan nan\n");
  EXPECT_THAT(problemsOf([&] { readRecordedPoses(folder); }), HasProblem("poses.none-finite"));
}

TEST(RecordedPoses, OfTheDataSetsAreRead) {
  const auto open3d = test_support::dataSet("03-rgbd/open3d-rgbd/open3d_RGBD_testdata.tar");
  const auto seven = test_support::dataSet("03-rgbd/7scenes-redkitchen-a/redkitchen_000-598_step2.tar");
  if (!open3d || !seven) return;
  const ScratchFolder scratch;
  const auto unpacked = [&](const fs::path& archive, const std::string& name) {
    const fs::path folder = scratch / name;
    fs::create_directories(folder);
    EXPECT_TRUE(outputOf("tar -C " + folder.string() + " -xf " + archive.string()));
    return folder;
  };
  const RecordedPoses trajectory = readRecordedPoses(unpacked(*open3d, "open3d"));
  EXPECT_EQ(trajectory.order, PoseOrder::kNumbers);
  EXPECT_EQ(trajectory.poses.size(), 5u);
  const RecordedPoses frames = readRecordedPoses(unpacked(*seven, "seven"));
  ASSERT_EQ(frames.poses.size(), 300u);
  EXPECT_EQ(frames.poses.back().stamp, common::Time::fromSeconds(598));
}

}  // namespace
}  // namespace swiftlet::interfaces
