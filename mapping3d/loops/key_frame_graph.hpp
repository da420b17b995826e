// The pose graph of key frames where no laser makes a 2D map: nodes are key frames, edges are alignments between them.
//
// A loop closure is checked twice before it may bend the map. First, it must agree with the path between its key frames
// as far as that path can have drifted; nothing else distinguishes two places that look alike in all they show.
// Second, when the graph has been optimized with all its edges, a loop closure that the others do not confirm has a
// large error, is taken out, and the graph is optimized again.
//
// A key frame without an edge begins a piece of the map, whose place is a guess. Two alignments between the key frames
// of two pieces that agree join them (after the Atlas of Campos et al., "ORB-SLAM3", T-RO 2021, section VI): the newer
// piece moves as a whole to where they say that it lies.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/key_pose.hpp"
#include "mapping3d/odometry/alignment.hpp"
#include "optimization/graph_3d.hpp"
#include "optimization/pose_graph_config.hpp"

namespace swiftlet::mapping3d {

struct KeyFrameGraphConfig {
  double drift_m =
      0.1;  ///< Difference of a loop closure's position from the path that is accepted however short the path is.
  double drift_rad =
      0.05;  ///< Difference of a loop closure's attitude from the path that is accepted however little the path turns.
  double greatest_error = 25.0;  ///< A loop closure whose squared error in the optimized graph is greater is removed;
                                 ///< the squared error of a right one is chi-squared with 6 degrees of freedom.
  optimization::PoseGraphConfig optimization;
};

/// Seen from key frame `from`, another one stands at T_from_to.
struct KeyFrameEdge {
  int from = 0;
  common::Pose3 T_from_to;
  /// Inverse covariance of the error (x, y, z, rotation vector) in the axes of the other.
  Matrix6d information = Matrix6d::Identity();
};

/// The piece `from` has become a part of `into`.
struct JoinedPieces {
  int from = 0;
  int into = 0;
};

/// One thread. The first key frame stays where it is.
class KeyFrameGraph {
 public:
  explicit KeyFrameGraph(const KeyFrameGraphConfig& config);

  /// Where the first key frame will stand; before it is added. It is the origin otherwise.
  void beginAt(const common::Pose3& T_map_key);
  /// The number of the new key frame, counted from 0. `edges` are its alignments to key frames of one piece. Their
  /// errors are alike, so that all of them count as one.
  int add(common::Time stamp, const common::Pose3& T_map_key, std::span<const KeyFrameEdge> edges);
  /// Whether drift along the shortest path of edges explains the difference between a loop closure and the map.
  bool allows(int to, const KeyFrameEdge& loop) const;
  /// Places the newest key frames anew by all of their edges (C. Kerl, J. Sturm, D. Cremers, "Dense visual SLAM for
  /// RGB-D cameras", IROS 2013, section IV: a graph of direct alignments).
  void adjustNewest();
  /// Adds loop closures to the newest key frame, within its piece, and optimizes. Returns how many of them were kept.
  int close(std::span<const KeyFrameEdge> loops);
  /// Remembers alignments of the newest key frame to those of other pieces. Joins two pieces when two of them agree.
  std::optional<JoinedPieces> join(std::span<const KeyFrameEdge> edges);

  std::size_t size() const { return stamps_.size(); }
  /// The piece of a key frame. Pieces are counted from 0 in the order of their making; not all numbers stay in use.
  int pieceOf(int key) const { return pieces_[static_cast<std::size_t>(key)]; }
  /// Of all key frames, by their numbers. Before the first one, a single key where it will stand.
  std::shared_ptr<const common::KeyPoses> poses() const { return poses_; }
  int loops() const { return loops_; }
  int rejected() const { return rejected_; }

 private:
  struct PathLength {
    double path_m = 0.0;
    double turn_rad = 0.0;
    double extent_m = 0.0;  ///< The distance of the path's farthest key frame from its end.
  };
  /// An alignment between key frames of two pieces.
  struct Meeting {
    KeyFrameEdge edge;
    int to = 0;
  };
  PathLength pathBetween(int from, int to) const;
  JoinedPieces piecesOf(const Meeting& meeting) const;
  common::Pose3 T_into_from(const Meeting& meeting) const;
  bool agree(const Meeting& a, const Meeting& b) const;
  int optimizeWith(std::size_t first_new);
  int takeOutUnconfirmed(const std::vector<double>& squared_errors, std::size_t first_new);
  void publish();

  KeyFrameGraphConfig config_;
  optimization::PoseGraph3D graph_;
  std::vector<common::Time> stamps_;
  std::vector<int> pieces_;  ///< Of the key frames.
  int begun_ = 0;            ///< Number of pieces so far.
  std::vector<Meeting> meetings_;
  std::shared_ptr<const common::KeyPoses> poses_;
  int loops_ = 0;
  int rejected_ = 0;
};

}  // namespace swiftlet::mapping3d
