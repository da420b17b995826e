// links: behaviors tree common
// Any bytes as a mission: read it, check it, and fly what is sound for a while with whatever answers the rest of the
// bytes give. Nothing may crash, hang or leak; a file is either sound or has a problem.
#include <cstdint>
#include <string>

#include "behaviors/mission.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/parser.hpp"
#include "common/check.hpp"
#include "tests/support/layers.hpp"

namespace {

using namespace swiftlet;

std::shared_ptr<const common::World> worldFrom(std::uint8_t bits) {
  test::Layers layers;
  layers.vehicle.flight_state = (bits & 1U) != 0 ? common::FlightState::kFlying : common::FlightState::kLanded;
  layers.vehicle.avoidance.retreating = (bits & 2U) != 0;
  layers.vehicle.home_map.x_m = (bits & 4U) != 0 ? 1.0 : 0.0;
  return std::make_shared<const common::World>(layers.world());
}

void fly(behaviors::Mission mission, const std::uint8_t* bytes, std::size_t size) {
  behaviors::Context context;
  std::uint64_t last_id = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint8_t bits = size == 0 ? 0 : bytes[i % size];
    context.now += common::Duration::fromMilliseconds(50);
    context.world = worldFrom(bits);
    context.hold = (bits & 8U) != 0;
    context.status.id = last_id;
    context.status.released = (bits & 16U) != 0;
    context.status.state = static_cast<common::IntentState>((bits >> 5U) % 3U);
    if (bits == 0xFF) context.commands.push_back({i, common::HomeCommand{}});
    if (bits == 0xFE && mission.letGo(context)) continue;
    mission.tick(context);
    if (context.intent) {
      SWIFTLET_CHECK(context.intent->id > 0);
      last_id = context.intent->id;
    }
    SWIFTLET_CHECK(context.commands.empty());
    context.events.clear();
    context.results.clear();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const behaviors::NodeTypes types = behaviors::missionNodes();
  const std::string text(reinterpret_cast<const char*>(data), size);
  tree::ParseOptions options;
  options.limits.nodes = 2'000;
  options.read_file = [&text](const std::string& path) -> std::optional<std::string> {
    return path.ends_with("self.xml") ? std::optional(text) : std::nullopt;
  };
  const tree::ParseResult parsed = tree::parseText(text, "fuzz.xml", *types, options);
  SWIFTLET_CHECK(parsed.tree.has_value() == parsed.problems.empty());
  // Files of other programs are read leniently, which finds no more problems.
  tree::ParseOptions lenient = options;
  lenient.lenient = true;
  SWIFTLET_CHECK(!parsed.tree || tree::parseText(text, "fuzz.xml", *types, lenient).tree);
  for (const tree::Problem& problem : parsed.problems) SWIFTLET_CHECK(!toString(problem).empty());
  if (!parsed.tree) return 0;
  behaviors::semanticProblems(*parsed.tree, {});
  // Only without includes can the same text be read without the reader above.
  if (text.find("<include") == std::string::npos)
    fly(behaviors::Mission::fromText(text, "fuzz.xml", types), data, size);
  return 0;
}
