// Configuration: each class has a `struct Config` whose `describe` gives every setting one line: its name, which ends
// in the unit, its bounds and a sentence that can be read alone. The default is the member's. Reading YAML, checking
// bounds, printing the effective values and the reference page all follow from that line.
//
//   struct Config {
//     double max_speed_m_s = 1.0;
//     double slow_speed_m_s = 0.3;
//     Matcher::Config matcher;
//     void describe(common::config::Fields& fields) {
//       fields("max_speed_m_s", max_speed_m_s, {0.05, 20}, "Greatest horizontal speed.");
//       fields("slow_speed_m_s", slow_speed_m_s, {0.05, 20}, "Horizontal speed near a goal.");
//       fields.section("matcher", matcher, "Scan matching.");
//     }
//     std::vector<Problem> validate() const {  // Only when fields depend on each other, see common/validation.hpp.
//       return Validation().atMost("slow_speed_m_s", slow_speed_m_s, "max_speed_m_s", max_speed_m_s).problems();
//     }
//   };
//
// Constructors require a Config within its bounds and do not change it. common/config_check.hpp checks a Config that is
// made in code.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"

namespace swiftlet::common::config {

/// The range of numbers that a field may have. Both ends are included, unless `low_excluded`. NaN is always outside.
struct Bounds {
  constexpr Bounds(double low_in, double high_in) : low(low_in), high(high_in) {}

  bool contain(double value) const;
  /// For people: "0.05 to 20", "above 0", "at least 3"; empty when every finite number is allowed.
  std::string text() const;
  /// What is wrong with a value that is not contained: "25 is not within 0.05 and 20".
  Message problem(double value) const;

  double low = 0.0;
  double high = 0.0;
  bool low_excluded = false;
};

/// Infinity is allowed.
constexpr Bounds atLeast(double low) { return {low, std::numeric_limits<double>::infinity()}; }
constexpr Bounds above(double low) {
  Bounds bounds = atLeast(low);
  bounds.low_excluded = true;
  return bounds;
}
/// Above 0; infinity is allowed.
inline constexpr Bounds kPositive = above(0.0);
inline constexpr Bounds kFinite{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

/// The visitor that `describe` calls for each field. It may read the field's value, replace it or leave it as it is.
class Fields {
 public:
  virtual ~Fields() = default;
  virtual void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, bool& value, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, std::string& value, std::string_view sentence) = 0;
  /// The bounds apply to each element.
  virtual void operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds,
                          std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, std::vector<std::string>& value, std::string_view sentence) = 0;
  /// One of a fixed set of words; `value` is the index into `words`.
  virtual void choice(std::string_view name, int& value, const std::vector<std::string>& words,
                      std::string_view sentence) = 0;

  /// An enumeration whose enumerators count from 0 in the order of `words`.
  template <typename Enum>
  void choice(std::string_view name, Enum& value, const std::vector<std::string>& words, std::string_view sentence) {
    int index = static_cast<int>(value);
    choice(name, index, words, sentence);
    value = static_cast<Enum>(index);
  }

  /// A nested Config; its problems are reported with the section's name.
  template <typename Config>
  void section(std::string_view name, Config& config, std::string_view sentence) {
    if (!beginSection(name, sentence)) return;
    config.describe(*this);
    endSection(relationProblems(config));
  }

  /// A sequence of Configs. A file that gives one replaces all of it: the items that were there before are dropped.
  template <typename Config>
  void list(std::string_view name, std::vector<Config>& configs, std::string_view sentence) {
    const std::optional<int> given = beginList(name, static_cast<int>(configs.size()), sentence);
    if (given) configs.assign(static_cast<std::size_t>(*given), Config());
    for (std::size_t i = 0; i < configs.size(); ++i) {
      beginItem(static_cast<int>(i));
      configs[i].describe(*this);
      endSection(relationProblems(configs[i]));
    }
    endList();
  }

 protected:
  /// The problems between fields of a Config; most Configs have no such relations and no `validate`.
  template <typename Config>
  static std::vector<Problem> relationProblems(const Config& config) {
    if constexpr (requires { config.validate(); })
      return config.validate();
    else
      return {};
  }

  /// False if the section is to be skipped.
  virtual bool beginSection(std::string_view name, std::string_view sentence) = 0;
  virtual void endSection(std::vector<Problem> problems) = 0;
  /// The number of items of a list that replaces the one with `count` items, each of which begins with
  /// its defaults; nullopt: the present list is described.
  virtual std::optional<int> beginList(std::string_view name, int count, std::string_view sentence) = 0;
  virtual void beginItem(int index) = 0;
  virtual void endList() = 0;
};

}  // namespace swiftlet::common::config
