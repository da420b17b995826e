#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <type_traits>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "common/config.hpp"
#include "common/config_text.hpp"
#include "common/error.hpp"
#include "common/number_hint.hpp"
#include "common/number_list.hpp"
#include "common/read_bytes.hpp"
#include "common/yaml_problem.hpp"

namespace swiftlet::common::config {
struct YamlReader::Impl {
  /// One mapping that is being read: the keys asked for are what it may have.
  struct Level {
    YAML::Node node;
    std::string path;
    std::vector<std::string> known_keys;
  };

  /// A key that its section does not have.
  struct UnknownKey {
    std::size_t problem;  ///< Its index among the problems.
    std::string section, key;
  };

  std::string file, whole_text;
  std::vector<std::string_view> lines;  ///< Of the text.
  std::vector<Level> levels;
  std::vector<YAML::Node> lists;
  std::vector<std::string> list_names;
  static constexpr std::size_t kMostProblems = 100;
  std::vector<Problem> problems;   ///< The first of them.
  std::set<std::string> reported;  ///< All, as texts without hints.
  bool keeps_unknown_keys = false;
  std::vector<Problem> kept_keys;
  std::vector<UnknownKey> unknown;
  WhatBecameOf what_became_of;
  std::map<std::string, std::vector<std::string>> known;  ///< The keys of each section of the file, by its path.
  std::vector<std::string> written;
  std::map<std::string, SourceLocation> places;

  SourceLocation at(const YAML::Node& node) const {
    const YAML::Mark mark = node.Mark();
    if (mark.is_null()) return {file, 0, 0};
    return {file, mark.line + 1, mark.column + 1};
  }

  /// Of a value, or of the key of an empty one: the library has that where the next word begins.
  SourceLocation placeOf(std::string_view name, const YAML::Node& value) const {
    const YAML::Node& section = levels.back().node;
    if (value.IsNull() && section.IsMap())
      for (const auto& entry : section)
        if (entry.first.IsScalar() && entry.first.Scalar() == name) return at(entry.first);
    return at(value);
  }

  std::string pathOf(std::string_view name) const {
    const std::string& base = levels.back().path;
    if (base.empty() || name.empty()) return base + std::string(name);
    return fmt::format("{}.{}", base, name);
  }

  void report(const YAML::Node& node, std::string_view name, Message message, std::string hint = {}) {
    Problem problem{placeOf(name, node), pathOf(name), std::move(message), {}};
    // A key that is read twice, as `based_on`, has its problem once.
    if (!reported.insert(toString(problem)).second || problems.size() == kMostProblems) return;
    std::string lookalike = lookalikeHint(lines, problem.location.line);
    problem.hint = lookalike.empty() ? std::move(hint) : std::move(lookalike);
    problems.push_back(std::move(problem));
  }

  /// What to write in place of a value that is not `expected`.
  std::string valueHint(std::string_view name, const YAML::Node& node, std::string_view expected) const {
    if (node.IsSequence() && node.size() == 1) return "leave out the brackets or the dash";
    if (node.IsSequence()) return "write one value, without brackets or dashes";
    if (node.IsMap()) {
      const auto only = node.begin();  // An item without a blank behind its dash is read as a key.
      const bool scalars = node.size() == 1 && only->first.IsScalar() && only->second.IsScalar();
      const std::string hint =
          scalars ? keyHint(fmt::format("{}: {}", only->first.Scalar(), only->second.Scalar())) : "";
      return hint.empty() ? "write the value alone, without keys" : hint;
    }
    if (node.IsNull()) {
      const auto line = static_cast<std::size_t>(placeOf(name, node).line);  // From 1.
      const bool comment = line - 1 < lines.size() && lines[line - 1].find(": #") != std::string_view::npos;
      return comment ? "`#` begins a comment: put quotes around a value that has one"
                     : "write a value behind the colon, or leave out the key";
    }
    if (expected.ends_with("number")) return numberHint(name, node.Scalar(), expected == "a whole number");
    const std::string& word = node.Scalar();
    return expected != "true or false" ? "" : word == "1" ? "write `true`" : word == "0" ? "write `false`" : "";
  }

