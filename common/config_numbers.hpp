// The numbers among the settings of a configuration, with their keys: for code that changes settings by name.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config.hpp"

namespace swiftlet::common::config {

/// Calls a function for every number outside of lists; the function may change it.
class NumberVisitor final : public Fields {
 public:
  /// `key` begins with the sections: "sensors.imu.noise". A `whole` number is rounded towards 0.
  using Visit = std::function<void(const std::string& key, double& value, const Bounds& bounds, bool whole)>;
  explicit NumberVisitor(Visit visit) : visit_(std::move(visit)) {}

  using Fields::choice;
  void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view) override {
    visit_(prefix_ + std::string(name), value, bounds, false);
  }
  void operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view) override {
    double number = value;
    visit_(prefix_ + std::string(name), number, bounds, true);
    value = static_cast<int>(number);
  }
  void operator()(std::string_view, bool&, std::string_view) override {}
  void operator()(std::string_view, std::string&, std::string_view) override {}
  void operator()(std::string_view, std::vector<double>&, const Bounds&, std::string_view) override {}
  void operator()(std::string_view, std::vector<std::string>&, std::string_view) override {}
  void choice(std::string_view, int&, const std::vector<std::string>&, std::string_view) override {}

 protected:
  bool beginSection(std::string_view name, std::string_view) override {
    lengths_.push_back(prefix_.size());
    prefix_ += std::string(name) + ".";
    return true;
  }
  void endSection(std::vector<Problem>) override {
    prefix_.resize(lengths_.back());
    lengths_.pop_back();
  }
  std::optional<int> beginList(std::string_view, int, std::string_view) override { return 0; }
  void beginItem(int) override {}
  void endList() override {}

 private:
  Visit visit_;
  std::string prefix_;                ///< Of the open sections: "sensors.imu.".
  std::vector<std::size_t> lengths_;  ///< Of the prefix before each open section.
};

}  // namespace swiftlet::common::config
