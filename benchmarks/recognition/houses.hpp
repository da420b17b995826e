// Counts what the recognizer of houses finds in yards with a known house, and with one of another size.
#pragma once

#include <cstdint>

#include "tests/recognition/known_house_scene.hpp"

namespace swiftlet::benchmarks {

struct HouseRun {
  perception::KnownHouses houses = perception::KnownHouses::kHeldBack;
  std::uint64_t seed = 1, first = 0, looks = 100;
};

/// Prints the table of docs/recognition.md: looks ahead and down, of a camera of depths and of a stereo camera.
void countHouses(const HouseRun& run);

}  // namespace swiftlet::benchmarks
