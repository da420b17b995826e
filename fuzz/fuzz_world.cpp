// links: simulation common
// Any bytes as a world, with the same bytes as a model it may include as model://self: refused as InputError, or
// triangles that are finite and whose indices are sound.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "fuzz/scratch.hpp"
#include "simulation/world_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::filesystem::create_directories(fuzz::scratch() / "models/self");
  fuzz::put("models/self/model.config", "<model><name>self</name><sdf version='1.9'>model.sdf</sdf></model>");
  fuzz::put("models/self/model.sdf", bytes);
  try {
    const simulation::WorldModel world = simulation::loadWorld(fuzz::put("fuzz.sdf", bytes));
    if (world.shapes.empty()) std::abort();
    for (const simulation::Shape& shape : world.shapes) {
      for (const auto& vertex : shape.vertices_world_m)
        if (!vertex.allFinite()) std::abort();
      for (const auto& triangle : shape.triangles)
        for (const std::uint32_t index : triangle)
          if (index >= shape.vertices_world_m.size()) std::abort();
    }
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}
