#include "common/validation.hpp"

#include <utility>

namespace swiftlet::common {

Validation& Validation::atMost(std::string_view name, double value, std::string_view limit_name, double limit) {
  return require(value <= limit, name,
                 Message("config.above-other", "{} is more than {}, which is {}", value, limit_name, limit));
}

Validation& Validation::require(bool condition, std::string_view name, Message message, std::string hint) {
  if (!condition) problems_.push_back({{}, std::string(name), std::move(message), std::move(hint)});
  return *this;
}

Validation& Validation::given(bool is_given, std::string_view name) {
  return require(is_given, name, Message("config.missing", "is missing"));
}

Validation& Validation::refuse(std::string_view name, const std::optional<Problem>& problem) {
  return problem ? require(false, name, problem->message, problem->hint) : *this;
}

}  // namespace swiftlet::common
