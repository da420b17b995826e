// The distance field against a search of all cells, fresh and after every change.
#include "planning/clearance/distance_field.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "common/random.hpp"

namespace swiftlet::planning {
namespace {

using common::RandomStream;
using common::VoxelIndex;

/// Occupied cells in a dense array, and the slow obvious distances between them.
class Cells {
 public:
  explicit Cells(VoxelIndex size) : size_(size), occupied_(static_cast<std::size_t>(size.x) * size.y * size.z, 0) {}

  std::uint8_t& at(VoxelIndex c) {
    return occupied_[(static_cast<std::size_t>(c.z) * size_.y + c.y) * size_.x + static_cast<std::size_t>(c.x)];
  }

  void fill(const CellBox& box, bool occupied) {
    for (int z = box.begin.z; z < box.end.z; ++z)
      for (int y = box.begin.y; y < box.end.y; ++y)
        for (int x = box.begin.x; x < box.end.x; ++x) at({x, y, z}) = occupied;
  }

  DistanceField::RowReader reader() {
    return [this](VoxelIndex first, std::span<std::uint8_t, DistanceField::kRow> row) {
      for (int i = 0; i < DistanceField::kRow; ++i) {
        const bool within = first.x + i < size_.x && first.y < size_.y && first.z < size_.z;
        row[static_cast<std::size_t>(i)] = within ? at({first.x + i, first.y, first.z}) : std::uint8_t{0};
      }
    };
  }

  int squared(VoxelIndex c, int beyond, std::optional<int> half_height) {
    int least = beyond;
    for (int z = 0; z < size_.z; ++z)
      for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) {
          if (!at({x, y, z})) continue;
          const int up = std::abs(z - c.z), across = (x - c.x) * (x - c.x) + (y - c.y) * (y - c.y);
          if (half_height && up > *half_height) continue;
          least = std::min(least, across + (half_height ? 0 : up * up));
        }
    return least;
  }

  CellBox randomBox(RandomStream& random, int most) const {
    const auto side = [&](int cells, int& begin, int& end) {
      begin = static_cast<int>(random.uniform(0, cells));
      end = std::min(cells, begin + 1 + static_cast<int>(random.uniform(0, most)));
    };
    CellBox box;
    side(size_.x, box.begin.x, box.end.x);
    side(size_.y, box.begin.y, box.end.y);
    side(size_.z, box.begin.z, box.end.z);
    return box;
  }

  VoxelIndex randomCell(RandomStream& random) const { return randomBox(random, 1).begin; }

 private:
  VoxelIndex size_;
  std::vector<std::uint8_t> occupied_;
};

struct Shape {
  VoxelIndex size;
  int reach;
  std::optional<int> half_height;
};

void staysExact(std::uint64_t seed, const Shape& shape) {
  RandomStream random(seed, "distance field");
  Cells cells(shape.size);
  DistanceField field(shape.size, shape.reach, shape.half_height);
  const DistanceField::RowReader read = cells.reader();
  const DistanceField empty = field;
  for (int step = 0; step < 12; ++step) {
    std::vector<CellBox> boxes;
    for (int i = 0; i < 1 + step % 3; ++i) {
      boxes.push_back(cells.randomBox(random, step == 0 ? 6 : 3));
      cells.fill(boxes.back(), random.chance(0.6));
    }
    const DistanceField before = field;
    const auto changed = field.update(boxes, read);
    for (int i = 0; i < 40; ++i) {
      const VoxelIndex c = cells.randomCell(random);
      RC_ASSERT(field.squared(c) == cells.squared(c, field.beyond(), shape.half_height));
      const bool told = std::any_of(changed.begin(), changed.end(), [&](const CellBox& box) {
        return c.x >= box.begin.x && c.x < box.end.x && c.y >= box.begin.y && c.y < box.end.y && c.z >= box.begin.z &&
               c.z < box.end.z;
      });
      RC_ASSERT(told || field.squared(c) == before.squared(c));
      RC_ASSERT(empty.squared(c) == empty.beyond());  // A copy is not written to.
    }
  }
}

RC_GTEST_PROP(DistanceField, OfAPlaneIsExactAfterEveryChange, (std::uint64_t seed)) {
  staysExact(seed, {{150, 1, 170}, 20, std::nullopt});
}

RC_GTEST_PROP(DistanceField, OfASpaceIsExactAfterEveryChange, (std::uint64_t seed)) {
  staysExact(seed, {{70, 30, 26}, 12, std::nullopt});
}

RC_GTEST_PROP(DistanceField, OfAHullCountsWhatItMeetsAtItsHeight, (std::uint64_t seed)) {
  staysExact(seed, {{70, 30, 26}, 12, 2});
}

TEST(DistanceField, ReachesAsFarAsIsAllowed) {
  const int reach = DistanceField::kMostReach;
  Cells cells({300, 1, 300});
  cells.at({3, 0, 4}) = 1;
  DistanceField field({300, 1, 300}, reach);
  field.update(std::vector<CellBox>{{{0, 0, 0}, {300, 1, 300}}}, cells.reader());
  EXPECT_EQ(field.squared({3 + reach, 0, 4}), reach * reach);
  EXPECT_EQ(field.squared({3, 0, 4 + reach}), reach * reach);
  EXPECT_EQ(field.squared({3 + reach + 1, 0, 4}), field.beyond());
  EXPECT_EQ(field.squared({3 + reach, 0, 4 + 90}), field.beyond());
  EXPECT_EQ(field.squared({299, 0, 299}), field.beyond());
}

TEST(DistanceField, TellsNothingWhereNothingChanged) {
  Cells cells({64, 1, 64});
  cells.fill({{5, 0, 5}, {9, 1, 9}}, true);
  DistanceField field({64, 1, 64}, 10);
  const std::vector<CellBox> all{{{0, 0, 0}, {64, 1, 64}}};
  EXPECT_FALSE(field.update(all, cells.reader()).empty());
  EXPECT_TRUE(field.update(all, cells.reader()).empty());
  EXPECT_TRUE(field.update(std::vector<CellBox>{{{-9, 0, 70}, {-3, 1, 90}}}, cells.reader()).empty());
}

}  // namespace
}  // namespace swiftlet::planning
