#include "common/config_check.hpp"

#include <fmt/format.h>

namespace swiftlet::common::config {

void Validator::check(std::string_view name, double value, const Bounds& bounds) {
  if (!bounds.contain(value)) take({{{}, std::string(name), bounds.problem(value), ""}});
}

void Validator::take(std::vector<Problem> problems) {
  std::string path;
  for (const std::string& prefix : prefixes_) path += prefix;
  for (Problem& problem : problems) {
    problem.element = path + problem.element;
    problems_.push_back(std::move(problem));
  }
}

void Validator::operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view) {
  check(name, value, bounds);
}

void Validator::operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view) {
  check(name, value, bounds);
}

void Validator::operator()(std::string_view name, std::vector<double>& value, const Bounds& bounds, std::string_view) {
  for (std::size_t i = 0; i < value.size(); ++i) check(fmt::format("{}[{}]", name, i), value[i], bounds);
}

void Validator::choice(std::string_view name, int& value, const std::vector<std::string>& words, std::string_view) {
  if (value < 0 || value >= static_cast<int>(words.size()))
    take({{{},
           std::string(name),
           Message("config.no-such-word", "{} is none of its {} words", value, words.size()),
           ""}});
}

bool Validator::beginSection(std::string_view name, std::string_view) {
  prefixes_.push_back(fmt::format("{}.", name));
  return true;
}

void Validator::endSection(std::vector<Problem> problems) {
  take(std::move(problems));
  prefixes_.pop_back();
}

std::optional<int> Validator::beginList(std::string_view name, int, std::string_view) {
  lists_.emplace_back(name);
  return std::nullopt;
}

void Validator::beginItem(int index) { prefixes_.push_back(fmt::format("{}[{}].", lists_.back(), index)); }

void Validator::endList() { lists_.pop_back(); }

}  // namespace swiftlet::common::config
