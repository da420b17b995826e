// Configs as files: reading YAML over their defaults and printing them. What a Config is says common/config_fields.hpp.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config_fields.hpp"

namespace swiftlet::common::config {

/// Reads YAML over the values a config already has.
class YamlReader final : public Fields {
 public:
  /// Throws InputError when the file cannot be opened or is not YAML.
  static YamlReader fromFile(const std::string& file);
  /// `name` stands for the file in messages.
  static YamlReader fromText(const std::string& text, const std::string& name);
  ~YamlReader() override;
  YamlReader(YamlReader&&) noexcept;

  /// Throws InputError with every problem at once: unknown key (with "did you mean"), wrong type, out of bounds, failed
  /// validation, each with file, line and column. Keys that are not in the file keep their value; one whose value is
  /// out of its own bounds must be in the file.
  template <typename Config>
  void read(Config& config) {
    config.describe(*this);
    finish(relationProblems(config));
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
  void endSection(std::vector<std::string> problems) override;
  int beginList(std::string_view name, int count, std::string_view sentence) override;
  void beginItem(int index) override;
  void endList() override;

 private:
  struct Impl;
  explicit YamlReader(std::unique_ptr<Impl> impl);
  void finish(std::vector<std::string> problems);
  std::unique_ptr<Impl> impl_;
};

/// Prints a config as YAML that YamlReader reads back to the same values. The comment behind a value is its sentence
/// and its bounds.
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
  void endSection(std::vector<std::string> problems) override;
  int beginList(std::string_view name, int count, std::string_view sentence) override;
  void beginItem(int index) override;
  void endList() override;

 private:
  void line(std::string_view name, const std::string& value, std::string_view sentence);
  Comments comments_;
  std::string text_;
  int depth_ = 0;
  bool item_starts_ = false;  ///< The next line opens a list item and gets the dash.
};

/// The whole file read over the defaults of Config.
template <typename Config>
Config readFile(const std::string& file) {
  Config config;
  YamlReader::fromFile(file).read(config);
  return config;
}

}  // namespace swiftlet::common::config
