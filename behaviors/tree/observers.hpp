// Several observers as one.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "behaviors/tree/node.hpp"

namespace swiftlet::tree {

/// Notifies each of them, in order. They must outlive it.
class Observers final : public Observer {
 public:
  explicit Observers(std::vector<Observer*> observers) : observers_(std::move(observers)) {}

  void onStatus(const Node& node, Status from, Status to) override {
    for (Observer* observer : observers_) observer->onStatus(node, from, to);
  }
  void onSwitch(const Switch& change) override {
    for (Observer* observer : observers_) observer->onSwitch(change);
  }
  void onFailure(const Node& node, std::string_view reason) override {
    for (Observer* observer : observers_) observer->onFailure(node, reason);
  }

 private:
  std::vector<Observer*> observers_;
};

}  // namespace swiftlet::tree
