// Configuration: each class has a `struct Config` whose `describe` names every field once, with a sentence; reading
// YAML, refusing unknown keys, printing the effective values and documenting them all follow from that one list.
//
//   struct Config {
//     double max_speed_m_s = 1.0;
//     Matcher::Config matcher;
//     void describe(config::Fields& fields) {
//       fields("max_speed_m_s", max_speed_m_s, "Greatest horizontal speed.");
//       fields.section("matcher", matcher, "Scan matching.");
//     }
//     std::vector<std::string> validate() const;   // every problem: "max_speed_m_s: 0 is not positive"
//   };
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swiftlet::common::config {

/// What `describe` is handed. Units are in the names.
class Fields {
 public:
  virtual ~Fields() = default;
  virtual void operator()(std::string_view name, double& value, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, int& value, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, bool& value, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, std::string& value, std::string_view sentence) = 0;
  virtual void operator()(std::string_view name, std::vector<double>& value, std::string_view sentence) = 0;
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

  /// A nested Config; its own problems are prefixed by the section's name.
  template <typename Config>
  void section(std::string_view name, Config& config, std::string_view sentence) {
    if (!beginSection(name, sentence)) return;
    config.describe(*this);
    endSection(config.validate());
  }

  /// A sequence of Configs.
  template <typename Config>
  void list(std::string_view name, std::vector<Config>& configs, std::string_view sentence) {
    const int count = beginList(name, static_cast<int>(configs.size()), sentence);
    configs.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      beginItem(i);
      configs[static_cast<std::size_t>(i)].describe(*this);
      endSection(configs[static_cast<std::size_t>(i)].validate());
    }
    endList();
  }

 protected:
  virtual bool beginSection(std::string_view name, std::string_view sentence) = 0;
  virtual void endSection(std::vector<std::string> problems) = 0;
  virtual int beginList(std::string_view name, int count, std::string_view sentence) = 0;
  virtual void beginItem(int index) = 0;
  virtual void endList() = 0;
};

/// Reads YAML over the values a config already has.
class YamlReader final : public Fields {
 public:
  /// Throws InputError when the file cannot be opened or is not YAML.
  static YamlReader fromFile(const std::string& file);
  /// `name` stands for the file in messages.
  static YamlReader fromText(const std::string& text, const std::string& name);
  ~YamlReader() override;
  YamlReader(YamlReader&&) noexcept;

  /// Throws InputError with every problem at once: unknown key (with "did you mean"), wrong type, failed validation,
  /// each with file, line and column. Keys that are not in the file keep their value.
  template <typename Config>
  void read(Config& config) {
    config.describe(*this);
    finish(config.validate());
  }

  using Fields::choice;
  void operator()(std::string_view name, double& value, std::string_view sentence) override;
  void operator()(std::string_view name, int& value, std::string_view sentence) override;
  void operator()(std::string_view name, bool& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::string& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::vector<double>& value, std::string_view sentence) override;
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

/// Prints a config as YAML that YamlReader reads back to the same values.
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
  void operator()(std::string_view name, double& value, std::string_view sentence) override;
  void operator()(std::string_view name, int& value, std::string_view sentence) override;
  void operator()(std::string_view name, bool& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::string& value, std::string_view sentence) override;
  void operator()(std::string_view name, std::vector<double>& value, std::string_view sentence) override;
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
