// links: control common
// One step of each controller, and the whole tick of the flight controller around it, in a hover.
#include <benchmark/benchmark.h>

#include "common/gravity.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::control {
namespace {

VehicleModel sheetModel() {
  const common::VehicleConfig sheet;
  VehicleModel model;
  model.vehicle = sheet.name;
  model.forward.gain = common::kGravity_m_s2;
  model.left.gain = -common::kGravity_m_s2;
  model.forward.lag_s = model.left.lag_s = 0.2;
  model.up = {.gain = common::kGravity_m_s2, .offset = -common::kGravity_m_s2};
  model.yaw.gain = 1.0;
  return model;
}

void BM_Step(benchmark::State& state) {
  const auto kind = static_cast<ControllerKind>(state.range(0));
  const common::VehicleConfig vehicle;
  const VehicleModel model = sheetModel();
  ControllerChoiceConfig choice;
  choice.kind = kind;
  SwitchedController controller(choice, {}, vehicle, &model);
  ControlInput input;
  input.acceleration_odom_m_s2 = Eigen::Vector3d(0.1, 0.0, 0.0);
  input.reference.position_odom_m = {0.1, 0.0, 1.0};
  input.state.T_odom_body.position_m.z() = 1.0;
  for (auto _ : state) {
    input.now += common::kControlPeriod;
    benchmark::DoNotOptimize(controller.tick(input, 12.0));
  }
  state.SetLabel(toString(kind));
}
BENCHMARK(BM_Step)->DenseRange(0, kControllerKinds - 1);

}  // namespace
}  // namespace swiftlet::control
