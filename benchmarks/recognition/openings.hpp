// Counts what the recognizers of openings find in rooms of random houses.
#pragma once

#include <cstdint>

#include "tests/recognition/house_scene.hpp"

namespace swiftlet::benchmarks {

struct OpeningRun {
  perception::Houses houses = perception::Houses::kHeldBack;
  std::uint64_t seed = 1, first = 0, rooms = 100;
  bool verbose = false;  ///< Names each error.
};

/// Prints the table of docs/recognition.md.
void countOpenings(const OpeningRun& run);
/// The same of what is confirmed after looks from several places.
void followOpenings(const OpeningRun& run);

}  // namespace swiftlet::benchmarks
