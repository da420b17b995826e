#include "common/sensor_event.hpp"

#include "common/rgbd_frame.hpp"

namespace swiftlet::common {

const Stamps& stampsOf(const SensorEvent& event) {
  return std::visit(
      [](const auto& e) -> const Stamps& {
        if constexpr (requires { e->stamps; }) {
          return e->stamps;
        } else {
          return e.stamps;
        }
      },
      event);
}

}  // namespace swiftlet::common
