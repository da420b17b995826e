// The content of a nature's file: keys of a scenario, each with a value or with a range that a seed draws from. A file
// that is based on another nature has the keys of that one, too.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "simulation/nature_range.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::simulation {

/// Const calls are safe from several threads.
class NatureRanges {
 public:
  /// `given` is the text; `file` stands for the file in messages, and a nature that it is based on is searched for
  /// beside it. Throws common::InputError with file, line and key: not YAML, unknown keys, keys that describe the
  /// flight and not the plant (`world`, `walkers`), ranges that are upside down, values out of bounds, a base that does
  /// not exist or is based on this file.
  NatureRanges(const std::string& given, const std::string& file) : NatureRanges(given, file, {}) {}

  /// The file of a nature: config/nature/NAME.yaml, or a name with an ending, which is searched for in `folder` first.
  /// Throws common::InputError if there is none.
  static std::filesystem::path fileOf(const std::filesystem::path& name, const std::filesystem::path& folder);
  /// Its text. Throws common::InputError if it cannot be read.
  static std::string textOf(const std::filesystem::path& file);

  /// Nothing is drawn and nothing is set.
  bool empty() const { return entries_.empty(); }
  double leastThrustOverWeight() const { return least_thrust_over_weight_; }
  const std::string& file() const { return file_; }

  bool has(const std::string& key) const;

  /// Replaces the range of a key that has one; other keys stay as they are.
  void narrow(const std::string& key, double low, double high);

  /// The range of a key; both ends are equal if it is fixed. nullopt for keys that the file does not
  /// have, or that are not numbers.
  std::optional<NatureRange> rangeOf(const std::string& key) const;

  /// A number within [low, high) for the key, "quadrotor.mass_share".
  using Choose = std::function<double(const std::string& key, double low, double high)>;

  /// Sets every key in the scenario, but for those in `written` and those in a section that is in `written`. A key that
  /// holds a whole number gets each of low, low + 1, ... high with the same chance.
  void apply(Scenario& scenario, const std::vector<std::string>& written, const Choose& choose) const;

  /// A nature's file with the same keys, those of its base too, and the values that the scenario has.
  std::string valuesIn(const Scenario& scenario) const;

 private:
  struct Entry {
    std::string key;
    std::string value;  ///< As written; empty for a range.
    double low = 0.0;
    double high = 0.0;
    bool whole = false;    ///< It draws whole numbers.
    std::size_t from = 0;  ///< Where the range stands in the text.
    std::size_t size = 0;

    bool isRange() const { return value.empty(); }
    std::string drawn(const Choose& choose) const;
  };
  /// Where the file names the nature that it is based on; empty without one.
  struct Base {
    std::string name;
    common::SourceLocation place;
  };
  class Reader;
  /// `chain` are the files that are being read, each based on the next.
  NatureRanges(const std::string& given, const std::string& file, std::vector<std::string> chain);
  void readBase(const Base& base, std::vector<std::string> chain);
  void check(const std::string& text, const std::vector<Entry>& own);
  void merge(std::vector<Entry> own);
  static std::string inPlaceOf(const Entry& entry, std::string_view text, const std::string& number);

  std::string file_;
  std::vector<Entry> entries_;
  double least_thrust_over_weight_ = 1.05;
};

}  // namespace swiftlet::simulation
