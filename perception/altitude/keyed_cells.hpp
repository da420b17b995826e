// What is known of the ground, cell by cell, and hangs on the key scans of the 2D map: a loop closure, which moves
// these, moves it along.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/key_pose.hpp"
#include "common/tiled_grid.hpp"
#include "perception/altitude/ground_cell.hpp"

namespace swiftlet::perception {

/// Every cell in which something was seen is a square that keeps its place relative to one key scan. Squares that were
/// moved no longer lie along the axes of the map: a cell then has those in which its centre is, which are one for each
/// of the passes that saw it. A square between the centres comes back with the next correction. One thread.
template <typename Content>
class KeyedCells {
 public:
  struct Square {
    int key = kMap;
    common::Pose2 T_key_square;  ///< Of its centre, as it was first seen.
    common::Pose2 T_map_square;
    Content content;  ///< Directions in it are along the axes of the square.
  };

  explicit KeyedCells(double side_m) : side_m_(side_m) {}

  common::CellIndex cellAt(const Eigen::Vector2d& place_map_m) const {
    return perception::cellAt(place_map_m, side_m_);
  }

  /// Moves the squares as their key scans have moved. New squares hang on `newest_key`; before the first call, and if
  /// it is not among `keys`, on the map itself, as the take-off place does.
  void follow(const common::KeyPoses& keys, int newest_key) {
    newest_ = newest_key < static_cast<int>(keys.keys.size()) ? newest_key : kMap;
    if (keys.version == version_) return;
    version_ = keys.version;
    bool moved = false;
    for (std::size_t i = 0; i < keys.keys.size(); ++i) {
      const common::Pose2& T_map_key = keys.keys[i].T_map_key;
      if (i == T_map_keys_.size()) T_map_keys_.push_back(T_map_key);
      common::Pose2& known = T_map_keys_[i];
      moved = moved || known.position_m() != T_map_key.position_m() || known.yaw_rad != T_map_key.yaw_rad;
      known = T_map_key;
    }
    if (moved) placeAll();
  }

  /// The square that takes what is seen in a cell; a new one if none covers it.
  Square& at(common::CellIndex cell) {
    std::vector<std::size_t>& squares = cells_[cell];
    if (squares.empty()) {
      Square square;
      square.key = newest_;
      square.T_map_square = {(cell.x + 0.5) * side_m_, (cell.y + 0.5) * side_m_, 0.0};
      square.T_key_square = T_map_key(newest_).inverse() * square.T_map_square;
      squares.push_back(squares_.size());
      squares_.push_back(std::move(square));
    }
    return squares_[squares.front()];
  }

  /// Calls `visit(const Square&)` for the squares of a cell.
  template <typename Visit>
  void visit(common::CellIndex cell, const Visit& visit) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return;
    for (const std::size_t square : found->second) visit(squares_[square]);
  }

  /// Calls `visit(CellIndex)` for each cell that has squares, in their order.
  template <typename Visit>
  void visitCells(const Visit& visit) const {
    for (const auto& [cell, squares] : cells_) visit(cell);
  }

 private:
  static constexpr int kMap = -1;

  common::Pose2 T_map_key(int key) const {
    return key == kMap ? common::Pose2{} : T_map_keys_[static_cast<std::size_t>(key)];
  }

  void placeAll() {
    cells_.clear();
    for (std::size_t i = 0; i < squares_.size(); ++i) {
      Square& square = squares_[i];
      square.T_map_square = T_map_key(square.key) * square.T_key_square;
      const common::CellIndex middle = cellAt(square.T_map_square.position_m());
      for (int y = middle.y - 1; y <= middle.y + 1; ++y)
        for (int x = middle.x - 1; x <= middle.x + 1; ++x)
          if (covers(square, {x, y})) cells_[{x, y}].push_back(i);
    }
  }

  /// Half open, so that neighbouring squares do not both have a centre on the line between them.
  bool covers(const Square& square, common::CellIndex cell) const {
    const Eigen::Vector2d center_map_m((cell.x + 0.5) * side_m_, (cell.y + 0.5) * side_m_);
    const Eigen::Vector2d off_m = square.T_map_square.inverse() * center_map_m;
    return (off_m.array() >= -0.5 * side_m_).all() && (off_m.array() < 0.5 * side_m_).all();
  }

  double side_m_;
  std::vector<Square> squares_;  ///< In the order in which they were seen.
  std::map<common::CellIndex, std::vector<std::size_t>> cells_;
  std::vector<common::Pose2> T_map_keys_;
  std::uint64_t version_ = 0;
  int newest_ = kMap;
};

}  // namespace swiftlet::perception