  void reportValue(const YAML::Node& node, std::string_view name, std::string_view expected) {
    report(node, name, otherType(node, expected), valueHint(name, node, expected));
  }
  static Message otherType(const YAML::Node& node, std::string_view expected) {
    return Message("config.other-type", "{} is not {}", textOf(node), expected);
  }
  static Message noList(const YAML::Node& node) { return Message("config.no-list", "{} is not a list", textOf(node)); }

  std::optional<YAML::Node> find(std::string_view name) {
    Level& level = levels.back();
    auto& known_keys = level.known_keys;
    if (std::find(known_keys.begin(), known_keys.end(), name) == known_keys.end()) known_keys.emplace_back(name);
    if (!level.node.IsMap()) return std::nullopt;
    const YAML::Node& node = level.node;
    YAML::Node value = node[std::string(name)];
    if (!value.IsDefined()) return std::nullopt;
    if (!value.IsMap()) written.push_back(pathOf(name));
    places[pathOf(name)] = at(value);
    return value;
  }

  /// Reports a value of another type in the file, and then keeps `value`.
  template <typename Value>
  void scalar(std::string_view name, Value& value, const char* expected) {
    const auto node = find(name);
    if (node && !convert(*node, value)) reportValue(*node, name, expected);
  }

  /// Reports a value in the file that is not a number or out of bounds, and then keeps `value`.
  template <typename Value>
  void number(std::string_view name, Value& value, const Bounds& bounds, const char* expected) {
    const auto node = find(name);
    if (!node) {
      if (!bounds.contain(value)) report(levels.back().node, name, Message("config.missing", "is missing"));
      return;
    }
    Value read{};
    if (!convert(*node, read)) return reportValue(*node, name, expected);
    if (!bounds.contain(read)) return report(*node, name, bounds.problem(read));
    value = read;
  }

  /// Without commas between them several numbers are one item. One that has a comma itself is in quotes or behind a
  /// dash.
  void reportItem(const YAML::Node& list, const YAML::Node& item, std::string_view name, std::string_view expected) {
    std::string list_text;
    for (const YAML::Node& one : list) {
      const bool plain = one.IsScalar() && one.Scalar().find(',') == std::string::npos;
      list_text += (list_text.empty() ? "" : ", ") + (plain ? one.Scalar() : "?");
    }
    const std::string numbers = expected.ends_with("number") ? numberListOf(list_text) : "";
    report(item, name, otherType(item, expected),
           numbers.empty() ? valueHint(name, item, expected) : fmt::format("write `{}`", numbers));
  }

