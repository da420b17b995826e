// Conditions: leaves that ask the World and answer in the same tick. SUCCESS: it is so. FAILURE: it is not, or it is
// not known; the reason says which.
#pragma once

#include <cstdint>
#include <string>

#include "behaviors/flight_tick.hpp"
#include "behaviors/tree/leaf.hpp"
#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

class Condition : public tree::Leaf {
 public:
  using Leaf::Leaf;

 protected:
  /// Why it is not so; empty if it is.
  virtual std::string objection(const FlightTick& tick) const = 0;

 private:
  tree::Status act(tree::TickContext& context) final;
};

/// The battery has at most `share` of its charge left.
class IsBatteryLow final : public Condition {
 public:
  explicit IsBatteryLow(const tree::NodeSetup& setup) : Condition(setup), share_(setup, "share") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> share_;
};

/// The charge suffices to fly home and land, with `reserve_share` to spare.
class IsHomeReachable final : public Condition {
 public:
  explicit IsHomeReachable(const tree::NodeSetup& setup) : Condition(setup), reserve_share_(setup, "reserve_share") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> reserve_share_;
};

/// The position is unknown, or has drifted by more than `drift_m` since the laser last fixed it in every direction.
class IsLost final : public Condition {
 public:
  explicit IsLost(const tree::NodeSetup& setup) : Condition(setup), drift_m_(setup, "drift_m") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> drift_m_;
};

/// The operator holds the mission, or an emergency does.
class IsOperatorHolding final : public Condition {
 public:
  using Condition::Condition;
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
};

/// A person is nearer to the vehicle's centre than `distance_m`.
class IsPersonNear final : public Condition {
 public:
  explicit IsPersonNear(const tree::NodeSetup& setup) : Condition(setup), distance_m_(setup, "distance_m") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<double> distance_m_;
};

/// Explore has left no frontier open.
class IsExplored final : public Condition {
 public:
  using Condition::Condition;
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
};

/// The vehicle is within `tolerance_m` of `place`, and of its height if the place has one.
class IsAt final : public Condition {
 public:
  explicit IsAt(const tree::NodeSetup& setup)
      : Condition(setup), place_(setup, "place"), tolerance_m_(setup, "tolerance_m") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<tree::Point> place_;
  tree::Input<double> tolerance_m_;
};

/// At least `count` targets of that name are found.
class IsTargetFound final : public Condition {
 public:
  explicit IsTargetFound(const tree::NodeSetup& setup)
      : Condition(setup), name_(setup, "target"), count_(setup, "count") {}
  static tree::NodeManifest manifest();

 private:
  std::string objection(const FlightTick& tick) const override;
  tree::Input<std::string> name_;
  tree::Input<std::int64_t> count_;
};

}  // namespace swiftlet::behaviors
