// swiftlet optimize as users meet it: a graph is improved, reported and written; unusable input is refused. On the
// usual data sets chi2 is the lowest that any solver setting or start has reached.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "tests/support/datasets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

namespace fs = std::filesystem;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::ContainsRegex;
using testing::HasSubstr;

/// A square walked once, its last side measured 0.2 m too long; the guess is off by more.
const std::string kSquare =
    "VERTEX_SE2 5 0 0 0\nVERTEX_SE2 6 1.5 0 1.5\nVERTEX_SE2 7 1 1 3\nVERTEX_SE2 8 0 1.5 -1.5\n"
    "EDGE_SE2 5 6 1 0 1.5707963 100 0 0 100 0 100\nEDGE_SE2 6 7 1 0 1.5707963 100 0 0 100 0 100\n"
    "EDGE_SE2 7 8 1 0 1.5707963 100 0 0 100 0 100\nEDGE_SE2 8 5 1.2 0 1.5707963 100 0 0 100 0 100\n";

class Optimize : public test_support::Scratch {};

TEST_F(Optimize, ReportsAndWritesAGraphThatReadsBack) {
  const std::string graph = write("square.g2o", kSquare);
  const ProgramEnd end = runSwiftlet({"optimize", graph, "--out", path("a/b"), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_EQ(json.at("vertices"), 4);
  EXPECT_EQ(json.at("edges"), 4);
  EXPECT_EQ(json.at("dimension"), 2);
  EXPECT_TRUE(json.at("converged").get<bool>());
  EXPECT_GT(json.at("chi2_initial").get<double>(), 80.0);
  // The four sides share the 0.2 m, and so do the four turns by levers of 0.5 m: 100 * 0.2^2 / (4 + 4 * 0.5^2).
  EXPECT_NEAR(json.at("chi2_final").get<double>(), 0.8, 1e-3);
  EXPECT_EQ(json.at("written"), path("a/b/graph.g2o"));

  const std::string written = readText(path("a/b/graph.g2o"));
  EXPECT_THAT(written, HasSubstr("VERTEX_SE2 5 0 0 0\n")) << "the first pose stays, ids are kept";
  EXPECT_THAT(written, HasSubstr("EDGE_SE2 8 5 1.2 0 1.5707963 100 0 0 100 0 100\n"));
  const ProgramEnd second = runSwiftlet({"optimize", path("a/b/graph.g2o"), "--json"});
  EXPECT_EQ(second.exit_code, 0) << describe(second);
  const auto again = nlohmann::json::parse(second.out);
  EXPECT_NEAR(again.at("chi2_initial").get<double>(), json.at("chi2_final").get<double>(), 1e-6);
  EXPECT_NEAR(again.at("chi2_final").get<double>(), json.at("chi2_final").get<double>(), 1e-6);
}

// The same square as TORO writes it.
TEST_F(Optimize, ReadsAGraphOfToro) {
  std::string toro = kSquare;
  for (const auto& [from, to] :
       {std::pair{"VERTEX_SE2", "VERTEX2"}, {"EDGE_SE2", "EDGE2"}, {"100 0 0 100 0 100", "100 0 100 100 0 0"}})
    for (std::size_t at = 0; (at = toro.find(from, at)) != std::string::npos; at += std::string(to).size())
      toro.replace(at, std::string(from).size(), to);
  const ProgramEnd end = runSwiftlet({"optimize", write("square.graph", toro), "--out", path("out"), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_NEAR(nlohmann::json::parse(end.out).at("chi2_final").get<double>(), 0.8, 1e-3);
  EXPECT_THAT(readText(path("out/graph.g2o")), HasSubstr("VERTEX_SE2 5 0 0 0\n"));
}

TEST_F(Optimize, PrintsATableAndTheSameGraphGivesTheSameBytes) {
  const std::string graph = write("square.g2o", kSquare + "VERTEX_XY 9 1 1\n");
  const ProgramEnd end = runSwiftlet({"optimize", graph, "--out", path("a")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.out,
              ContainsRegex("graph +vertices +edges .*chi2 initial +chi2 final +start +converged +iterations in all"));
  EXPECT_THAT(end.out, HasSubstr("\nsquare.g2o "));
  EXPECT_THAT(end.err, HasSubstr("square.g2o:9: VERTEX_XY: not used, 1 line is left out"));
  EXPECT_EQ(runSwiftlet({"optimize", graph, "--out", path("b")}).exit_code, 0);
  EXPECT_EQ(readText(path("a/graph.g2o")), readText(path("b/graph.g2o")));
}

TEST_F(Optimize, OptimizesAGraphInSpace) {
  const std::string unit = " 100 0 0 0 0 0 100 0 0 0 0 100 0 0 0 100 0 0 100 0 100\n";
  const std::string graph = write("line.g2o",
                                  "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 2 1 0 0 0 0 1\n"
                                  "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1" +
                                      unit + "EDGE_SE3:QUAT 0 1 1 0 1 0 0 0 1" + unit);
  const auto json = nlohmann::json::parse(runSwiftlet({"optimize", graph, "--json"}).out);
  EXPECT_EQ(json.at("dimension"), 3);
  EXPECT_NEAR(json.at("chi2_initial").get<double>(), 100.0 * (2.0 + 3.0), 1e-9);
  EXPECT_NEAR(json.at("chi2_final").get<double>(), 100.0 * (0.25 + 0.25), 1e-6);
}

TEST_F(Optimize, RefusesUnusableInputAndWritesNothing) {
  const auto refused = [&](const std::string& graph, const std::string& pattern) {
    const ProgramEnd end = runSwiftlet({"optimize", graph, "--out", path("out")});
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, ContainsRegex(pattern));
    EXPECT_FALSE(fs::exists(path("out"))) << graph;
  };
  refused(path("none.g2o"), "none\\.g2o: cannot be opened: No such file");
  refused(write("empty.g2o", ""), "empty\\.g2o: holds no pose graph");
  refused(write("nan.g2o", kSquare + "EDGE_SE2 5 7 nan 0 0 1 0 0 1 0 1\n"), "nan\\.g2o:9:14: EDGE_SE2: x: `nan`");
  refused(folder_.string(), "is a folder");
}

TEST_F(Optimize, CountsAndRepairsIndefiniteInformationMatrices) {
  // The cross term of the first two is greater than their diagonals.
  const std::string graph = write("cross.g2o", kSquare +
                                                   "EDGE_SE2 5 7 1 1 3.1415926 100 150 0 100 0 100\n"
                                                   "EDGE_SE2 6 8 1 1 3.1415926 100 150 0 100 0 100\n"
                                                   "EDGE_SE2 6 8 1 1 3.1415926 100 50 0 100 0 100\n");
  const ProgramEnd refused = runSwiftlet({"optimize", graph});
  EXPECT_EQ(refused.exit_code, 2) << describe(refused);
  EXPECT_THAT(refused.err,
              HasSubstr("cross.g2o:9:28: EDGE_SE2: the information is not positive definite; this holds for "
                        "2 of 7 edges, --ignore-cross-terms uses the diagonals of these alone\n"));
  const ProgramEnd mended = runSwiftlet({"optimize", graph, "--ignore-cross-terms", "--json"});
  EXPECT_EQ(mended.exit_code, 0) << describe(mended);
  EXPECT_EQ(nlohmann::json::parse(mended.out).at("indefinite_edges"), 2);
  EXPECT_THAT(mended.err, HasSubstr("the information of 2 edges is not positive definite"));

  const std::string diagonal = write("diagonal.g2o", kSquare + "EDGE_SE2 5 7 1 1 3.1415926 100 0 0 -1 0 100\n");
  const ProgramEnd hopeless = runSwiftlet({"optimize", diagonal, "--ignore-cross-terms"});
  EXPECT_EQ(hopeless.exit_code, 2) << describe(hopeless);
  EXPECT_THAT(hopeless.err, HasSubstr("not even its diagonal; this holds for 1 of 5 edges\n"));
}

TEST_F(Optimize, DoesNotOverwriteItsInputAndRefusesABadFolder) {
  const std::string graph = write("graph.g2o", kSquare);
  const ProgramEnd same = runSwiftlet({"optimize", graph, "--out", folder_.string()});
  EXPECT_EQ(same.exit_code, 2) << describe(same);
  EXPECT_THAT(same.err, HasSubstr("is the graph to be optimized itself"));
  EXPECT_EQ(readText(graph), kSquare);
  const ProgramEnd file = runSwiftlet({"optimize", graph, "--out", write("file", "")});
  EXPECT_EQ(file.exit_code, 2) << describe(file);
  test_support::ProgramOptions full_disk;
  full_disk.largest_file_bytes = 100;
  const ProgramEnd full = runSwiftlet({"optimize", graph, "--out", path("full")}, full_disk);
  EXPECT_EQ(full.exit_code, 2) << describe(full);
  EXPECT_FALSE(fs::exists(path("full"))) << "nothing half written";
}

TEST_F(Optimize, ReplacesOnlyItsOwnOlderGraph) {
  const std::string graph = write("square.g2o", kSquare);
  const std::vector<std::string> arguments{"optimize", graph, "--out", path("out")};
  EXPECT_EQ(runSwiftlet(arguments).exit_code, 0);
  EXPECT_EQ(runSwiftlet(arguments).exit_code, 0) << "its own";
  EXPECT_NEAR(nlohmann::json::parse(readText(path("out/optimized.json"))).at("chi2_final").get<double>(), 0.8, 1e-3);

  fs::create_directories(path("theirs"));
  write("theirs/graph.g2o", "theirs");
  const ProgramEnd end = runSwiftlet({"optimize", graph, "--out", path("theirs")});
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("holds no optimized graph of this program"));
  EXPECT_EQ(readText(path("theirs/graph.g2o")), "theirs");
}

TEST_F(Optimize, AChi2ThatIsNotANumberIsAFailure) {
  const std::string graph = write("huge.g2o",
                                  "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1e7 0 0\n"
                                  "EDGE_SE2 0 1 -1e7 0 0 1e300 0 0 1e300 0 1\n"
                                  "EDGE_SE2 0 1 1e7 0 0 1e300 0 0 1e300 0 1\n");
  const ProgramEnd end = runSwiftlet({"optimize", graph, "--out", path("out")});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("huge.g2o: chi2 is "));
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(Optimize, ReportsPartsWithoutAnEdgeToTheFixedVertex) {
  const std::string graph = write("parts.g2o",
                                  "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 5 5 0\nVERTEX_SE2 3 6 5 0\n"
                                  "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n");
  const ProgramEnd end = runSwiftlet({"optimize", graph});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("note: 1 part of the graph is not connected to the fixed vertex"));
}

TEST_F(Optimize, TheExitCodeShowsThatItDidNotConverge) {
  const ProgramEnd end = runSwiftlet({"optimize", write("square.g2o", kSquare), "--max-iterations", "1"});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_THAT(end.out, HasSubstr("it did not converge"));
}

struct Known {
  const char* file;
  double chi2;  ///< The lowest value from any start with any setting.
};
void PrintTo(const Known& known, std::ostream* stream) { *stream << known.file; }

class KnownGraphs : public testing::TestWithParam<Known> {};

TEST_P(KnownGraphs, ReachTheLowestChi2) {
  const auto file = test_support::dataSet(std::string("02-pose-graphs/") + GetParam().file);
  if (!file) return;
  const ProgramEnd end = runSwiftlet({"optimize", file->string(), "--json"});
  ASSERT_EQ(end.exit_code, 0) << describe(end);
  const auto json = nlohmann::json::parse(end.out);
  EXPECT_NEAR(json.at("chi2_final").get<double>(), GetParam().chi2, 1e-6 * GetParam().chi2) << json.dump(2);
}

INSTANTIATE_TEST_SUITE_P(Optimize, KnownGraphs,
                         testing::Values(Known{"2d/manhattanOlson3500.g2o.gz", 146.076613},
                                         Known{"2d/manhattan.g2o.gz", 3549.036796}, Known{"2d/intel.g2o.gz", 45.004696},
                                         Known{"2d/city10000.g2o.xz", 511.985164}, Known{"2d/CSAIL.g2o.gz", 40.555129},
                                         Known{"2d/kitti_00.g2o.gz", 98.322012}, Known{"2d/kitti_02.g2o.gz", 78.764327},
                                         Known{"3d/sphere2500.g2o.xz", 727.149667},
                                         Known{"3d/parking-garage.g2o.xz", 1.2386906},
                                         Known{"3d/torus3D.g2o.xz", 14574.746439},
                                         Known{"3d/smallGrid3D.g2o.gz", 458.153784}),
                         [](const auto& graph) {
                           const std::string name = fs::path(graph.param.file).filename().string();
                           std::string word = name.substr(0, name.find('.'));
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

}  // namespace
}  // namespace swiftlet::commands
