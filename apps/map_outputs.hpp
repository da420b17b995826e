// What `swiftlet map` leaves: map.pgm, map.yaml, map.png, trajectory.tum, report.html and, where there is a graph,
// graph.g2o.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::apps {

/// Every scan of a log in the order it was read, kept on disk: a log may be longer than memory. Used by one thread.
class TrackSpool {
 public:
  /// Throws InputError when there is no room for temporary files.
  TrackSpool();
  void add(common::Time stamp, const perception::TrackedScan& scan);
  void forEach(const std::function<void(common::Time, const perception::TrackedScan&)>& use) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

/// A curve of bounded length, whatever the number of values: neighbours are joined, the greatest of them stays.
class ThinnedCurve {
 public:
  void add(double x, double y);
  const std::vector<Eigen::Vector2d>& points() const { return points_; }

 private:
  std::vector<Eigen::Vector2d> points_;
  int stride_ = 1, pending_ = 0;
};

struct MapFigures {
  std::string log;
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> warnings;
  ThinnedCurve milliseconds;  ///< Over the index of the scan.
};

/// Writes all files into `out`, each in one step. Throws InputError when one cannot be written.
void writeMapOutputs(const std::filesystem::path& out, perception::LaserSlam& slam, const TrackSpool& track,
                     const MapFigures& figures);

}  // namespace swiftlet::apps
