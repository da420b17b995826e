#include "tests/flight/run_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/scratch.hpp"

namespace swiftlet::flight {
namespace {

using test_support::readText;
using testing::HasSubstr;
using testing::StartsWith;

void expectSoundMap(const std::filesystem::path& run) {
  const Pgm map = readPgm(run / "map.pgm");
  EXPECT_EQ(map.pixels.size(), static_cast<std::size_t>(map.width_px) * static_cast<std::size_t>(map.height_px));
  EXPECT_EQ(map.greatest, 255);
  for (const char level : {'\0', '\xfe'})
    EXPECT_NE(map.pixels.find(level), std::string::npos) << "no occupied or no free cell in map.pgm";
  const std::string yaml = readText(run / "map.yaml");
  for (const std::string key :
       {"image: map.pgm", "resolution: ", "origin: [", "negate: 0", "occupied_thresh: ", "free_thresh: "})
    EXPECT_THAT(yaml, HasSubstr(key));
}

void expectSoundEvents(const std::filesystem::path& file) {
  const std::string text = readText(file);
  double last_s = 0.0;
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const auto event = nlohmann::json::parse(text.substr(begin, end - begin));
    EXPECT_GE(event.at("t_s").get<double>(), last_s) << event;
    EXPECT_FALSE(event.at("text").get<std::string>().empty()) << event;
    last_s = event.at("t_s").get<double>();
  }
}

void expectSoundTrajectory(const std::filesystem::path& file) {
  const std::vector<TumPose> poses = readTum(file);
  ASSERT_GT(poses.size(), 10u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double* q = poses[i].quaternion;
    EXPECT_NEAR(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), 1.0, 1e-3) << "pose " << i;
    if (i == 0) continue;
    const double step_s = poses[i].stamp_s - poses[i - 1].stamp_s;
    EXPECT_GT(step_s, 0.0) << "pose " << i;
    EXPECT_LE(step_s, 0.1) << "pose " << i;
  }
}

}  // namespace

std::vector<TumPose> readTum(const std::filesystem::path& file) {
  std::vector<TumPose> poses;
  const std::string text = readText(file);
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    if (text[begin] == '#') continue;
    std::istringstream line(text.substr(begin, end - begin));
    TumPose pose;
    line >> pose.stamp_s;
    for (double& value : pose.position_m) line >> value;
    for (double& value : pose.quaternion) line >> value;
    EXPECT_TRUE(line && line.peek() == EOF) << file << ": " << line.str();
    poses.push_back(pose);
  }
  return poses;
}

Pgm readPgm(const std::filesystem::path& file) {
  std::istringstream stream(readText(file));
  std::string word;
  std::vector<std::string> header;
  while (header.size() < 4 && stream >> word) {
    if (word.starts_with("#"))
      std::getline(stream, word);
    else
      header.push_back(word);
  }
  Pgm map;
  if (header.size() < 4 || header[0] != "P5") {
    ADD_FAILURE() << file << " is no binary graymap";
    return map;
  }
  map.width_px = std::stoi(header[1]);
  map.height_px = std::stoi(header[2]);
  map.greatest = std::stoi(header[3]);
  stream.get();
  map.pixels.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  return map;
}

void expectSoundRun(const std::filesystem::path& run) {
  SCOPED_TRACE(run.string());
  for (const std::string name : {"mission.json", "events.jsonl", "trajectory.tum", "map.pgm", "map.yaml", "map.png",
                                 "report.html", "config.yaml"})
    ASSERT_TRUE(std::filesystem::exists(run / name)) << name;
  const auto mission = nlohmann::json::parse(readText(run / "mission.json"));
  for (const auto& frontier : mission.at("frontiers"))
    EXPECT_FALSE(frontier.at("reason").get<std::string>().empty()) << frontier;
  expectSoundMap(run);
  expectSoundEvents(run / "events.jsonl");
  expectSoundTrajectory(run / "trajectory.tum");
  EXPECT_THAT(readText(run / "map.png"), StartsWith("\x89PNG\r\n"));
  const std::string report = readText(run / "report.html");
  EXPECT_THAT(report, HasSubstr("</html>"));
  for (const std::string link : {"src=\"http", "href=\"http", "url(http", "src=\"/", "src=\"map"})
    EXPECT_EQ(report.find(link), std::string::npos) << "report.html needs " << link << " from elsewhere";
}

}  // namespace swiftlet::flight