  template <typename Value>
  void sequence(std::string_view name, std::vector<Value>& values, const char* expected,
                const std::optional<Bounds>& bounds = std::nullopt) {
    const auto node = find(name);
    if (!node) return;
    if (!node->IsSequence())
      return report(*node, name, noList(*node),
                    node->IsScalar() ? (std::is_arithmetic_v<Value> ? numberListHint(node->Scalar())
                                                                    : fmt::format("write `[{}]`", node->Scalar()))
                    : node->IsMap()  ? "write the values in brackets, without keys"
                                     : "");
    std::vector<Value> read;
    for (const YAML::Node& item : *node) {
      Value value{};
      if (item.IsSequence())
        return report(item, name, Message("config.list-in-list", "a list within the list"),
                      "write all values in one list: leave out the inner brackets");
      if (!convert(item, value)) return reportItem(*node, item, name, expected);
      if constexpr (std::is_arithmetic_v<Value>)
        if (bounds && !bounds->contain(value))
          report(item, fmt::format("{}[{}]", name, read.size()), bounds->problem(value));
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

  /// A whole file may be one text: XML is.
  static std::string beginningOf(const std::string& text) {
    constexpr std::size_t kMost = 60;
    const std::size_t line = std::min(text.find('\n'), text.size());
    if (line == text.size() && line <= kMost) return text;
    std::size_t end = std::min(line, kMost);
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // Within a character of UTF-8.
    return text.substr(0, end) + " ...";
  }

  static std::string textOf(const YAML::Node& node) {
    if (node.IsScalar()) return fmt::format("`{}`", beginningOf(node.Scalar()));
    return node.IsMap() ? "a mapping" : node.IsSequence() ? "a list" : "an empty value";
  }

  void refuseUnknownKeys(const Level& level) {
    std::map<std::string, int> met;  // With their lines.
    for (const auto& entry : level.node) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      const auto [first, is_new] = met.emplace(key, at(entry.first).line);
      if (!is_new)
        report(entry.first, "", Message("config.key-twice", "key `{}` is given twice", key),
               fmt::format("it is in line {} too: leave out one of the two", first->second));
      const auto& known_keys = level.known_keys;
      if (std::find(known_keys.begin(), known_keys.end(), key) != known_keys.end()) continue;
      if (const auto former = what_became_of ? what_became_of(pathOf(key)) : std::nullopt) {
        report(entry.first, "", Message("config.former-key", "`{}` {}", key, *former), "leave it out");
        continue;
      }
      const auto nearest = nearestWord(key, known_keys);
      if (keeps_unknown_keys && levels.size() == 1 && !(nearest && !level.node[*nearest].IsDefined())) {
        kept_keys.push_back(
            {at(entry.first), "", Message("config.key-not-used", "unknown key `{}`, not used", key), ""});
        continue;
      }
      const std::string similar = didYouMean(key, known_keys);
      const std::size_t before = problems.size();
      report(entry.first, "", Message("config.unknown-key", "unknown key `{}`", key),
             similar.empty() ? "known are: " + listed(known_keys) : similar);
      if (problems.size() > before) unknown.push_back({before, level.path, key});
    }
  }

  /// An unknown key may be one of another section, above or below which it was indented by mistake, and one without a
  /// value may lack the blank behind its colon.
  void hintAtUnknownKeys() {
    for (const UnknownKey& one : unknown) {
      Problem& problem = problems[one.problem];
      if (!lookalikeHint(lines, problem.location.line).empty()) continue;
      if (std::string hint = keyHint(one.key); !hint.empty()) problem.hint = std::move(hint);
      if (one.key.find_first_not_of("0123456789") == std::string::npos) problem.hint = "write decimals with a point";
      for (const auto& [section, keys] : known) {
        if (section == one.section || std::find(keys.begin(), keys.end(), one.key) == keys.end()) continue;
        problem.hint = section.empty() ? fmt::format("`{}` is no key of a section: do not indent it", one.key)
                                       : fmt::format("`{}` is a key of `{}`: indent it below that", one.key, section);
      }
    }
  }

  /// Whether something is wrong with that value, or with an item of it, already.
  bool isReported(std::string_view name) const {
    const std::string path = pathOf(name);
    return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
      return problem.element == path || problem.element.starts_with(path + "[");
    });
  }

  /// The value of `key` or of `key[2]`, the third one of a list.
  static YAML::Node childOf(const YAML::Node& map, const std::string& key) {
    const std::size_t bracket = std::min(key.find('['), key.size());
    const YAML::Node value = map[key.substr(0, bracket)];
    if (bracket == key.size() || !value.IsDefined() || !value.IsSequence()) return value;
    return value[std::stoul(key.substr(bracket + 1))];
  }

  /// Reports a problem of "loops.max_sigma_m" at the place of that key, or of its innermost section in the file. A
  /// value that could not be read has kept its default, which says nothing about the file.
  void reportRelation(const YAML::Node& from, const Problem& relation) {
    const std::string& name = relation.element;
    if (name.empty()) return report(from, "", relation.message, relation.hint);
    if (isReported(name)) return;
    YAML::Node node = from;
    for (std::size_t begin = 0; begin <= name.size() && node.IsMap();) {
      const std::size_t end = std::min(name.find('.', begin), name.size());
      const YAML::Node next = childOf(node, name.substr(begin, end - begin));
      if (!next.IsDefined()) break;
      node.reset(next);
      begin = end + 1;
    }
    report(node, name, relation.message, relation.hint);
  }

  /// The line of a text that may go over several, from where it begins.
  std::string_view writtenAt(const YAML::Node& node) const {
    const SourceLocation place = at(node);
    if (place.line < 1 || place.line > static_cast<int>(lines.size())) return {};
    const std::string_view line = lines[static_cast<std::size_t>(place.line) - 1];
    return line.substr(std::min<std::size_t>(static_cast<std::size_t>(place.column) - 1, line.size()));
  }

