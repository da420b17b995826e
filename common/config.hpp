// Configs as files: reads YAML over their defaults, and prints them. common/config_fields.hpp defines a Config.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config_fields.hpp"
#include "common/error.hpp"

namespace swiftlet::common::config {

/// Reads YAML over the values a config already has.
class YamlReader final : public Fields {
 public:
  /// Throws InputError when the file cannot be opened or is not YAML.
  static YamlReader fromFile(const std::string& file);
  /// Messages show `name` as the file's name. Throws InputError when the text is not YAML.
  static YamlReader fromText(const std::string& text, const std::string& name);
  ~YamlReader() override;
  YamlReader(YamlReader&&) noexcept;

  /// Throws InputError with every problem at once: unknown key (with "did you mean"), wrong type, out of bounds, failed
  /// validation, each with file, line and column. A setting that is not in the file keeps its value; if that value is
  /// out of bounds, the missing key is a problem.
  template <typename Config>
  void read(Config& config) {
    config.describe(*this);
    finish(relationProblems(config));
  }

  /// As `read`, for files that other programs write as well: a key at the top that is not known is no mistake, unless
  /// it is a likely misspelling of one that the file lacks. Returns a note for each.
  template <typename Config>
  std::vector<Problem> readKnown(Config& config) {
    keepUnknownKeys();
    read(config);
    return unknownKeys();
  }

  /// Returns what became of an unknown key, by its path; nullopt if it never was a key. Call it before `read`.
  using WhatBecameOf = std::function<std::optional<std::string>(const std::string& path)>;
  void explainFormerKeys(WhatBecameOf what_became_of);

  /// Paths of the values that the file gives, in the order they were read: "limits.speed_m_s", "walkers[0].mode".
  const std::vector<std::string>& writtenKeys() const;
  /// Where the file gives the value with that path; without line and column if it does not.
  SourceLocation locationOf(const std::string& path) const;

  using Fields::choice;
  void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view sentence) override;
  void operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view sentence) override;
  void operator()(std::string_view name, bool& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::string& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds,
                  std::string_view sentence) override;
  void operator()(std::string_view name, std::vector<std::string>& value, std::string_view sentence) override;
  void choice(std::string_view name, int& value, const std::vector<std::string>& words,
              std::string_view sentence) override;

 protected:
  bool beginSection(std::string_view name, std::string_view sentence) override;
  void endSection(std::vector<Problem> problems) override;
  std::optional<int> beginList(std::string_view name, int count, std::string_view sentence) override;
  void beginItem(int index) override;
  void endList() override;

 private:
  struct Impl;
  explicit YamlReader(std::unique_ptr<Impl> impl);
  void finish(const std::vector<Problem>& problems);
  void keepUnknownKeys();
  std::vector<Problem> unknownKeys() const;
  std::unique_ptr<Impl> impl_;
};

/// Prints a config as YAML that YamlReader reads back to the same values. With Comments::kYes a comment behind each
/// value gives its sentence and its bounds.
class YamlPrinter final : public Fields {
 public:
  enum class Comments { kNo, kYes };
  explicit YamlPrinter(Comments comments) : comments_(comments) {}

  template <typename Config>
  std::string print(Config config) {
    config.describe(*this);
    return std::move(text_);
  }

  using Fields::choice;
  void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view sentence) override;
  void operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view sentence) override;
  void operator()(std::string_view name, bool& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::string& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds,
                  std::string_view sentence) override;
  void operator()(std::string_view name, std::vector<std::string>& value, std::string_view sentence) override;
  void choice(std::string_view name, int& value, const std::vector<std::string>& words,
              std::string_view sentence) override;

 protected:
  bool beginSection(std::string_view name, std::string_view sentence) override;
  void endSection(std::vector<Problem> problems) override;
  std::optional<int> beginList(std::string_view name, int count, std::string_view sentence) override;
  void beginItem(int index) override;
  void endList() override;

 private:
  void line(std::string_view name, const std::string& value, std::string_view sentence);
  Comments comments_;
  std::string text_;
  int depth_ = 0;
  bool item_starts_ = false;  ///< The next line opens a list item and gets the dash.
};

/// Reads a whole file over the defaults of Config. Throws InputError.
template <typename Config>
Config readFile(const std::string& file) {
  Config config;
  YamlReader::fromFile(file).read(config);
  return config;
}

}  // namespace swiftlet::common::config
