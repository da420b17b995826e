// Pose graphs of g2o files: read exactly, written so that they read back, and refused with line and column.
#include "interfaces/files/g2o.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "support.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using test_support::HasProblem;
using test_support::problemsOf;
using testing::ElementsAre;
using testing::IsEmpty;

G2oFile parse(const std::string& text) { return readG2o(LineReader::fromBytes(text, "x.g2o")); }
std::vector<common::Problem> problem(const std::string& text) {
  return problemsOf([&] { parse(text); });
}

const std::string kPlane = "VERTEX_SE2 10 1 2 0.5\nVERTEX_SE2 7 0 0 0\n";
const std::string kPlaneEdge = "EDGE_SE2 7 10 1 2 0.5 4 1 0 4 0 9\n";
const std::string kUnit6 = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
const std::string kSpace = "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 2 3 0 0 0 -2\n";
const std::string kSpaceEdge = "EDGE_SE3:QUAT 0 1 1 2 3 0 0 1 1" + kUnit6;

TEST(G2o, ReadsPlanarElements) {
  const G2oFile file = parse("# a comment\n" + kPlaneEdge + "\n  " + kPlane + "FIX 7 10 # both\r\n");
  const auto& graph = std::get<G2oGraph2D>(file.graph);
  EXPECT_THAT(graph.ids, ElementsAre(10, 7));
  EXPECT_THAT(graph.fixed, ElementsAre(0, 1));
  EXPECT_EQ(graph.poses[0].y_m, 2.0);
  ASSERT_EQ(graph.edges.size(), 1u);
  EXPECT_EQ(graph.edges[0].from, 1);
  EXPECT_EQ(graph.edges[0].to, 0);
  EXPECT_EQ(graph.edges[0].T_from_to.yaw_rad, 0.5);
  Eigen::Matrix3d information;
  information << 4, 1, 0, 1, 4, 0, 0, 0, 9;
  EXPECT_EQ(graph.edges[0].information, information);
  EXPECT_THAT(file.warnings, IsEmpty());
}

