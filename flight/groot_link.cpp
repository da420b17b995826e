#include "flight/groot_link.hpp"

#include "common/world.hpp"
#include "common/world/mission_layer.hpp"

namespace swiftlet::flight {
namespace {

/// How soon the thread sees that it is to end, and how old a status may be.
constexpr int kGrootPatience_ms = 50;

/// The element <TreeNodesModel> of the palette.
std::string grootModels(const tree::Registry& types) {
  const std::string palette = tree::writeTreeNodesModel(types);
  const std::string tail = "</TreeNodesModel>";
  const std::size_t begin = palette.find("<TreeNodesModel>"), end = palette.rfind(tail);
  return palette.substr(begin, end + tail.size() - begin) + "\n";
}

}  // namespace

GrootLink::GrootLink(const std::string& address, int port, const tree::Registry& types)
    : server_(address, port),
      thread_([this, models = grootModels(types)](const std::stop_token& stop) { answer(models, stop); }) {}

void GrootLink::answer(const std::string& models, const std::stop_token& stop) {
  interfaces::GrootMonitor monitor(models);
  std::uint64_t seen = 0;
  while (!stop.stop_requested()) {
    if (const std::uint64_t newest = world_.sequence(); newest != seen) {
      seen = newest;
      const auto world = world_.read();
      const common::MissionStatus& mission = world->mission->status;
      monitor.update(mission.name, mission.tree, world->stamp);
    }
    server_.serve(monitor, kGrootPatience_ms);
  }
}

}  // namespace swiftlet::flight
