#include "common/config.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "common/error.hpp"
#include "common/read_bytes.hpp"

namespace swiftlet::common::config {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string number(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  return fmt::format("{}", value);
}

std::string doubleQuoted(const std::string& value) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << value;
  return emitter.c_str();
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------- reading

struct YamlReader::Impl {
  /// One mapping that is being read: the keys asked for are what it may have.
  struct Level {
    YAML::Node node;
    std::string path;
    std::vector<std::string> known_keys;
  };

  std::string file;
  std::vector<Level> levels;
  std::vector<YAML::Node> lists;
  std::vector<std::string> list_names;
  std::vector<Problem> problems;

  SourceLocation at(const YAML::Node& node) const {
    const YAML::Mark mark = node.Mark();
    if (mark.is_null()) return {file, 0, 0};
    return {file, mark.line + 1, mark.column + 1};
  }

  std::string pathOf(std::string_view name) const {
    const std::string& base = levels.back().path;
    if (base.empty() || name.empty()) return base + std::string(name);
    return fmt::format("{}.{}", base, name);
  }

  void report(const YAML::Node& node, std::string_view name, std::string message, std::string hint = {}) {
    problems.push_back({at(node), pathOf(name), std::move(message), std::move(hint)});
  }

  std::optional<YAML::Node> find(std::string_view name) {
    Level& level = levels.back();
    level.known_keys.emplace_back(name);
    if (!level.node.IsMap()) return std::nullopt;
    const YAML::Node& node = level.node;
    YAML::Node value = node[std::string(name)];
    if (!value.IsDefined()) return std::nullopt;
    return value;
  }

  template <typename Value>
  void scalar(std::string_view name, Value& value, const char* expected) {
    const auto node = find(name);
    if (!node) return;
    if (!convert(*node, value)) report(*node, name, fmt::format("{} is not {}", textOf(*node), expected));
  }

  template <typename Value>
  void sequence(std::string_view name, std::vector<Value>& values, const char* expected) {
    const auto node = find(name);
    if (!node) return;
    if (!node->IsSequence()) return report(*node, name, fmt::format("{} is not a list", textOf(*node)));
    std::vector<Value> read;
    for (const YAML::Node& item : *node) {
      Value value{};
      if (!convert(item, value)) return report(item, name, fmt::format("{} is not {}", textOf(item), expected));
      read.push_back(value);
    }
    values = std::move(read);
  }

  template <typename Value>
  static bool convert(const YAML::Node& node, Value& value) {
    Value read{};
    if (!node.IsScalar() || !YAML::convert<Value>::decode(node, read)) return false;
    value = std::move(read);
    return true;
  }

  static std::string textOf(const YAML::Node& node) {
    if (node.IsScalar()) return fmt::format("`{}`", node.Scalar());
    return node.IsMap() ? "a mapping" : node.IsSequence() ? "a list" : "an empty value";
  }

  void closeLevel(std::vector<std::string> failed) {
    const Level level = levels.back();
    if (level.node.IsMap()) {
      std::set<std::string> met;
      for (const auto& entry : level.node) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
        if (!met.insert(key).second) report(entry.first, "", fmt::format("key `{}` is given twice", key), "");
        const auto& known = level.known_keys;
        if (std::find(known.begin(), known.end(), key) == known.end())
          report(entry.first, "", fmt::format("unknown key `{}`", key),
                 didYouMean(key, known).empty() ? "known are: " + listed(known) : didYouMean(key, known));
      }
    } else if (!level.node.IsNull()) {
      report(level.node, "", fmt::format("{} where keys were expected", textOf(level.node)));
    }
    for (std::string& text : failed) {
      const std::string key = text.substr(0, text.find_first_of(": "));
      const YAML::Node value = level.node.IsMap() ? level.node[key] : YAML::Node();
      problems.push_back(
          {value.IsDefined() && level.node.IsMap() ? at(value) : at(level.node), level.path, std::move(text), {}});
    }
    levels.pop_back();
  }
};

YamlReader::YamlReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
YamlReader::~YamlReader() = default;
YamlReader::YamlReader(YamlReader&&) noexcept = default;

YamlReader YamlReader::fromFile(const std::string& file) {
  constexpr std::size_t kMostBytes = std::size_t{8} << 20;
  return fromText(readBytes(file, kMostBytes), file);
}

YamlReader YamlReader::fromText(const std::string& text, const std::string& name) {
  auto impl = std::make_unique<Impl>();
  impl->file = name;
  try {
    YAML::Node root = YAML::Load(text);
    impl->levels.push_back({root, "", {}});
  } catch (const YAML::Exception& e) {
    throw InputError(Problem{{name, e.mark.line + 1, e.mark.column + 1}, "", "not YAML: " + e.msg, ""});
  }
  return YamlReader(std::move(impl));
}

