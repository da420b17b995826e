// A flight of one behaviour in a world with recognized objects, tick by tick; the test plays the autonomy.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/world/objects_layer.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {

class ObjectsFlight {
 public:
  explicit ObjectsFlight(const std::string& inside) : flight(inside) {}
  explicit ObjectsFlight(Mission mission) : flight(std::move(mission)) {}

  ObjectsFlight& sees(std::vector<common::RecognizedObject> objects) {
    objects_ = std::move(objects);
    return *this;
  }
  std::string tick() {
    flight.change([this](test::Layers& layers) {
      layers.objects = std::make_shared<const common::ObjectsLayer>(common::ObjectsLayer{objects_});
    });
    return flight.tick();
  }
  const common::GoToIntent* goTo() const {
    return flight.context.intent ? std::get_if<common::GoToIntent>(&flight.context.intent->kind) : nullptr;
  }
  /// The places that it flies to, each of which it reaches, until the mission ends or the intent is another one.
  std::vector<common::GoToIntent> flyViews(int most_ticks) {
    std::vector<common::GoToIntent> views;
    std::uint64_t last = 0;
    for (int i = 0; i < most_ticks; ++i) {
      tick();
      if (flight.last.state != common::MissionState::kRunning || !flight.context.intent) break;
      const common::GoToIntent* go_to = goTo();
      if (go_to == nullptr) {
        if (!std::holds_alternative<common::HoldIntent>(flight.context.intent->kind)) break;
        flight.stops();
        continue;
      }
      if (flight.context.intent->id != last) views.push_back(*go_to);
      last = flight.context.intent->id;
      flight.at(go_to->goal_map_m.x(), go_to->goal_map_m.y()).succeeds();
    }
    return views;
  }

  Flight flight;

 private:
  std::vector<common::RecognizedObject> objects_;
};

}  // namespace swiftlet::behaviors::testing
