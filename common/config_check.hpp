// Checks a Config that was made in code, in the same way as YamlReader checks one from a file.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config_fields.hpp"

namespace swiftlet::common::config {

/// Checks every number against its bounds, and the relations between fields.
class Validator final : public Fields {
 public:
  /// All problems, for example "mount.x_m: nan is not within -2 and 2"; empty when the config is valid.
  template <typename Config>
  std::vector<Problem> problems(Config config) {
    config.describe(*this);
    take(relationProblems(config));
    return std::move(problems_);
  }

  using Fields::choice;
  void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view sentence) override;
  void operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view sentence) override;
  void operator()(std::string_view, bool&, std::string_view) override {}
  void operator()(std::string_view, std::string&, std::string_view) override {}
  void operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds,
                  std::string_view sentence) override;
  void operator()(std::string_view, std::vector<std::string>&, std::string_view) override {}
  void choice(std::string_view name, int& value, const std::vector<std::string>& words,
              std::string_view sentence) override;

 protected:
  bool beginSection(std::string_view name, std::string_view sentence) override;
  void endSection(std::vector<Problem> problems) override;
  std::optional<int> beginList(std::string_view name, int count, std::string_view sentence) override;
  void beginItem(int index) override;
  void endList() override;

 private:
  void check(std::string_view name, double value, const Bounds& bounds);
  void take(std::vector<Problem> problems);

  std::vector<std::string> prefixes_;  ///< One for each open section: "mount.".
  std::vector<std::string> lists_;
  std::vector<Problem> problems_;
};

template <typename Config>
std::vector<Problem> problemsOf(const Config& config) {
  return Validator().problems(config);
}

}  // namespace swiftlet::common::config
