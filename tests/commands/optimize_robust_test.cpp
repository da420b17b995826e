// swiftlet optimize on graphs with false loop closures: without --robust it says that they contradict the others, with
// it they are refused, and the result is that of the graph without them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "common/random.hpp"
#include "interfaces/files/g2o.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using interfaces::G2oGraph2D;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;
using testing::Not;

class OptimizeRobust : public test_support::Scratch {};

/// A square walked `laps` times in steps of 1 m, each lap closed at every corner. Ids are 10 apart.
std::string laps(int count, const std::string& information = " 100 0 0 100 0 400\n") {
  std::string text;
  for (int i = 1; i < 16 * count; ++i) {
    const std::string from = std::to_string(10 * (i - 1)), to = std::to_string(10 * i);
    text += "EDGE_SE2 " + from + " " + to + (i % 4 == 0 ? " 1.01 0 1.5707963" : " 0.99 0.01 0") + information;
    if (i >= 16 && i % 4 == 0)
      text += "EDGE_SE2 " + std::to_string(10 * (i - 16)) + " " + to + " 0 0.02 0" + information;
  }
  return text;
}

const std::string kFalse = "EDGE_SE2 80 400 9 -3 1 100 0 0 100 0 400\n";

TEST_F(OptimizeRobust, NamesTheEdgeThatContradictsTheOthersAndRefusesIt) {
  const std::string graph = write("laps.g2o", laps(4) + kFalse);
  const ProgramEnd plain = runSwiftlet({"optimize", graph, "--json"});
  EXPECT_EQ(plain.exit_code, 1) << describe(plain);
  const auto found = nlohmann::json::parse(plain.out);
  EXPECT_EQ(found.at("verdict"), "contradictory") << found.dump(2);
  EXPECT_FALSE(found.at("converged").get<bool>());
  ASSERT_EQ(found.at("worst_edges").size(), 1u) << found.dump(2);
  EXPECT_EQ(found.at("worst_edges")[0].at("from"), 80);
  EXPECT_EQ(found.at("worst_edges")[0].at("to"), 400);
  const ProgramEnd text = runSwiftlet({"optimize", graph});
  EXPECT_THAT(text.out, HasSubstr("contradicted by the other edges:"));
  EXPECT_THAT(text.out, HasSubstr("\n  80 -> 400: "));

  const ProgramEnd robust = runSwiftlet({"optimize", graph, "--robust", "--out", path("out"), "--json"});
  EXPECT_EQ(robust.exit_code, 0) << describe(robust);
  const auto json = nlohmann::json::parse(robust.out);
  EXPECT_EQ(json.at("verdict"), "converged");
  ASSERT_EQ(json.at("refused_edges").size(), 1u) << json.dump(2);
  EXPECT_EQ(json.at("refused_edges")[0].at("from"), 80);
  const auto clean = nlohmann::json::parse(runSwiftlet({"optimize", write("clean.g2o", laps(4)), "--json"}).out);
  EXPECT_EQ(clean.at("verdict"), "converged") << clean.dump(2);
  EXPECT_NEAR(json.at("chi2_final").get<double>(), clean.at("chi2_final").get<double>(), 1e-6);
  EXPECT_EQ(json.at("degrees_of_freedom"), clean.at("degrees_of_freedom"));
  EXPECT_THAT(readText(path("out/graph.g2o")), Not(HasSubstr("EDGE_SE2 80 400")));
}

TEST_F(OptimizeRobust, ImpossibleErrorsAreSaidWhereNoClosureAloneIsFarOff) {
  const std::string weak = " 4 0 0 4 0 16\n", far_too_great = " 1e6 0 0 1e6 0 4e6\n";
  const ProgramEnd one = runSwiftlet({"optimize", write("one.g2o", laps(4, weak) + "EDGE_SE2 80 400 9 -3 1" + weak)});
  EXPECT_EQ(one.exit_code, 1) << describe(one);
  EXPECT_THAT(one.out, HasSubstr("chi2 149.527, 39 degrees of freedom: 1 closure is contradicted by the other edges:"));
  EXPECT_THAT(one.out, HasSubstr("\n  80 -> 400: "));
  const ProgramEnd all = runSwiftlet({"optimize", write("all.g2o", laps(4, far_too_great))});
  EXPECT_EQ(all.exit_code, 0) << describe(all);
  EXPECT_THAT(all.out, HasSubstr("closures are 9.77 times as far off as their information says, all alike"));
}

TEST_F(OptimizeRobust, CannotTellWhereTheFalseOnesOutnumberTheRightOnes) {
  std::string graph = laps(3);
  common::RandomStream random(1, "false");
  for (int i = 0; i < 12; ++i)
    graph += "EDGE_SE2 " + std::to_string(10 * i) + " " + std::to_string(10 * (30 + i)) + " " +
             std::to_string(random.uniform(-9.0, 9.0)) + " " + std::to_string(random.uniform(-9.0, 9.0)) + " " +
             std::to_string(random.uniform(-3.0, 3.0)) + " 100 0 0 100 0 400\n";
  const std::string file = write("false.g2o", graph);
  const ProgramEnd end = runSwiftlet({"optimize", file, "--robust", "--json"});
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  EXPECT_EQ(nlohmann::json::parse(end.out).at("verdict"), "cannot tell");
  EXPECT_THAT(runSwiftlet({"optimize", file, "--robust"}).out, HasSubstr("cannot tell which closures are right"));
}

