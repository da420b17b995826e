#include "simulation/nature_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/yaml_problem.hpp"
#include "simulation/plant_keys.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::Problem;

constexpr const char* kLeastThrust = "least_thrust_over_weight";

/// The keys of a nature's file: the parts of a scenario that are the plant.
struct NatureKeys {
  double least_thrust_over_weight = 1.05;
  Scenario scenario;

  void describe(common::config::Fields& fields) {
    fields(kLeastThrust, least_thrust_over_weight, {0, 10}, "Thrust over weight that a draw must have.");
    describePlant(scenario, fields);
  }
};

/// The keys of a plant that count something.
std::set<std::string> wholeNumberKeys() {
  std::set<std::string> keys;
  for (PlantKey& one : plantKeys(Scenario{}))
    if (one.whole) keys.insert(std::move(one.key));
  return keys;
}

/// The `]` of the range that begins at `from`, and none in a comment.
std::size_t closeOf(std::string_view text, std::size_t from) {
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == ']') return i;
    if (text[i] == '#') i = std::min(text.find('\n', i), text.size() - 1);
  }
  return text.size();
}

bool isWhole(double value) { return std::floor(value) == value; }

/// The node below `root` at "quadrotor.battery.capacity_ah", made if it is missing.
YAML::Node nodeAt(const YAML::Node& root, const std::string& key) {
  YAML::Node node = root;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    YAML::Node next = node[key.substr(begin, end - begin)];
    node.reset(next);
    begin = end + 1;
  }
  return node;
}

/// Whether the key, or a section that it is in, is one of them.
bool isAmong(const std::string& key, const std::vector<std::string>& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](const std::string& one) { return key == one || key.starts_with(one + "."); });
}

}  // namespace

/// Reads the text once into entries and collects what is wrong with ranges.
class NatureRanges::Reader {
 public:
  Reader(const std::string& text, const std::string& file) : text_(text), file_(file) {
    const YAML::Node root = common::loadYaml(text, file);
    if (root.IsMap()) readMap(root, "");
    if (!problems_.empty()) throw InputError(problems_);
  }

  std::vector<Entry> entries;

 private:
  void readMap(const YAML::Node& map, const std::string& prefix) {
    for (const auto& item : map) {
      const std::string key = prefix + (item.first.IsScalar() ? item.first.Scalar() : "?");
      if (item.second.IsMap()) readMap(item.second, key + ".");
      if (item.second.IsSequence()) readRange(item.second, key);
      if (item.second.IsScalar()) entries.push_back({.key = key, .value = item.second.Scalar()});
    }
  }

  void readRange(const YAML::Node& node, const std::string& key) {
    Entry entry{.key = key, .value = {}, .whole = whole_.contains(key)};
    const auto number = [](const YAML::Node& end, double& value) {
      return end.IsScalar() && YAML::convert<double>::decode(end, value) && std::isfinite(value);
    };
    entry.from = static_cast<std::size_t>(node.Mark().pos);
    const std::size_t close = closeOf(text_, entry.from);
    if (text_[entry.from] == '&')
      return report(node, key, "is a range with an anchor", "write the range out as [low, high], without anchors");
    if (node.size() != 2 || !number(node[0], entry.low) || !number(node[1], entry.high) || text_[entry.from] != '[')
      return report(node, key, "is not a range [low, high] of two numbers", "a range is drawn from uniformly");
    if (entry.low > entry.high)
      return report(node, key, fmt::format("is upside down: {} is above {}", entry.low, entry.high),
                    "the lower number stands first");
    if (entry.whole && !(isWhole(entry.low) && isWhole(entry.high)))
      return report(node, key, "is not a range of two whole numbers", "");
    entry.size = close + 1 - entry.from;
    entries.push_back(entry);
  }

  void report(const YAML::Node& node, const std::string& key, const std::string& message, const std::string& hint) {
    problems_.push_back({{file_, node.Mark().line + 1, node.Mark().column + 1}, key, message, hint});
  }

  const std::string& text_;
  std::string file_;
  std::set<std::string> whole_ = wholeNumberKeys();
  std::vector<Problem> problems_;
};

/// The number, and behind it the blanks and lines that keep what follows in its place.
std::string NatureRanges::inPlaceOf(const Entry& entry, std::string_view text, const std::string& number) {
  const std::string_view range = text.substr(entry.from, entry.size);
  const auto lines = static_cast<std::size_t>(std::count(range.begin(), range.end(), '\n'));
  return lines > 0 ? number + std::string(lines, '\n') : fmt::format("{:<{}}", number, entry.size);
}

std::string NatureRanges::Entry::drawn(const Choose& choose) const {
  if (!isRange()) return value;
  if (whole) return fmt::format("{}", std::min(high, std::floor(choose(key, low, high + 1.0))));
  return fmt::format("{}", choose(key, low, high));
}

NatureRanges::NatureRanges(const std::string& given, const std::string& file) : file_(file) {
  const std::string text = common::yamlText(given);
  entries_ = Reader(text, file).entries;
  // The file is read with the lower and with the upper end of each range in its place, so that every mistake is
  // reported now, with its line, and not in some draw.
  for (const bool low : {true, false}) {
    const auto end_of = [low](const std::string&, double a, double b) { return low ? a : b; };
    std::string with_numbers = text;
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry)  // From behind, so that places stay.
      if (entry->isRange())
        with_numbers.replace(entry->from, entry->size, inPlaceOf(*entry, text, entry->drawn(end_of)));
    NatureKeys keys;
    common::config::YamlReader::fromText(with_numbers, file).read(keys);
    least_thrust_over_weight_ = keys.least_thrust_over_weight;
  }
  std::erase_if(entries_, [](const Entry& entry) { return entry.key == kLeastThrust; });
}

bool NatureRanges::has(const std::string& key) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
}

void NatureRanges::narrow(const std::string& key, double low, double high) {
  for (Entry& entry : entries_) {
    if (entry.key != key || !entry.isRange()) continue;
    entry.low = low;
    entry.high = high;
  }
}

std::optional<NatureRange> NatureRanges::rangeOf(const std::string& key) const {
  for (const Entry& entry : entries_) {
    if (entry.key != key) continue;
    if (entry.isRange()) return NatureRange{entry.low, entry.high};
    double value = 0.0;
    if (YAML::convert<double>::decode(YAML::Node(entry.value), value)) return NatureRange{value, value};
  }
  return std::nullopt;
}

void NatureRanges::apply(Scenario& scenario, const std::vector<std::string>& written, const Choose& choose) const {
  YAML::Node values(YAML::NodeType::Map);
  for (const Entry& entry : entries_)
    if (!isAmong(entry.key, written)) nodeAt(values, entry.key) = entry.drawn(choose);
  NatureKeys keys{.scenario = std::move(scenario)};
  common::config::YamlReader::fromText(YAML::Dump(values), file_).read(keys);
  scenario = std::move(keys.scenario);
}

std::string NatureRanges::valuesIn(const Scenario& scenario) const {
  using common::config::YamlPrinter;
  const YAML::Node all = YAML::Load(YamlPrinter(YamlPrinter::Comments::kNo).print(NatureKeys{.scenario = scenario}));
  YAML::Node values(YAML::NodeType::Map);
  for (const Entry& entry : entries_) nodeAt(values, entry.key) = nodeAt(all, entry.key).Scalar();
  return YAML::Dump(values) + "\n";
}

}  // namespace swiftlet::simulation
