#include "mapping3d/voxels/free_surface.hpp"

#include <algorithm>

namespace swiftlet::mapping3d {
namespace {

using Word = BitVolume::Word;

struct FaceRectangle {
  int column_begin, column_end, row_begin, row_end;
};

/// Merges the faces of one plane, which come row by row.
class RectangleMerger {
 public:
  explicit RectangleMerger(std::vector<FaceRectangle>& done) : done_(done) {}

  void add(int row, std::span<const Word> faces) {
    next_.clear();
    auto open = open_.begin();
    forEachRun(faces, [&](int begin, int end) {
      for (; open != open_.end() && open->column_begin < begin; ++open) done_.push_back(*open);
      if (open != open_.end() && open->column_begin == begin && open->column_end == end)
        next_.push_back({begin, end, (open++)->row_begin, row + 1});
      else
        next_.push_back({begin, end, row, row + 1});
    });
    done_.insert(done_.end(), open, open_.end());
    open_.swap(next_);
  }
  void finish() {
    done_.insert(done_.end(), open_.begin(), open_.end());
    open_.clear();
  }

 private:
  std::vector<FaceRectangle>& done_;
  std::vector<FaceRectangle> open_, next_;  ///< That end in the last row, in ascending order.
};

/// Axes of the space: of the plane's normal, of its columns and of its rows.
struct PlaneAxes {
  int normal, column, row;
};

class SurfaceMaker {
 public:
  SurfaceMaker(const FreeSpace& space, std::size_t most) : space_(space), most_(most) {}

  /// rowOf(plane, row) is the row of voxels behind that row of the plane, empty beyond the box.
  template <typename RowOf>
  void addPlanes(PlaneAxes axes, int planes, int rows, const RowOf& rowOf) {
    for (const int side : {-1, 1}) {
      for (int plane = 0; plane < planes && quads_.size() <= most_; ++plane) {
        rectangles_.clear();
        RectangleMerger merger(rectangles_);
        for (int row = 0; row < rows; ++row) {
          const std::span<const Word> here = rowOf(plane, row), beyond = rowOf(plane + side, row);
          faces_.assign(here.begin(), here.end());
          for (std::size_t i = 0; i < beyond.size(); ++i) faces_[i] &= ~beyond[i];
          merger.add(row, faces_);
        }
        merger.finish();
        for (const FaceRectangle& rectangle : rectangles_) addQuad(axes, side, side < 0 ? plane : plane + 1, rectangle);
      }
    }
  }

  std::vector<Quad> take() { return std::move(quads_); }

 private:
  void addQuad(PlaneAxes axes, int side, int plane, const FaceRectangle& r) {
    const auto corner = [&](int column, int row) {
      Eigen::Vector3d at;
      at[axes.normal] = plane;
      at[axes.column] = column;
      at[axes.row] = row;
      return Eigen::Vector3f((space_.corner_m + at.cwiseProduct(space_.voxel_m)).cast<float>());
    };
    Quad quad{corner(r.column_begin, r.row_begin), corner(r.column_end, r.row_begin), corner(r.column_end, r.row_end),
              corner(r.column_begin, r.row_end)};
    // Column, row and normal are right-handed if they are an even permutation of x, y and z.
    const bool even = (axes.column + 1) % 3 == axes.row;
    if (even == (side > 0)) std::swap(quad[1], quad[3]);
    quads_.push_back(quad);
  }

  const FreeSpace& space_;
  std::size_t most_;
  std::vector<Quad> quads_;
  std::vector<FaceRectangle> rectangles_;
  std::vector<Word> faces_;
};

}  // namespace

std::vector<Quad> surfaceOf(const FreeSpace& space, std::size_t most) {
  const BitVolume& free = space.free;
  SurfaceMaker maker(space, most);
  const auto rowOf = [](const BitVolume& volume, int y, int z) {
    return volume.contains(0, y, z) ? volume.row(y, z) : std::span<const Word>();
  };
  maker.addPlanes({2, 0, 1}, free.height(), free.depth(), [&](int z, int y) { return rowOf(free, y, z); });
  maker.addPlanes({1, 0, 2}, free.depth(), free.height(), [&](int y, int z) { return rowOf(free, y, z); });
  const BitVolume turned = free.transposed();
  maker.addPlanes({0, 1, 2}, free.width(), free.height(), [&](int x, int z) { return rowOf(turned, x, z); });
  return maker.take();
}

}  // namespace swiftlet::mapping3d
