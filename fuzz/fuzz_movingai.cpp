// links: interfaces common
// Any bytes as a grid and as path problems of the Moving AI benchmarks: refused as InputError, or within the map.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz/refused_or.hpp"
#include "interfaces/files/movingai.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::refusedOr([&] {
    const interfaces::OctileMap map = interfaces::parseOctileMap(text, "fuzz.map", 1.0);
    if (common::knownExtent(map.grid) != common::CellRect{{0, 0}, {map.width, map.height}}) std::abort();
  });
  fuzz::refusedOr([&] {
    for (const interfaces::GridProblem& problem : interfaces::parseGridProblems(text, "fuzz.scen", 49, 49))
      if (problem.start_column < 0 || problem.start_column >= 49 || problem.goal_row < 0 || problem.goal_row >= 49)
        std::abort();
  });
  return 0;
}