  void closeLevel(const std::vector<Problem>& relations) {
    const Level level = levels.back();
    known[level.path] = level.known_keys;
    if (level.node.IsMap())
      refuseUnknownKeys(level);
    else if (!level.node.IsNull())
      report(level.node, "", Message("config.no-keys", "{} where keys were expected", textOf(level.node)),
             level.node.IsScalar()                    ? keyHint(writtenAt(level.node))
             : writtenAt(level.node).starts_with('[') ? "write `{key: value}` in place of the brackets"
                                                      : "leave out the dashes");
    for (const Problem& relation : relations) reportRelation(level.node, relation);
    levels.pop_back();
  }
};

YamlReader::YamlReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
YamlReader::~YamlReader() = default;
YamlReader::YamlReader(YamlReader&&) noexcept = default;

YamlReader YamlReader::fromFile(const std::string& file) { return fromText(readText(file, kMostYamlBytes), file); }

YamlReader YamlReader::fromText(const std::string& text, const std::string& name) {
  auto impl = std::make_unique<Impl>();
  impl->file = name;
  impl->whole_text = yamlText(text);
  impl->lines = linesOf(impl->whole_text);
  impl->levels.push_back({loadYaml(impl->whole_text, name), "", {}});
  return YamlReader(std::move(impl));
}

const std::vector<std::string>& YamlReader::writtenKeys() const { return impl_->written; }

SourceLocation YamlReader::locationOf(const std::string& path) const {
  const auto found = impl_->places.find(path);
  return found == impl_->places.end() ? SourceLocation{impl_->file} : found->second;
}

void YamlReader::operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view) {
  impl_->number(name, value, bounds, "a number");
}
void YamlReader::operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view) {
  impl_->number(name, value, bounds, "a whole number");
}
void YamlReader::operator()(std::string_view name, bool& value, std::string_view) {
  impl_->scalar(name, value, "true or false");
}
void YamlReader::operator()(std::string_view name, std::string& value, std::string_view) {
  impl_->scalar(name, value, "a text");
}
void YamlReader::operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds, std::string_view) {
  impl_->sequence(name, value, "a number", bounds);
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
  impl_->report(*node, name, Message("config.unknown-word", "{} is none of: {}", Impl::textOf(*node), listed(words)),
                didYouMean(word, words));
}

bool YamlReader::beginSection(std::string_view name, std::string_view) {
  const std::string path = impl_->pathOf(name);
  const auto node = impl_->find(name);
  if (!node) return false;
  impl_->levels.push_back({*node, path, {}});
  return true;
}
void YamlReader::endSection(std::vector<Problem> problems) { impl_->closeLevel(problems); }

std::optional<int> YamlReader::beginList(std::string_view name, int, std::string_view) {
  const auto node = impl_->find(name);
  if (node && !node->IsSequence())
    impl_->report(*node, name, Impl::noList(*node), node->IsMap() ? "begin each item with a dash: `- `" : "");
  const bool given = node && node->IsSequence();
  impl_->lists.push_back(given ? *node : YAML::Node());
  impl_->list_names.push_back(impl_->pathOf(name));
  return given ? std::optional(static_cast<int>(node->size())) : std::nullopt;
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

void YamlReader::explainFormerKeys(WhatBecameOf what_became_of) { impl_->what_became_of = std::move(what_became_of); }
void YamlReader::keepUnknownKeys() { impl_->keeps_unknown_keys = true; }
std::vector<Problem> YamlReader::unknownKeys() const { return impl_->kept_keys; }

void YamlReader::finish(const std::vector<Problem>& problems) {
  impl_->closeLevel(problems);
  impl_->hintAtUnknownKeys();
  if (impl_->problems.empty()) return;
  if (const std::size_t more = impl_->reported.size() - impl_->problems.size(); more > 0)
    impl_->problems.push_back({{impl_->file}, "", Message("config.more-problems", "has {} more problems", more), ""});
  throw InputError(std::move(impl_->problems));
}

}  // namespace swiftlet::common::config
