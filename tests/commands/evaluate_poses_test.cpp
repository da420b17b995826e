// `swiftlet evaluate` with trajectories of data sets that have no stamps: how their poses are paired.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::runSwiftlet;
using testing::HasSubstr;

class EvaluatePoses : public test_support::Scratch {
 protected:
  /// At x = 0, 1 and 3 m; `last_m` is that of the last.
  std::string kitti(const std::string& last_m = "3") const {
    return write("kitti" + last_m + ".txt",
                 "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n1 0 0 " + last_m + " 0 1 0 0 0 0 1 0\n");
  }
  std::string tum(const std::string& t1, const std::string& t2, const std::string& t3) const {
    return write("est.tum", t1 + " 0 0 0 0 0 0 1\n" + t2 + " 1 0 0 0 0 0 1\n" + t3 + " 3 0 0 0 0 0 1\n");
  }
  /// The same places, as frames 0, 2 and 6.
  std::string frames() const {
    std::filesystem::create_directories(path("frames"));
    const std::vector<std::pair<std::string, std::string>> poses{{"0", "0"}, {"2", "1"}, {"6", "3"}};
    for (const auto& [frame, at] : poses)
      (void)write("frames/frame-00000" + frame + ".pose.txt", "1 0 0 " + at + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    return path("frames");
  }
  nlohmann::json figures(const std::string& estimate, const std::string& reference) const {
    const ProgramEnd end = runSwiftlet({"evaluate", "ate", estimate, reference, "--align", "none", "--json"});
    EXPECT_EQ(end.exit_code, 0) << describe(end);
    return nlohmann::json::parse(end.out, nullptr, false);
  }
};

TEST_F(EvaluatePoses, WithoutStampsArePairedInTheirOrder) {
  const nlohmann::json lines = figures(kitti(), kitti("3.5"));
  EXPECT_EQ(lines.at("pairs"), 3);
  EXPECT_EQ(lines.at("paired_by"), "order");
  EXPECT_NEAR(lines.at("ate_max_m"), 0.5, 1e-9);
  EXPECT_NEAR(figures(tum("10.1", "10.2", "10.4"), kitti("3.5")).at("ate_max_m"), 0.5, 1e-9);
  EXPECT_NEAR(figures(frames(), kitti("3.5")).at("ate_max_m"), 0.5, 1e-9);
}

TEST_F(EvaluatePoses, WithFrameNumbersArePairedByThem) {
  for (const std::string& estimate : {tum("2", "4", "6"), tum("0.0666667", "0.1333333", "0.2")}) {
    const nlohmann::json found = figures(estimate, frames());
    EXPECT_EQ(found.at("paired_by"), "frame numbers");
    EXPECT_EQ(found.at("pairs"), 2) << "there is no frame 4";
    EXPECT_NEAR(found.at("ate_max_m"), 1.0, 1e-9) << "frame 2 is at 0 and 1 m, frame 6 at 3 m in both";
  }
  const ProgramEnd end = runSwiftlet({"evaluate", "ate", frames(), frames(), "--align", "none"});
  EXPECT_THAT(end.out, HasSubstr("3 pairs, by frame numbers, of 3 estimated and 3 reference poses")) << describe(end);
}

TEST_F(EvaluatePoses, ThatCannotBePairedAreRefused) {
  const auto expectRefused = [](std::vector<std::string> arguments, const std::string& says) {
    arguments.insert(arguments.begin(), "evaluate");
    const ProgramEnd end = runSwiftlet(arguments);
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_THAT(end.err, HasSubstr(says)) << describe(end);
  };
  const std::string two = write("two.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n");
  expectRefused({"ate", two, kitti()}, "has 2 poses and " + kitti() + " has 3: without stamps");
  expectRefused({"ate", tum("0.011", "0.022", "0.033"), frames()}, "has stamps, where " + frames() + " has frame");
  expectRefused({"rpe", kitti(), kitti(), "--unit", "seconds"}, "--unit: the poses have no times in seconds");
  expectRefused({"relations", kitti(), write("r", "0 1 1 0 0 0 0 0\n")}, "has no stamps, expected `t x y z");
  expectRefused({"ate", kitti(), write("cut.txt", "1 0 0 0 0 1 0 0\n1 0 0 0 0 1\n")}, "cut.txt:2");
}

}  // namespace
}  // namespace swiftlet::commands
