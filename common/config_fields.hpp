// Configuration: each class has a `struct Config` whose `describe` gives every setting one line: its name, which ends
// in the unit, its bounds and a sentence that stands alone. The default is the member's. Reading YAML, refusing what is
// out of bounds, printing the effective values and the reference page all follow from that line.
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
//     std::vector<std::string> validate() const {  // Only when fields depend on each other, see common/validation.hpp.
//       return Validation().atMost("slow_speed_m_s", slow_speed_m_s, "max_speed_m_s", max_speed_m_s).problems();
//     }
//   };
//
// Constructors take a Config that is within its bounds and change nothing of it. One that is made in code is checked by
// common/config_check.hpp.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::common::config {

/// Which numbers a field may have, both ends included. NaN is never within.
struct Bounds {
  constexpr Bounds(double low_in, double high_in) : low(low_in), high(high_in) {}

  bool contain(double value) const;
  /// For people: "0.05 to 20", "above 0", "at least 3"; empty when every finite number will do.
  std::string text() const;
  /// What is wrong with a value that is not contained: "25 is not within 0.05 and 20".
  std::string problem(double value) const;

  double low = 0.0;
  double high = 0.0;
  bool low_excluded = false;
};

/// Infinity is at least `low`, too.
constexpr Bounds atLeast(double low) { return {low, std::numeric_limits<double>::infinity()}; }
constexpr Bounds above(double low) {
  Bounds bounds = atLeast(low);
  bounds.low_excluded = true;
  return bounds;
}
/// More than 0; infinity is positive, too.
inline constexpr Bounds kPositive = above(0.0);
inline constexpr Bounds kFinite{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

/// What `describe` is handed. A field's value may be read, replaced or left as it is.
class Fields {
 public:
  virtual ~Fields() = default;
  virtual void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, bool& value, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, std::string& value, std::string_view sentence) = 0;
  /// The bounds are those of each element.
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

  /// A nested Config; what is wrong with it is told with the section's name.
  template <typename Config>
  void section(std::string_view name, Config& config, std::string_view sentence) {
    if (!beginSection(name, sentence)) return;
    config.describe(*this);
    endSection(relationProblems(config));
  }

  /// A sequence of Configs.
  template <typename Config>
  void list(std::string_view name, std::vector<Config>& configs, std::string_view sentence) {
    const int count = beginList(name, static_cast<int>(configs.size()), sentence);
    configs.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      beginItem(i);
      configs[static_cast<std::size_t>(i)].describe(*this);
      endSection(relationProblems(configs[static_cast<std::size_t>(i)]));
    }
    endList();
  }

 protected:
  /// What is wrong between the fields of a Config; most have no such relations and no `validate`.
  template <typename Config>
  static std::vector<std::string> relationProblems(const Config& config) {
    if constexpr (requires { config.validate(); })
      return config.validate();
    else
      return {};
  }

  /// False: the section is passed over.
  virtual bool beginSection(std::string_view name, std::string_view sentence) = 0;
  virtual void endSection(std::vector<std::string> problems) = 0;
  /// The number of items to describe, given how many there are.
  virtual int beginList(std::string_view name, int count, std::string_view sentence) = 0;
  virtual void beginItem(int index) = 0;
  virtual void endList() = 0;
};

}  // namespace swiftlet::common::config
