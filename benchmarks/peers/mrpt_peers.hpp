// icp-slam and rbpf-slam of MRPT, as its applications of those names run them: with the settings that MRPT ships.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "common/geometry.hpp"
#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::peers {

/// Something that is given a log scan by scan and says afterwards where each scan was taken.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual void add(const interfaces::LoggedScan& logged) = 0;
  /// T_map_robot of every scan, in the order they were given. Last.
  virtual std::vector<common::Pose2> finish() = 0;
};

/// Given odometry where the scans have some.
std::unique_ptr<Peer> mrptIcpSlam(const std::filesystem::path& settings);
std::unique_ptr<Peer> mrptRbpfSlam(const std::filesystem::path& settings);

}  // namespace swiftlet::peers