struct Polluted {
  const char* file;
  int random;  ///< False closures between random vertices, with a random motion of up to 10 m.
  int copied;  ///< The motions of right closures between random vertices.
};
void PrintTo(const Polluted& graph, std::ostream* stream) {
  *stream << graph.file << " " << graph.random << " " << graph.copied;
}

class RobustGraphs : public test_support::Scratch, public testing::WithParamInterface<Polluted> {};

template <typename Graph>
std::vector<std::size_t> closuresOf(const Graph& graph) {
  std::vector<std::size_t> closures;
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (std::abs(graph.edges[i].from - graph.edges[i].to) != 1) closures.push_back(i);
  return closures;
}

common::Pose2 randomMotion(common::RandomStream& random, const common::Pose2&) {
  const double x_m = random.uniform(-10.0, 10.0), y_m = random.uniform(-10.0, 10.0);
  return {x_m, y_m, random.uniform(-3.1, 3.1)};
}
common::Pose3 randomMotion(common::RandomStream& random, const common::Pose3&) {
  return common::lifted(randomMotion(random, common::Pose2{}), random.uniform(-10.0, 10.0));
}

template <typename Graph>
void pollute(Graph& graph, const Polluted& by) {
  common::RandomStream random(3, "false closures");
  const auto closures = closuresOf(graph);
  for (int i = 0; i < by.random + by.copied; ++i) {
    auto edge =
        graph.edges[closures[static_cast<std::size_t>(random.uniform() * static_cast<double>(closures.size()))]];
    const double poses = static_cast<double>(graph.ids.size());
    edge.from = static_cast<int>(random.uniform(0.0, 0.4) * poses);
    edge.to = static_cast<int>(random.uniform(0.5, 1.0) * poses);
    if (i < by.random) edge.T_from_to = randomMotion(random, edge.T_from_to);
    graph.edges.push_back(edge);
  }
}

double apart_m(const common::Pose2& a, const common::Pose2& b) { return (a.position_m() - b.position_m()).norm(); }
double apart_m(const common::Pose3& a, const common::Pose3& b) { return (a.position_m - b.position_m).norm(); }

double farthest_m(const interfaces::G2oFile& a, const interfaces::G2oFile& b) {
  return std::visit(
      [&](const auto& graph) {
        const auto& other = std::get<std::decay_t<decltype(graph)>>(b.graph);
        double farthest_m = 0.0;
        for (std::size_t i = 0; i < graph.poses.size(); ++i)
          farthest_m = std::max(farthest_m, apart_m(graph.poses[i], other.poses[i]));
        return farthest_m;
      },
      a.graph);
}

TEST_P(RobustGraphs, FalseClosuresAreRefusedAndTheResultIsThatWithoutThem) {
  const auto file = test_support::dataSet(std::string("02-pose-graphs/") + GetParam().file);
  if (!file) return;
  interfaces::G2oFile graph = interfaces::readG2o(*file);
  const std::string polluted = std::visit(
      [&](auto& g) {
        pollute(g, GetParam());
        return toG2o(g);
      },
      graph.graph);
  const ProgramEnd robust =
      runSwiftlet({"optimize", write("false.g2o", polluted), "--robust", "--out", path("robust"), "--json"});
  ASSERT_EQ(robust.exit_code, 0) << describe(robust);
  const auto json = nlohmann::json::parse(robust.out);
  std::set<std::pair<int, int>> refused;
  for (const auto& edge : json.at("refused_edges")) refused.emplace(edge.at("from"), edge.at("to"));
  std::visit(
      [&](const auto& g) {
        const std::size_t count = static_cast<std::size_t>(GetParam().random + GetParam().copied);
        for (std::size_t i = g.edges.size() - count; i < g.edges.size(); ++i)
          EXPECT_TRUE(refused.contains({static_cast<int>(g.ids[static_cast<std::size_t>(g.edges[i].from)]),
                                        static_cast<int>(g.ids[static_cast<std::size_t>(g.edges[i].to)])}));
        EXPECT_LE(refused.size(), count + (closuresOf(g).size() - count) / 20) << "of the right ones 95 % are kept";
      },
      graph.graph);
  ASSERT_EQ(runSwiftlet({"optimize", file->string(), "--out", path("clean")}).exit_code, 0);
  EXPECT_LT(farthest_m(interfaces::readG2o(path("robust/graph.g2o")), interfaces::readG2o(path("clean/graph.g2o"))),
            0.2);
}

INSTANTIATE_TEST_SUITE_P(Optimize, RobustGraphs,
                         testing::Values(Polluted{"2d/kitti_00.g2o.gz", 1, 0}, Polluted{"2d/kitti_00.g2o.gz", 50, 0},
                                         Polluted{"2d/CSAIL.g2o.gz", 50, 0}, Polluted{"2d/CSAIL.g2o.gz", 0, 50},
                                         Polluted{"2d/intel.g2o.gz", 10, 10}, Polluted{"2d/kitti_02.g2o.gz", 0, 10},
                                         Polluted{"3d/smallGrid3D.g2o.gz", 20, 20}));

}  // namespace
}  // namespace swiftlet::commands