TEST(G2o, ReadsSpatialElementsWithUnitQuaternions) {
  const auto graph = std::get<G2oGraph3D>(parse(kSpace + kSpaceEdge).graph);
  EXPECT_EQ(graph.poses[1].position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_DOUBLE_EQ(graph.poses[1].rotation.w(), -1.0);
  EXPECT_DOUBLE_EQ(graph.edges[0].T_from_to.rotation.z(), std::sqrt(0.5));
  EXPECT_TRUE(graph.edges[0].information.isIdentity());
}

TEST(G2o, AFileMayHaveOnlyEdges) {
  const auto graph =
      std::get<G2oGraph2D>(parse("EDGE_SE2 9 4 1 0 0 1 0 0 1 0 1\nEDGE_SE2 4 6 1 0 0 1 0 0 1 0 1\nFIX 6\n").graph);
  EXPECT_THAT(graph.ids, ElementsAre(4, 6, 9));
  EXPECT_THAT(graph.poses, IsEmpty());
  EXPECT_THAT(graph.fixed, ElementsAre(1));
  EXPECT_EQ(graph.edges[0].from, 2);
}

TEST(G2o, ReportsEachUnusedElementTypeOnce) {
  const G2oFile file = parse(kPlane + "VERTEX_XY 3 0 0\nVERTEX_XY 4 0 0\n" + kPlaneEdge + "EDGE_SE22 what ever\n");
  EXPECT_THAT(file.warnings,
              ElementsAre("x.g2o:6: EDGE_SE22: unknown tag, 1 line is left out, did you mean `EDGE_SE2`?",
                          "x.g2o:3: VERTEX_XY: not used, 2 lines are left out"));
}

TEST(G2o, AnotherWayToWriteAMotionIsNoSlip) {
  const G2oFile file = parse(kPlane + kPlaneEdge + "EDGE_SE3:EXPMAP 1 2\nEDGE_SE3:EULER 1 2\nEDGE_SE3:QAUT 1 2\n");
  EXPECT_THAT(file.warnings,
              testing::UnorderedElementsAre(testing::EndsWith("EDGE_SE3:EXPMAP: not used, 1 line is left out"),
                                            testing::EndsWith("EDGE_SE3:EULER: unknown tag, 1 line is left out"),
                                            testing::EndsWith("did you mean `EDGE_SE3:QUAT`?")));
}

TEST(G2o, ReportsThePlaceOfMistakes) {
  EXPECT_THAT(problem("VERTEX_SE2 1 0 0\n"), HasProblem("text.number-count", "x.g2o:1:16: VERTEX_SE2"));
  EXPECT_THAT(problem(kPlane + "VERTEX_SE2 x 0 0 0\n"), HasProblem("g2o.not-an-id", "x.g2o:3:12: VERTEX_SE2"));
  EXPECT_THAT(problem("VERTEX_SE2 -1 0 0 0\n"), HasProblem("g2o.not-an-id"));
  EXPECT_THAT(problem("VERTEX_SE2 1 0 nan 0\n"), HasProblem("text.not-finite", "x.g2o:1:16: VERTEX_SE2: y"));
  EXPECT_THAT(problem("VERTEX_SE2 1 0 0,5 0\n"), HasProblem("text.not-finite"));
  EXPECT_THAT(problem("VERTEX_SE2 1 0 0 inf\n"), HasProblem("text.not-finite", "yaw"));
  EXPECT_THAT(problem("VERTEX_SE2 1 0 -1e300 0\n"), HasProblem("text.too-far", "x.g2o:1:16: VERTEX_SE2: y"));
  EXPECT_THAT(problem("EDGE_SE3:QUAT 0 1 1 2 1e9 0 0 1 1" + kUnit6), HasProblem("text.too-far", "z"));
  EXPECT_THAT(problem(kPlane + "VERTEX_SE2 7 1 1 1\n"), HasProblem("g2o.vertex-twice", "x.g2o:3:12: VERTEX_SE2"));
  EXPECT_THAT(problem(kPlane + "EDGE_SE2 7 11 0 0 0 1 0 0 1 0 1\n"), HasProblem("g2o.no-vertex", "x.g2o:3:10: edge"));
  EXPECT_THAT(problem(kPlane + "EDGE_SE2 7 7 0 0 0 1 0 0 1 0 1\n"), HasProblem("g2o.edge-to-itself"));
  EXPECT_THAT(problem(kPlane + "EDGE_SE2 7 10 0 0 0 1 2 0 1 0 1\n"),
              HasProblem("g2o.indefinite", "x.g2o:3:21: EDGE_SE2"));
  EXPECT_THAT(problem(kPlane + "EDGE_SE2 7 10 0 0 0 1 0 0 1 0 0\n"), HasProblem("g2o.indefinite"));
  EXPECT_THAT(problem(kPlane + kPlaneEdge + "FIX 8\n"), HasProblem("g2o.no-vertex", "x.g2o:4:5: FIX"));
  EXPECT_THAT(problem(kPlane + kPlaneEdge + "FIX\n"), HasProblem("g2o.no-fixed", "x.g2o:4:1: FIX"));
  EXPECT_THAT(problem(kPlane + kSpace), HasProblem("g2o.mixed", "x.g2o:3:1: VERTEX_SE3:QUAT"));
  EXPECT_THAT(problem(kSpaceEdge + kPlaneEdge), HasProblem("g2o.mixed", "x.g2o:2:1: EDGE_SE2"));
  EXPECT_THAT(problem("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n"),
              HasProblem("g2o.no-rotation", "x.g2o:1:25: VERTEX_SE3:QUAT"));
}

// TORO's order of the information, and the frame it belongs to (its treeoptimizer2).
TEST(G2o, ReadsTheElementsOfToroInThePlane) {
  const double quarter = 1.5707963267948966;
  for (const std::string digit : {"2", ""}) {
    const auto graph = std::get<G2oGraph2D>(parse("VERTEX" + digit + " 0 1 2 0.5\nVERTEX" + digit + " 1 2 2 0\nEDGE" +
                                                  digit + " 0 1 1 0 1.5707963267948966 50 2 70 100 3 4\n")
                                                .graph);
    EXPECT_THAT(graph.ids, ElementsAre(0, 1));
    EXPECT_EQ(graph.poses[0].yaw_rad, 0.5);
    EXPECT_EQ(graph.edges[0].T_from_to.yaw_rad, quarter);
    // Seen from where the edge ends, x points along the start's y and y against its x.
    Eigen::Matrix3d information;
    information << 70, -2, 4, -2, 50, -3, 4, -3, 100;
    EXPECT_TRUE(graph.edges[0].information.isApprox(information, 1e-12)) << graph.edges[0].information;
  }
}

TEST(G2o, ReadsTheElementsOfToroInSpace) {
  const auto graph = std::get<G2oGraph3D>(
      parse("VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 1 2 3 0.1 -0.2 1.5\nEDGE3 0 1 1 2 3 0.1 -0.2 1.5" + kUnit6).graph);
  const common::RollPitchYaw angles = common::rollPitchYaw(graph.edges[0].T_from_to.rotation);
  EXPECT_NEAR(angles.roll_rad, 0.1, 1e-12);
  EXPECT_NEAR(angles.pitch_rad, -0.2, 1e-12);
  EXPECT_NEAR(angles.yaw_rad, 1.5, 1e-12);
  EXPECT_EQ(graph.poses[1].position_m, Eigen::Vector3d(1, 2, 3));
  // The error of g2o is half the angle, so its square weighs four times.
  Eigen::VectorXd diagonal(6);
  diagonal << 1, 1, 1, 4, 4, 4;
  EXPECT_EQ(graph.edges[0].information, (Eigen::Matrix<double, 6, 6>(diagonal.asDiagonal())));
}

TEST(G2o, SaysThatTheInformationIsMissingAndHowItIsWritten) {
  EXPECT_THAT(
      problem("EDGE_SE3:QUAT 0 1 1 2 3 0 0 0 1\n"),
      HasProblem("g2o.no-information", "x.g2o:1:31: EDGE_SE3:QUAT", "1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1"));
  EXPECT_THAT(problem("EDGE_SE2 0 1 1 2 3 4 5 6\n"), HasProblem("g2o.information-count", "EDGE_SE2"));
  EXPECT_THAT(problem("EDGE2 0 1 1 2 3\n"), HasProblem("g2o.no-information", "EDGE2"));
  EXPECT_THAT(problem("EDGE2 0 1 1 2 3\n"), HasProblem("g2o.no-information", "EDGE2", "1 0 1 1 0 0"));
  const auto graph = std::get<G2oGraph2D>(parse("EDGE2 0 1 1 2 3 1 0 1 1 0 0\n").graph);
  EXPECT_TRUE(graph.edges[0].information.isIdentity(1e-12)) << "the hint, done literally";
  EXPECT_THAT(problem("EDGE_SE2 0 1 1\n"), HasProblem("text.number-count"));
}

TEST(G2o, SaysWhatWasLeftOutWhereNothingRemains) {
  EXPECT_THAT(problem(kPlane + "EDGE_SE2_XY 7 1 1 1 1 0 1\nEDGE_SE2_XY 7 2 1 1 1 0 1\nVERTEX_XY 1 0 0\n"),
              HasProblem("g2o.no-edges"));
  EXPECT_THAT(problem("A\nB\nC\nD\nE\nE\n"), HasProblem("g2o.no-graph", "x.g2o", "2 E, 1 A, 1 B, 1 C ..."));
}

TEST(G2o, ReadsTheFieldCases) {
  const auto folder = test_support::dataSet("10-field-cases/graph_counts_and_tags");
  if (!folder) return;
  const auto graph = std::get<G2oGraph2D>(readG2o(*folder / "toro.graph").graph);
  EXPECT_EQ(graph.ids.size(), 20u);
  EXPECT_EQ(graph.edges.size(), 20u);
  EXPECT_TRUE(graph.edges[0].information.isApprox(Eigen::Vector3d(50, 50, 100).asDiagonal().toDenseMatrix()));
  EXPECT_THAT(problemsOf([&] { readG2o(*folder / "noinfo3.g2o"); }), HasProblem("g2o.no-information"));
}

TEST(G2o, FilesWithoutAGraphAreRefused) {
  EXPECT_THAT(problem(""), HasProblem("g2o.no-graph", "x.g2o"));
  EXPECT_THAT(problem("# only a comment\nVERTEX_XY 1 0 0\n"), HasProblem("g2o.no-graph", "x.g2o"));
  EXPECT_THAT(problem(kPlane), HasProblem("g2o.no-edges", "x.g2o"));
  EXPECT_THAT(problemsOf([] { readG2o(fs::path("/nowhere/x.g2o")); }), HasProblem("file.not-opened", "/nowhere/x.g2o"));
}

TEST(G2o, ReadsCompressedFilesAndReportsTruncation) {
  const ScratchFolder folder;
  put(folder / "x.g2o", kPlane + kPlaneEdge);
  for (const char* tool : {"gzip", "bzip2", "xz"}) {
    const auto packed = outputOf(std::string(tool) + " -c " + (folder / "x.g2o").string());
    if (!packed) GTEST_SKIP() << "NOT TESTED: there is no " << tool;
    put(folder / "packed", *packed);
    EXPECT_EQ(toG2o(std::get<G2oGraph2D>(readG2o(folder / "packed").graph)), kPlane + kPlaneEdge);
    put(folder / "cut", packed->substr(0, packed->size() / 2));
    EXPECT_THAT(problemsOf([&] { readG2o(folder / "cut"); }), HasProblem("file.damaged")) << tool;
  }
}

TEST(G2o, WritesEqualGraphsAsEqualBytes) {
  const std::string text = kPlane + "FIX 10\n" + kPlaneEdge;
  EXPECT_EQ(toG2o(std::get<G2oGraph2D>(parse(text).graph)), text);
  const std::string other = "FIX 10\nVERTEX_SE2 10 +1.0 2e0 0.50\nVERTEX_SE2 7 -0 -0.0 0\n" + kPlaneEdge;
  EXPECT_EQ(toG2o(std::get<G2oGraph2D>(parse(other).graph)), text);
  EXPECT_EQ(toG2o(std::get<G2oGraph3D>(parse(kSpace + kSpaceEdge).graph)),
            toG2o(std::get<G2oGraph3D>(parse(kSpace + "EDGE_SE3:QUAT 0 1 1 2 3 0 0 -2 -2" + kUnit6).graph)));
}

RC_GTEST_PROP(G2o, ReadsBackWhatItWrote, ()) {
  G2oGraph2D graph;
  const auto draw = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) * 3.1e-6; };
  for (int i = 0; i < *rc::gen::inRange(2, 10); ++i) {
    graph.ids.push_back(*rc::gen::inRange(0, 1000) * 100 + i);
    graph.poses.push_back({draw(), draw(), draw()});
  }
  const int size = static_cast<int>(graph.ids.size());
  for (int i = 1; i < size; ++i) {
    graph.edges.push_back({*rc::gen::inRange(0, i), i, {draw(), draw(), draw()}, Eigen::Matrix3d::Identity()});
    graph.edges.back().information(0, 1) = graph.edges.back().information(1, 0) = draw() / 10.0;
  }
  const auto back = std::get<G2oGraph2D>(parse(toG2o(graph)).graph);
  RC_ASSERT(back.ids == graph.ids);
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    RC_ASSERT(back.poses[i].position_m() == graph.poses[i].position_m());
    RC_ASSERT(back.poses[i].yaw_rad == graph.poses[i].yaw_rad);
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    RC_ASSERT(back.edges[i].from == graph.edges[i].from && back.edges[i].to == graph.edges[i].to);
    RC_ASSERT(back.edges[i].information == graph.edges[i].information);
  }
}

TEST(G2o, ReadsTheDataSets) {
  const auto folder = test_support::dataSet("02-pose-graphs");
  if (!folder) return;
  const auto plane = std::get<G2oGraph2D>(readG2o(*folder / "2d/intel.g2o.gz").graph);
  EXPECT_EQ(plane.ids.size(), 1728u);
  EXPECT_EQ(plane.edges.size(), 2512u);
  const auto space = std::get<G2oGraph3D>(readG2o(*folder / "3d/sphere2500.g2o.xz").graph);
  EXPECT_EQ(space.ids.size(), 2500u);
  EXPECT_EQ(space.edges.size(), 4949u);
  const auto edges_only = std::get<G2oGraph2D>(readG2o(*folder / "2d/kitti_02.g2o.gz").graph);
  EXPECT_EQ(edges_only.ids.size(), 4661u);
  EXPECT_THAT(edges_only.poses, IsEmpty());
}

}  // namespace
}  // namespace swiftlet::interfaces
