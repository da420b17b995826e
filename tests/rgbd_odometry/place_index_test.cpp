// The inverted index of binary words beside the comparison of all descriptors with each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "common/random.hpp"
#include "mapping3d/odometry/place_index.hpp"

namespace swiftlet::mapping3d {
namespace {

using Points = std::vector<DescribedPoint>;

constexpr std::size_t kPoints = 60;

Points randomPoints(std::uint64_t seed) {
  common::RandomStream random(seed, "descriptors");
  Points points(kPoints);
  for (DescribedPoint& point : points)
    for (std::uint64_t& bits : point.descriptor.bits)
      for (int bit = 0; bit < 64; ++bit) bits |= std::uint64_t{random.uniform() < 0.5} << bit;
  return points;
}

/// The same corners seen again: a part of them, each with some bits changed.
Points seenAgain(Points points, double part, int changed_bits, std::uint64_t seed) {
  common::RandomStream random(seed, "seen again");
  const Points others = randomPoints(seed + 1000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (random.uniform() > part) points[i] = others[i];
    for (int k = 0; k < changed_bits; ++k) {
      const auto bit = static_cast<std::size_t>(256.0 * random.uniform());
      points[i].descriptor.bits[bit / 64] ^= std::uint64_t{1} << (bit % 64);
    }
  }
  return points;
}

PlaceIndex indexOf(const std::vector<Points>& places) {
  PlaceIndex index;
  for (std::size_t i = 0; i < places.size(); ++i) index.add(i, places[i]);
  return index;
}

std::vector<Points> randomPlaces(std::size_t count) {
  std::vector<Points> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back(randomPoints(i));
  return places;
}

TEST(PlaceIndex, FindsTheOneOf200PlacesThatIsSeenAgain) {
  const std::vector<Points> places = randomPlaces(200);
  const PlaceIndex index = indexOf(places);
  for (std::size_t i = 0; i < places.size(); i += 7) {
    // A third of the corners is seen again, with 30 of 256 bits changed.
    const auto found = index.similar(seenAgain(places[i], 0.34, 30, i), 3);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found.front(), i);
  }
}

TEST(PlaceIndex, WhatWasRemovedIsNotFound) {
  const std::vector<Points> places = randomPlaces(20);
  PlaceIndex index = indexOf(places);
  index.remove(4, places[4]);
  const auto found = index.similar(places[4], 20);
  EXPECT_THAT(found, testing::Not(testing::Contains(4u)));
  index.add(20, places[4]);
  EXPECT_EQ(index.similar(places[4], 1).front(), 20u);
}

TEST(PlaceIndex, KnowsNothingBeforeItsFirstPlace) { EXPECT_TRUE(PlaceIndex().similar(randomPoints(1), 5).empty()); }

}  // namespace
}  // namespace swiftlet::mapping3d