void YamlReader::operator()(std::string_view name, double& value, std::string_view) {
  impl_->scalar(name, value, "a number");
}
void YamlReader::operator()(std::string_view name, int& value, std::string_view) {
  impl_->scalar(name, value, "a whole number");
}
void YamlReader::operator()(std::string_view name, bool& value, std::string_view) {
  impl_->scalar(name, value, "true or false");
}
void YamlReader::operator()(std::string_view name, std::string& value, std::string_view) {
  impl_->scalar(name, value, "a text");
}
void YamlReader::operator()(std::string_view name, std::vector<double>& value, std::string_view) {
  impl_->sequence(name, value, "a number");
}
void YamlReader::operator()(std::string_view name, std::vector<std::string>& value, std::string_view) {
  impl_->sequence(name, value, "a text");
}

void YamlReader::choice(std::string_view name, int& value, const std::vector<std::string>& words, std::string_view) {
  const auto node = impl_->find(name);
  if (!node) return;
  const std::string word = node->IsScalar() ? node->Scalar() : "";
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != word) continue;
    value = static_cast<int>(i);
    return;
  }
  impl_->report(*node, name, fmt::format("{} is none of: {}", Impl::textOf(*node), listed(words)),
                didYouMean(word, words));
}

bool YamlReader::beginSection(std::string_view name, std::string_view) {
  const std::string path = impl_->pathOf(name);
  const auto node = impl_->find(name);
  if (!node) return false;
  impl_->levels.push_back({*node, path, {}});
  return true;
}

void YamlReader::endSection(std::vector<std::string> problems) { impl_->closeLevel(std::move(problems)); }

int YamlReader::beginList(std::string_view name, int count, std::string_view) {
  const auto node = impl_->find(name);
  if (node && !node->IsSequence()) impl_->report(*node, name, Impl::textOf(*node) + " is not a list");
  const bool given = node && node->IsSequence();
  impl_->lists.push_back(given ? *node : YAML::Node());
  impl_->list_names.push_back(impl_->pathOf(name));
  return given ? static_cast<int>(node->size()) : count;
}

void YamlReader::beginItem(int index) {
  const YAML::Node list = impl_->lists.back();
  impl_->levels.push_back({list.IsSequence() ? list[static_cast<std::size_t>(index)] : YAML::Node(),
                           fmt::format("{}[{}]", impl_->list_names.back(), index),
                           {}});
}

void YamlReader::endList() {
  impl_->lists.pop_back();
  impl_->list_names.pop_back();
}

void YamlReader::finish(std::vector<std::string> problems) {
  impl_->closeLevel(std::move(problems));
  if (!impl_->problems.empty()) throw InputError(std::move(impl_->problems));
}

// --------------------------------------------------------------------------------------------------------- printing

void YamlPrinter::line(std::string_view name, const std::string& value, std::string_view sentence) {
  std::string indent(static_cast<std::size_t>(2 * depth_), ' ');
  if (item_starts_) indent.replace(indent.size() - 2, 2, "- ");
  item_starts_ = false;
  text_ += fmt::format("{}{}:{}{}", indent, name, value.empty() ? "" : " ", value);
  if (comments_ == Comments::kYes && !sentence.empty()) text_ += fmt::format("  # {}", sentence);
  text_ += '\n';
}

void YamlPrinter::operator()(std::string_view name, double& value, std::string_view sentence) {
  line(name, number(value), sentence);
}
void YamlPrinter::operator()(std::string_view name, int& value, std::string_view sentence) {
  line(name, std::to_string(value), sentence);
}
void YamlPrinter::operator()(std::string_view name, bool& value, std::string_view sentence) {
  line(name, value ? "true" : "false", sentence);
}
void YamlPrinter::operator()(std::string_view name, std::string& value, std::string_view sentence) {
  line(name, doubleQuoted(value), sentence);
}

void YamlPrinter::operator()(std::string_view name, std::vector<double>& value, std::string_view sentence) {
  std::vector<std::string> words;
  for (const double v : value) words.push_back(number(v));
  line(name, "[" + listed(words) + "]", sentence);
}

void YamlPrinter::operator()(std::string_view name, std::vector<std::string>& value, std::string_view sentence) {
  std::vector<std::string> words;
  for (const std::string& v : value) words.push_back(doubleQuoted(v));
  line(name, "[" + listed(words) + "]", sentence);
}

void YamlPrinter::choice(std::string_view name, int& value, const std::vector<std::string>& words,
                         std::string_view sentence) {
  line(name, words.at(static_cast<std::size_t>(value)), fmt::format("{} One of: {}.", sentence, listed(words)));
}

bool YamlPrinter::beginSection(std::string_view name, std::string_view sentence) {
  line(name, "", sentence);
  ++depth_;
  return true;
}

void YamlPrinter::endSection(std::vector<std::string>) { --depth_; }

int YamlPrinter::beginList(std::string_view name, int count, std::string_view sentence) {
  line(name, count == 0 ? "[]" : "", sentence);
  ++depth_;
  return count;
}

void YamlPrinter::beginItem(int) {
  ++depth_;
  item_starts_ = true;
}

void YamlPrinter::endList() { --depth_; }

}  // namespace swiftlet::common::config
