// The reference page of a Config in Markdown. Each section has a table, and each setting a row with default, bounds and
// sentence.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config_fields.hpp"

namespace swiftlet::common::config {

class ReferencePrinter final : public Fields {
 public:
  /// A chapter `title` with `sentence` below it. The values in `config` are shown as defaults. A list is shown as the
  /// settings of one item, even if it is empty.
  template <typename Config>
  std::string print(std::string_view title, std::string_view sentence, Config config) {
    open(std::string(title), std::string(sentence));
    config.describe(*this);
    return "## " + std::string(title) + "\n" + closed();
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
  struct Section {
    std::string path, sentence;
    std::string rows;      ///< The table rows of its own settings.
    std::string sections;  ///< The complete text of the sections nested in it.
  };

  void open(std::string path, std::string sentence);
  /// Closes the innermost open section and returns its text without the heading.
  std::string closed();
  void row(std::string_view name, const std::string& value, const std::string& bounds, std::string_view sentence);
  std::string pathOf(std::string_view name) const;

  std::vector<Section> open_;
};

}  // namespace swiftlet::common::config
