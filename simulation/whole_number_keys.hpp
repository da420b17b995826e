// The keys of a config whose values are whole numbers.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config_fields.hpp"

namespace swiftlet::simulation {

/// Keys inside of lists are left out.
class WholeNumberKeys final : public common::config::Fields {
 public:
  template <typename Config>
  std::set<std::string> of(Config config) {
    config.describe(*this);
    return std::move(keys_);
  }

  using Fields::choice;
  void operator()(std::string_view, double&, const common::config::Bounds&, std::string_view) override {}
  void operator()(std::string_view name, int&, const common::config::Bounds&, std::string_view) override {
    keys_.insert(prefix_ + std::string(name));
  }
  void operator()(std::string_view, bool&, std::string_view) override {}
  void operator()(std::string_view, std::string&, std::string_view) override {}
  void operator()(std::string_view, std::vector<double>&, const common::config::Bounds&, std::string_view) override {}
  void operator()(std::string_view, std::vector<std::string>&, std::string_view) override {}
  void choice(std::string_view, int&, const std::vector<std::string>&, std::string_view) override {}

 protected:
  bool beginSection(std::string_view name, std::string_view) override {
    lengths_.push_back(prefix_.size());
    prefix_ += std::string(name) + ".";
    return true;
  }
  void endSection(std::vector<std::string>) override {
    prefix_.resize(lengths_.back());
    lengths_.pop_back();
  }
  int beginList(std::string_view, int, std::string_view) override { return 0; }
  void beginItem(int) override {}
  void endList() override {}

 private:
  std::string prefix_;                ///< Of the open sections: "sensors.imu.".
  std::vector<std::size_t> lengths_;  ///< Of the prefix before each open section.
  std::set<std::string> keys_;
};

}  // namespace swiftlet::simulation
