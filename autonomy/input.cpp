#include "autonomy/input.hpp"

namespace swiftlet::autonomy {
namespace {

common::Time timeOfOne(const common::SensorEvent& event) { return common::stampsOf(event).arrived; }
common::Time timeOfOne(const CommandInput& command) { return command.taken; }
common::Time timeOfOne(const common::JobDelivery& delivery) { return delivery.delivered; }
common::Time timeOfOne(const Tick& tick) { return tick.now; }

}  // namespace

common::Time timeOf(const Input& input) {
  return std::visit([](const auto& one) { return timeOfOne(one); }, input);
}

}  // namespace swiftlet::autonomy
