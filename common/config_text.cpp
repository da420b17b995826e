#include "common/config_text.hpp"

#include <cmath>

#include <fmt/format.h>
#include <yaml-cpp/emitter.h>
#include <yaml-cpp/emittermanip.h>

namespace swiftlet::common::config {
namespace {

template <typename Value>
std::string sequence(const std::vector<Value>& values) {
  std::vector<std::string> words;
  for (const Value& value : values) words.push_back(yamlOf(value));
  return "[" + listed(words) + "]";
}

}  // namespace

std::string yamlOf(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  return fmt::format("{}", value);
}

std::string yamlOf(bool value) { return value ? "true" : "false"; }

std::string yamlOf(const std::string& value) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << value;
  return emitter.c_str();
}

std::string yamlOf(const std::vector<double>& values) { return sequence(values); }
std::string yamlOf(const std::vector<std::string>& values) { return sequence(values); }

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace swiftlet::common::config
